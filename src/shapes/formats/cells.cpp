#include "shapes/formats/cells.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vesica::shapes {
namespace {

// Numbers of VTK's cell types (vtkCellType.h).
constexpr int triangle = 5;
constexpr int polygon = 7;
constexpr int quadratic_triangle = 22;

bool is_point_or_line(int type) {
  return type == 0 || type == 1 || type == 2 || type == 3 || type == 4 || type == 21;
}

std::size_t corners_of(int type, std::size_t size) {
  if (type == quadratic_triangle) return 6;
  return type == triangle || (type == polygon && size == 3) ? 3 : 0;
}

}  // namespace

void add_triangle(const std::vector<mesh::NodeIndex>& nodes, SurfaceData& data) {
  data.triangles.push_back({nodes[0], nodes[1], nodes[2]});
  if (nodes.size() == 6) data.middles.push_back({nodes[3], nodes[4], nodes[5]});
}

void add_cells(const Cells& cells, SurfaceData& data, const RefuseCells& refuse) {
  const std::size_t count = cells.offsets.empty() ? 0 : cells.offsets.size() - 1;
  if (!cells.types.empty() && cells.types.size() != count)
    refuse(fmt::format("{} types of {} cells: must be one for each", cells.types.size(), count));
  for (std::size_t i = 0; i < count; ++i) {
    const int type = cells.types.empty() ? polygon : static_cast<int>(cells.types[i]);
    const double begin = cells.offsets[i];
    const double end = cells.offsets[i + 1];
    if (!(begin >= 0 && end >= begin && end <= static_cast<double>(cells.connectivity.size()))) {
      refuse(fmt::format("cell {}: points {} to {}: must be among the {} of the connectivity", i,
                         begin, end, cells.connectivity.size()));
    }
    if (is_point_or_line(type)) continue;
    const auto size = static_cast<std::size_t>(end - begin);
    if (size == 0 || corners_of(type, size) != size) {
      refuse(
          fmt::format("cell {} of type {} with {} points: must be a triangle (5), or a "
                      "quadratic one (22) with 6 points",
                      i, type, size));
    }
    std::vector<mesh::NodeIndex> nodes;
    for (std::size_t k = 0; k < size; ++k) {
      const double node = cells.connectivity[static_cast<std::size_t>(begin) + k];
      if (!(node >= 0 && node < static_cast<double>(data.points.size()) &&
            node == std::trunc(node))) {
        refuse(fmt::format("cell {}: point {}: must be one of the {} points, counted from 0", i,
                           node, data.points.size()));
      }
      nodes.push_back(static_cast<mesh::NodeIndex>(node));
    }
    add_triangle(nodes, data);
  }
  if (data.triangles.empty()) refuse("no cell is a triangle");
  if (!data.middles.empty() && data.middles.size() != data.triangles.size()) {
    refuse(fmt::format("{} flat and {} quadratic triangles: must be of one kind",
                       data.triangles.size() - data.middles.size(), data.middles.size()));
  }
}

}  // namespace vesica::shapes
