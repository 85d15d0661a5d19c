#include "shapes/formats/formats.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "shapes/formats/text_lines.hpp"

namespace vesica::shapes {
namespace {

constexpr long long most_vertices = std::numeric_limits<mesh::NodeIndex>::max();

struct OffCounts {
  long long vertices;
  long long faces;
};

/// `lines` is at its first line; leaves it at the line with the counts.
OffCounts read_off_counts(TextLines& lines) {
  std::size_t first = 0;
  const std::string_view header = lines.words()[0];
  if (header == "OFF") {
    first = 1;
  } else if (header.find("OFF") != std::string_view::npos) {
    lines.refuse("format {}: must be OFF (plain positions, no colours, normals or dimensions)",
                 header);
  }
  if (lines.words().size() == first && first == 1) {
    if (!lines.next()) lines.refuse("the file ends before the counts of vertices and faces");
    first = 0;
  }
  const auto& words = lines.words();
  if (first < words.size() && words[first] == "BINARY") {
    lines.refuse("format OFF BINARY: must be text");
  }
  const std::size_t num_counts = words.size() - first;
  if (num_counts < 2 || num_counts > 3) {
    lines.refuse("{} counts: must be the numbers of vertices, faces and (optional) edges",
                 num_counts);
  }
  const OffCounts counts{lines.integer(words[first]), lines.integer(words[first + 1])};
  if (counts.vertices < 0 || counts.faces < 0 || counts.vertices > most_vertices) {
    lines.refuse("{} vertices and {} faces: must be >= 0 and fit 32 bits", counts.vertices,
                 counts.faces);
  }
  return counts;
}

mesh::Corners read_off_face(const TextLines& lines, long long num_vertices) {
  const auto& words = lines.words();
  if (const long long num_corners = lines.integer(words[0]); num_corners != 3) {
    lines.refuse("face with {} corners: must be a triangle", num_corners);
  }
  if (words.size() < 4) lines.refuse("face with {} of 3 corners", words.size() - 1);
  mesh::Corners corners{};
  for (std::size_t i = 0; i < 3; ++i) {
    const long long vertex = lines.integer(words[i + 1]);
    if (vertex < 0 || vertex >= num_vertices) {
      lines.refuse("vertex {}: must be in [0, {})", vertex, num_vertices);
    }
    corners[i] = static_cast<mesh::NodeIndex>(vertex);
  }
  return corners;
}

/// Vertex number, from 0, of a corner `v`, `v/vt`, `v/vt/vn` or `v//vn`.
mesh::NodeIndex read_obj_corner(const TextLines& lines, std::string_view word,
                                std::size_t num_vertices) {
  const long long given = lines.integer(word.substr(0, word.find('/')));
  const auto known = static_cast<long long>(num_vertices);
  const long long vertex = given > 0 ? given - 1 : known + given;
  if (given == 0 || vertex < 0 || vertex >= known) {
    lines.refuse("vertex {}: must be one of the {} vertices above, counted from 1 or back from -1",
                 given, known);
  }
  return static_cast<mesh::NodeIndex>(vertex);
}

Eigen::Vector3d read_obj_vertex(const TextLines& lines) {
  const std::size_t size = lines.words().size() - 1;
  if (size != 3 && size != 4 && size != 6) {
    lines.refuse("vertex with {} numbers: must have 3, or 4 with weight 1, or 6 with a colour",
                 size);
  }
  if (size == 4 && lines.finite_number(lines.words()[4]) != 1) {
    lines.refuse("vertex with weight {}: must be 1", lines.words()[4]);
  }
  return lines.point(1);
}

bool is_passed_over(std::string_view keyword) {
  constexpr std::array<std::string_view, 7> keywords = {"vn", "vt",     "o",     "g",
                                                        "s",  "usemtl", "mtllib"};
  return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

}  // namespace

SurfaceData parse_off(const std::string& path, std::string_view text) {
  TextLines lines(path, text);
  if (!lines.next()) lines.refuse("the file is empty");
  const OffCounts counts = read_off_counts(lines);
  SurfaceData data;
  for (long long i = 0; i < counts.vertices; ++i) {
    if (!lines.next()) lines.refuse("the file ends after {} of {} vertices", i, counts.vertices);
    if (lines.words().size() != 3) {
      lines.refuse("vertex with {} numbers: must have 3", lines.words().size());
    }
    data.points.push_back(lines.point(0));
  }
  for (long long i = 0; i < counts.faces; ++i) {
    if (!lines.next()) lines.refuse("the file ends after {} of {} faces", i, counts.faces);
    data.triangles.push_back(read_off_face(lines, counts.vertices));
  }
  if (lines.next()) lines.refuse("text after the last face");
  return data;
}

SurfaceData parse_obj(const std::string& path, std::string_view text) {
  TextLines lines(path, text);
  SurfaceData data;
  while (lines.next()) {
    const std::string_view keyword = lines.words()[0];
    if (keyword == "v") {
      data.points.push_back(read_obj_vertex(lines));
    } else if (keyword == "f") {
      if (lines.words().size() != 4) {
        lines.refuse("face with {} corners: must be a triangle", lines.words().size() - 1);
      }
      mesh::Corners corners{};
      for (std::size_t i = 0; i < 3; ++i) {
        corners[i] = read_obj_corner(lines, lines.words()[i + 1], data.points.size());
      }
      data.triangles.push_back(corners);
    } else if (!is_passed_over(keyword)) {
      lines.refuse("keyword '{}': must be v, f, vn, vt, o, g, s, usemtl or mtllib", keyword);
    }
  }
  return data;
}

}  // namespace vesica::shapes
