#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace vesica::mesh {

/// Disjoint sets of 0 .. size - 1; a set is named by its smallest member.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t size) : parent_(size), num_sets_(size) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  [[nodiscard]] std::size_t find(std::size_t member) {
    while (parent_[member] != member) {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  void join(std::size_t a, std::size_t b) {
    a = find(a);
    b = find(b);
    if (a == b) return;
    if (b < a) std::swap(a, b);
    parent_[b] = a;
    --num_sets_;
  }

  [[nodiscard]] std::size_t num_sets() const { return num_sets_; }

 private:
  std::vector<std::size_t> parent_;
  std::size_t num_sets_;
};

}  // namespace vesica::mesh
