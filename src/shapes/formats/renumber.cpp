#include "shapes/formats/renumber.hpp"

#include <cstddef>
#include <utility>

namespace vesica::shapes {

void renumber(SurfaceData& data, const std::vector<mesh::NodeIndex>& numbers,
              mesh::NodeIndex num_points) {
  std::vector<Eigen::Index> first(static_cast<std::size_t>(num_points), -1);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] < 0) continue;
    Eigen::Index& known = first[static_cast<std::size_t>(numbers[i])];
    if (known < 0) known = static_cast<Eigen::Index>(i);
  }
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Index i : first) points.push_back(data.points[static_cast<std::size_t>(i)]);
  data.points = std::move(points);
  for (mesh::PointField& field : data.fields) field.values = Eigen::VectorXd(field.values(first));
  for (auto* triangles : {&data.triangles, &data.middles}) {
    for (mesh::Corners& corners : *triangles) {
      for (mesh::NodeIndex& node : corners) node = numbers[static_cast<std::size_t>(node)];
    }
  }
}

void put_corners_first(SurfaceData& data) {
  std::vector<char> is_corner(data.points.size(), 0);
  for (const mesh::Corners& corners : data.triangles) {
    for (const mesh::NodeIndex node : corners) is_corner[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<mesh::NodeIndex> numbers(data.points.size());
  mesh::NodeIndex next = 0;
  for (const char wanted : {1, 0}) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      if (is_corner[i] == wanted) numbers[i] = next++;
    }
  }
  renumber(data, numbers, next);
}

}  // namespace vesica::shapes
