#include "shapes/formats/formats.hpp"
#include "shapes/formats/text_lines.hpp"

// The files of FreeDTS, https://github.com/weria-pezeshkian/FreeDTS (CreateMashBluePrint.cpp).
// Lines of vertices and triangles begin with a number, which readers leave aside: the order counts.

namespace vesica::shapes {
namespace {

std::size_t read_count(const TextLines& lines, std::string_view word, std::string_view object) {
  const long long count = lines.integer(word);
  if (count < 0) lines.refuse("{} {}: must be >= 0", count, object);
  return static_cast<std::size_t>(count);
}

void next(TextLines& lines, std::size_t i, std::size_t count, std::string_view object) {
  if (!lines.next()) lines.refuse("the file ends after {} of {} {}", i, count, object);
}

/// `id x y z [domain]`, `count` lines.
void read_vertices(TextLines& lines, std::size_t count, const std::string& path,
                   SurfaceData& data) {
  std::vector<double> domains;
  for (std::size_t i = 0; i < count; ++i) {
    next(lines, i, count, "vertices");
    const std::size_t size = lines.words().size();
    if (size != 4 && size != 5)
      lines.refuse("vertex with {} words: must be number, x, y, z and (optional) domain", size);
    data.points.push_back(lines.point(1));
    domains.push_back(size == 5 ? lines.finite_number(lines.words()[4]) : 0);
  }
  data.fields.push_back(
      {"domain", path + ": point field 'domain'",
       Eigen::Map<const Eigen::VectorXd>(domains.data(), static_cast<Eigen::Index>(count))});
}

/// `id v1 v2 v3 [something]`, `count` lines.
void read_triangles(TextLines& lines, std::size_t count, SurfaceData& data) {
  const auto num_vertices = static_cast<long long>(data.points.size());
  for (std::size_t i = 0; i < count; ++i) {
    next(lines, i, count, "triangles");
    const std::size_t size = lines.words().size();
    if (size != 4 && size != 5)
      lines.refuse("triangle with {} words: must be number and three vertices", size);
    mesh::Corners& corners = data.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const long long vertex = lines.integer(lines.words()[k + 1]);
      if (vertex < 0 || vertex >= num_vertices)
        lines.refuse("vertex {}: must be in [0, {})", vertex, num_vertices);
      corners[k] = static_cast<mesh::NodeIndex>(vertex);
    }
  }
}

/// `id type vertex x y`, `count` lines: the type at the vertex, 0 where there is none.
void read_inclusions(TextLines& lines, std::size_t count, const std::string& path,
                     SurfaceData& data) {
  const auto num_vertices = static_cast<long long>(data.points.size());
  Eigen::VectorXd types = Eigen::VectorXd::Zero(num_vertices);
  for (std::size_t i = 0; i < count; ++i) {
    next(lines, i, count, "inclusions");
    if (lines.words().size() < 3)
      lines.refuse("inclusion with {} words: must be number, type, vertex, x, y",
                   lines.words().size());
    const long long vertex = lines.integer(lines.words()[2]);
    if (vertex < 0 || vertex >= num_vertices)
      lines.refuse("vertex {}: must be in [0, {})", vertex, num_vertices);
    types[vertex] = static_cast<double>(lines.integer(lines.words()[1]));
  }
  data.fields.push_back({"inclusion", path + ": point field 'inclusion'", std::move(types)});
}

}  // namespace

SurfaceData parse_tsi(const std::string& path, std::string_view text) {
  TextLines lines(path, text);
  SurfaceData data;
  while (lines.next()) {
    const std::string_view keyword = lines.words()[0];
    if (keyword == "version" || keyword == "box") continue;
    if (lines.words().size() != 2)
      lines.refuse("'{}' with {} words: must be vertex, triangle or inclusion with a count",
                   keyword, lines.words().size());
    const std::size_t count = read_count(lines, lines.words()[1], keyword);
    if (keyword == "vertex") {
      read_vertices(lines, count, path, data);
    } else if (keyword == "triangle") {
      read_triangles(lines, count, data);
    } else if (keyword == "inclusion") {
      read_inclusions(lines, count, path, data);
    } else if (keyword == "exclusion") {
      break;
    } else {
      lines.refuse("keyword '{}': must be version, box, vertex, triangle, inclusion or exclusion",
                   keyword);
    }
  }
  if (data.triangles.empty()) lines.refuse("the file ends without triangles");
  return data;
}

SurfaceData parse_q(const std::string& path, std::string_view text) {
  TextLines lines(path, text);
  SurfaceData data;
  if (!lines.next()) lines.refuse("the file is empty");
  if (lines.words().size() != 3)
    lines.refuse("{} words: must be the three sizes of the box", lines.words().size());
  const auto count = [&](std::string_view object) {
    if (!lines.next() || lines.words().size() != 1)
      lines.refuse("must be the number of {}", object);
    return read_count(lines, lines.words()[0], object);
  };
  read_vertices(lines, count("vertices"), path, data);
  read_triangles(lines, count("triangles"), data);
  if (data.triangles.empty()) lines.refuse("the file ends without triangles");
  return data;
}

}  // namespace vesica::shapes
