#include "vesica/io/surface_writer.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::io {
namespace {

using Fields = std::span<const mesh::PointField>;

/// The corners of a surface: their nodes, in this order, and the triangles between them.
struct FlatSurface {
  std::vector<mesh::NodeIndex> nodes;
  std::vector<mesh::Corners> triangles;

  explicit FlatSurface(const mesh::Triangulation& triangulation) {
    std::vector<mesh::NodeIndex> vertex(static_cast<std::size_t>(triangulation.num_nodes()), -1);
    const auto at = [&](mesh::NodeIndex node) -> mesh::NodeIndex& {
      return vertex[static_cast<std::size_t>(node)];
    };
    for (const mesh::QuadraticTriangle& six : triangulation.triangles()) {
      for (std::size_t i = 0; i < 3; ++i) at(six[i]) = 0;
    }
    for (mesh::NodeIndex node = 0; node < triangulation.num_nodes(); ++node) {
      if (at(node) < 0) continue;
      at(node) = static_cast<mesh::NodeIndex>(nodes.size());
      nodes.push_back(node);
    }
    for (const mesh::QuadraticTriangle& six : triangulation.triangles())
      triangles.push_back({at(six[0]), at(six[1]), at(six[2])});
  }
};

std::string obj_text(const mesh::Surface& surface, Fields) {
  const FlatSurface flat(*surface.triangulation);
  std::string text = "# written by vesica\n";
  const auto out = std::back_inserter(text);
  for (const mesh::NodeIndex node : flat.nodes) {
    const auto x = surface.positions.row(node);
    fmt::format_to(out, "v {} {} {}\n", x[0], x[1], x[2]);
  }
  for (const auto& [a, b, c] : flat.triangles)
    fmt::format_to(out, "f {} {} {}\n", a + 1, b + 1, c + 1);
  return text;
}

std::string ply_text(const mesh::Surface& surface, Fields fields) {
  const FlatSurface flat(*surface.triangulation);
  std::string text = "ply\nformat ascii 1.0\ncomment written by vesica\n";
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "element vertex {}\n", flat.nodes.size());
  for (const char* axis : {"x", "y", "z"}) fmt::format_to(out, "property double {}\n", axis);
  for (const mesh::PointField& field : fields)
    fmt::format_to(out, "property double {}\n", field.name);
  fmt::format_to(out, "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                 flat.triangles.size());
  for (const mesh::NodeIndex node : flat.nodes) {
    const auto x = surface.positions.row(node);
    fmt::format_to(out, "{} {} {}", x[0], x[1], x[2]);
    for (const mesh::PointField& field : fields) fmt::format_to(out, " {}", field.values[node]);
    text += '\n';
  }
  for (const auto& [a, b, c] : flat.triangles) fmt::format_to(out, "3 {} {} {}\n", a, b, c);
  return text;
}

/// A DataArray of `count` numbers, `width` a line. An array of points has the attributes `more`.
template <class Number>
std::string data_array(std::string_view type, std::string_view name, std::size_t width,
                       const Number* values, std::size_t count, std::string_view more = "") {
  std::string text = fmt::format("        <DataArray type=\"{}\" Name=\"{}\"{} format=\"ascii\">\n",
                                 type, name, more);
  for (std::size_t i = 0; i < count; i += width)
    fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(std::span(values + i, width), " "));
  return text + "        </DataArray>\n";
}

std::string vtu_text(const mesh::Surface& surface, Fields fields) {
  constexpr std::uint8_t quadratic_triangle = 22;
  const auto triangles = surface.triangulation->triangles();
  const std::vector<std::uint8_t> types(triangles.size(), quadratic_triangle);
  std::vector<std::int64_t> offsets;
  for (std::size_t t = 1; t <= triangles.size(); ++t)
    offsets.push_back(static_cast<std::int64_t>(6 * t));
  const auto num_nodes = static_cast<std::size_t>(surface.positions.rows());
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <UnstructuredGrid>\n"
      "    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n"
      "      <PointData>\n",
      num_nodes, triangles.size());
  for (const mesh::PointField& field : fields)
    text += data_array("Float64", field.name, 1, field.values.data(), num_nodes);
  text += "      </PointData>\n      <Points>\n";
  text += data_array("Float64", "Points", 3, surface.positions.data(), 3 * num_nodes,
                     " NumberOfComponents=\"3\"");
  text += "      </Points>\n      <Cells>\n";
  text += data_array("Int32", "connectivity", 6, triangles.front().data(), 6 * triangles.size());
  text += data_array("Int64", "offsets", 1, offsets.data(), offsets.size());
  text += data_array("UInt8", "types", 1, types.data(), types.size());
  return text + "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

}  // namespace

void write_surface(const std::filesystem::path& path, const mesh::Surface& surface,
                   std::span<const mesh::PointField> fields) {
  const std::string ending = path.extension().string();
  if (ending == ".vtu") return write_text_file(path, vtu_text(surface, fields));
  if (ending == ".ply") return write_text_file(path, ply_text(surface, fields));
  if (ending == ".obj") return write_text_file(path, obj_text(surface, fields));
  throw ConfigError(
      fmt::format("{}: extension '{}': must be .vtu, .ply or .obj", path.string(), ending));
}

std::vector<mesh::PointField> fields_of(const problem::State& state) {
  std::vector<mesh::PointField> fields;
  if (state.is_two_phase()) fields.push_back({"c", "state", state.values.order_parameter});
  if (!state.values.mean_curvature.isZero(0))
    fields.push_back({"kappa", "state", state.values.mean_curvature});
  return fields;
}

}  // namespace vesica::io
