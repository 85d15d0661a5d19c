#include "box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace vesica::mesh {

BoxTree::BoxTree(std::vector<Eigen::AlignedBox3d> boxes) {
  std::vector<std::int32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0);
  nodes_.reserve(2 * boxes.size());
  build(items, boxes);
}

void BoxTree::build(std::span<std::int32_t> items, std::span<const Eigen::AlignedBox3d> boxes) {
  const auto box_of = [&](std::int32_t item) -> const Eigen::AlignedBox3d& {
    return boxes[static_cast<std::size_t>(item)];
  };
  Node node;
  for (const std::int32_t item : items) node.box.extend(box_of(item));
  const std::size_t place = nodes_.size();
  nodes_.push_back(node);
  if (items.size() == 1) {
    nodes_[place].item = items.front();
    return;
  }
  Eigen::Index axis = 0;
  node.box.sizes().maxCoeff(&axis);
  const std::size_t half = items.size() / 2;
  std::nth_element(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
                   [&](std::int32_t a, std::int32_t b) {
                     return box_of(a).center()[axis] < box_of(b).center()[axis];
                   });
  build(items.first(half), boxes);
  nodes_[place].right = static_cast<std::int32_t>(nodes_.size());
  build(items.subspan(half), boxes);
}

}  // namespace vesica::mesh
