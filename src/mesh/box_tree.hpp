#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace vesica::mesh {

/// Binary tree of axis-parallel boxes over the boxes of numbered items, for searches by distance
/// and for overlaps.
class BoxTree {
 public:
  explicit BoxTree(std::vector<Eigen::AlignedBox3d> boxes);

  /// Calls visit(item) -> squared distance of the best found so far, near items first, and leaves
  /// out those whose box is not nearer than that.
  template <class Visit>
  void search(const Eigen::Vector3d& point, Visit visit) const;

  /// Calls visit(item) for every item whose box meets `box`.
  template <class Visit>
  void visit_meeting(const Eigen::AlignedBox3d& box, Visit visit) const;

 private:
  struct Node {
    Eigen::AlignedBox3d box;
    std::int32_t item = -1;   ///< of a leaf, else -1
    std::int32_t right = -1;  ///< second child; the first is the next node
  };
  /// Halving bounds the depth by 32 for any number of items.
  static constexpr std::size_t max_depth = 34;

  void build(std::span<std::int32_t> items, std::span<const Eigen::AlignedBox3d> boxes);

  std::vector<Node> nodes_;
};

template <class Visit>
void BoxTree::search(const Eigen::Vector3d& point, Visit visit) const {
  struct Pending {
    std::int32_t node;
    double squared_distance;
  };
  std::array<Pending, max_depth> stack;
  std::size_t size = 0;
  const auto push = [&](std::int32_t node, double squared) { stack[size++] = {node, squared}; };
  const auto squared_distance = [&](std::int32_t node) {
    return nodes_[static_cast<std::size_t>(node)].box.squaredExteriorDistance(point);
  };
  double best = std::numeric_limits<double>::infinity();
  push(0, squared_distance(0));
  while (size > 0) {
    const Pending next = stack[--size];
    if (!(next.squared_distance < best)) continue;
    const Node& node = nodes_[static_cast<std::size_t>(next.node)];
    if (node.item >= 0) {
      best = visit(node.item);
      continue;
    }
    const std::int32_t left = next.node + 1;
    const double to_left = squared_distance(left);
    const double to_right = squared_distance(node.right);
    if (to_left < to_right) {
      push(node.right, to_right);
      push(left, to_left);
    } else {
      push(left, to_left);
      push(node.right, to_right);
    }
  }
}

template <class Visit>
void BoxTree::visit_meeting(const Eigen::AlignedBox3d& box, Visit visit) const {
  std::array<std::int32_t, max_depth> stack;
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const std::int32_t place = stack[--size];
    const Node& node = nodes_[static_cast<std::size_t>(place)];
    if (!node.box.intersects(box)) continue;
    if (node.item >= 0) {
      visit(node.item);
      continue;
    }
    stack[size++] = node.right;
    stack[size++] = place + 1;
  }
}

}  // namespace vesica::mesh
