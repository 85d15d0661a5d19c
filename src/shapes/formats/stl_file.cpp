#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "shapes/formats/file_cursor.hpp"
#include "shapes/formats/formats.hpp"

namespace vesica::shapes {
namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t facet_size = 50;  // normal, three corners, two bytes of attributes

struct HashOfPoint {
  std::size_t operator()(const std::array<double, 3>& point) const {
    std::size_t hash = 0;
    for (const double coordinate : point)
      hash = hash * 0x9e3779b97f4a7c15U + std::hash<double>{}(coordinate);
    return hash;
  }
};

/// Gives each corner of a triangle its vertex; equal positions are one vertex.
class VertexMerger {
 public:
  explicit VertexMerger(SurfaceData& data) : data_(data) {}
  mesh::NodeIndex vertex_at(const Eigen::Vector3d& point) {
    const auto next = static_cast<mesh::NodeIndex>(data_.points.size());
    const auto [entry, is_new] = vertices_.try_emplace({point.x(), point.y(), point.z()}, next);
    if (is_new) data_.points.push_back(point);
    return entry->second;
  }

 private:
  SurfaceData& data_;
  std::unordered_map<std::array<double, 3>, mesh::NodeIndex, HashOfPoint> vertices_;
};

void expect(FileCursor& cursor, std::string_view expected) {
  if (const std::string_view found = cursor.word(); found != expected)
    cursor.refuse("'{}': must be '{}'", found, expected);
}

SurfaceData parse_text(const std::string& path, std::string_view text) {
  FileCursor cursor(path, text);
  SurfaceData data;
  VertexMerger merger(data);
  std::size_t number = 0;
  while (!cursor.is_at_end()) {
    cursor.enter("between facets");
    const std::string_view keyword = cursor.word();
    if (keyword == "solid" || keyword == "endsolid") {
      if (!cursor.is_at_end()) (void)cursor.line();
      continue;
    }
    if (keyword != "facet") cursor.refuse("'{}': must be facet, solid or endsolid", keyword);
    cursor.enter("facet " + std::to_string(++number));
    expect(cursor, "normal");
    for (int i = 0; i < 3; ++i) (void)cursor.number(NumberType::f64);
    expect(cursor, "outer");
    expect(cursor, "loop");
    mesh::Corners corners{};
    for (mesh::NodeIndex& corner : corners) {
      expect(cursor, "vertex");
      corner = merger.vertex_at(cursor.point(NumberType::f64));
    }
    expect(cursor, "endloop");
    expect(cursor, "endfacet");
    data.triangles.push_back(corners);
  }
  return data;
}

SurfaceData parse_binary(FileCursor cursor, std::size_t num_facets) {
  SurfaceData data;
  VertexMerger merger(data);
  for (std::size_t i = 0; i < num_facets; ++i) {
    cursor.enter("facet", i, num_facets);
    cursor.skip_bytes(3 * size_of(NumberType::f32));
    mesh::Corners& corners = data.triangles.emplace_back();
    for (mesh::NodeIndex& corner : corners)
      corner = merger.vertex_at(cursor.point(NumberType::f32));
    cursor.skip_bytes(2);
  }
  return data;
}

}  // namespace

/// A binary file may begin with "solid", too; only its size tells.
SurfaceData parse_stl(const std::string& path, std::string_view bytes) {
  FileCursor cursor(path, bytes);
  cursor.encoding = Encoding::little_endian;
  if (bytes.size() >= header_size + 4) {
    cursor.skip_bytes(header_size);
    const auto num_facets = static_cast<std::size_t>(cursor.number(NumberType::u32));
    const std::size_t expected = header_size + 4 + facet_size * num_facets;
    if (bytes.size() == expected) return parse_binary(cursor, num_facets);
    if (!bytes.starts_with("solid")) {
      cursor.refuse("{} facets: the file must have {} bytes, but has {}", num_facets, expected,
                    bytes.size());
    }
  }
  SurfaceData data = parse_text(path, bytes);
  if (data.triangles.empty()) cursor.refuse("no facets: must be a text or binary STL file");
  return data;
}

}  // namespace vesica::shapes
