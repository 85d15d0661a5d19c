#include "repair.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

#include "mesh/disjoint_sets.hpp"
#include "shapes/formats/renumber.hpp"

namespace vesica::shapes {
namespace {

using Cell = std::array<std::int64_t, 3>;

struct HashOfCell {
  std::size_t operator()(const Cell& cell) const {
    std::size_t hash = 0;
    for (const std::int64_t index : cell)
      hash = hash * 0x9e3779b97f4a7c15U + static_cast<std::size_t>(index);
    return hash;
  }
};

/// Points closer than this are one: a millionth of the diagonal of the bounding box.
double merging_distance(const SurfaceData& data) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : data.points) box.extend(point);
  return data.points.empty() ? 0 : 1e-6 * box.diagonal().norm();
}

/// For each point the first one at its place.
std::vector<mesh::NodeIndex> first_at_place(const SurfaceData& data) {
  const double distance = std::max(merging_distance(data), 1e-300);
  std::unordered_map<Cell, std::vector<mesh::NodeIndex>, HashOfCell> cells;
  std::vector<mesh::NodeIndex> first;
  const auto find = [&](const Eigen::Vector3d& point, const Cell& centre) -> mesh::NodeIndex {
    for (int k = 0; k < 27; ++k) {
      const Cell cell{centre[0] + k % 3 - 1, centre[1] + k / 3 % 3 - 1, centre[2] + k / 9 - 1};
      const auto known = cells.find(cell);
      if (known == cells.end()) continue;
      for (const mesh::NodeIndex i : known->second) {
        if ((data.points[static_cast<std::size_t>(i)] - point).norm() <= distance) return i;
      }
    }
    return -1;
  };
  for (const Eigen::Vector3d& point : data.points) {
    Cell cell{};
    for (int axis = 0; axis < 3; ++axis) {
      cell[static_cast<std::size_t>(axis)] =
          static_cast<std::int64_t>(std::floor((point[axis] - data.points[0][axis]) / distance));
    }
    const auto index = static_cast<mesh::NodeIndex>(first.size());
    const mesh::NodeIndex found = find(point, cell);
    first.push_back(found < 0 ? index : found);
    if (found < 0) cells[cell].push_back(index);
  }
  return first;
}

class Repair {
 public:
  explicit Repair(SurfaceData& data) : data_(data) {}

  std::vector<std::string> run() {
    merge_points();
    drop_empty_triangles();
    orient_and_keep_largest();
    drop_unused_points();
    return std::move(done_);
  }

 private:
  template <class... Args>
  void note(std::size_t count, fmt::format_string<Args...> text, Args&&... args) {
    if (count > 0) done_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  void merge_points() {
    std::vector<mesh::NodeIndex> numbers = first_at_place(data_);
    mesh::NodeIndex next = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const auto first = static_cast<std::size_t>(numbers[i]);
      numbers[i] = first == i ? next++ : numbers[first];
    }
    const std::size_t merged = numbers.size() - static_cast<std::size_t>(next);
    note(merged, "{} of {} vertices merged with others at the same place", merged, numbers.size());
    if (merged > 0) renumber(data_, numbers, next);
  }

  /// Triangles that repeat a corner, and copies of others.
  void drop_empty_triangles() {
    std::set<mesh::Corners> known;
    std::vector<char> keeps(data_.triangles.size(), 0);
    for (std::size_t t = 0; t < keeps.size(); ++t) {
      mesh::Corners corners = data_.triangles[t];
      std::ranges::sort(corners);
      const bool is_empty = corners[0] == corners[1] || corners[1] == corners[2];
      keeps[t] = !is_empty && known.insert(corners).second ? 1 : 0;
    }
    const std::size_t dropped = keep(keeps);
    note(dropped, "{} of {} triangles dropped that repeat a corner or another triangle", dropped,
         keeps.size());
  }

  std::size_t keep(const std::vector<char>& keeps) {
    std::size_t next = 0;
    for (std::size_t t = 0; t < keeps.size(); ++t) {
      if (keeps[t] == 0) continue;
      data_.triangles[next] = data_.triangles[t];
      if (!data_.middles.empty()) data_.middles[next] = data_.middles[t];
      ++next;
    }
    data_.triangles.resize(next);
    if (!data_.middles.empty()) data_.middles.resize(next);
    return keeps.size() - next;
  }

  struct Side {
    mesh::NodeIndex low, high;
    std::size_t triangle;
    bool is_ascending;
  };

  /// Pairs of triangles with a common edge that no third one has.
  [[nodiscard]] std::vector<std::array<Side, 2>> neighbours() const {
    std::vector<Side> sides;
    for (std::size_t t = 0; t < data_.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const mesh::NodeIndex a = data_.triangles[t][i];
        const mesh::NodeIndex b = data_.triangles[t][(i + 1) % 3];
        sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
      }
    }
    const auto edge = [](const Side& side) { return std::tie(side.low, side.high); };
    std::ranges::sort(sides, {}, [&](const Side& side) {
      return std::tuple(side.low, side.high, side.triangle);
    });
    std::vector<std::array<Side, 2>> pairs;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
      while (end < sides.size() && edge(sides[end]) == edge(sides[begin])) ++end;
      if (end - begin == 2) pairs.push_back({sides[begin], sides[begin + 1]});
    }
    return pairs;
  }

  /// For each triangle whether it runs against the first one of its part. Set 2 t stands for
  /// triangle t as it is, 2 t + 1 for the turned one.
  void orient_and_keep_largest() {
    const std::size_t count = data_.triangles.size();
    mesh::DisjointSets parts(count);
    mesh::DisjointSets orientations(2 * count);
    for (const auto& [a, b] : neighbours()) {
      const std::size_t against = a.is_ascending == b.is_ascending ? 1 : 0;
      parts.join(a.triangle, b.triangle);
      orientations.join(2 * a.triangle, 2 * b.triangle + against);
      orientations.join(2 * a.triangle + 1, 2 * b.triangle + 1 - against);
    }
    std::vector<char> is_turned(count, 0);
    std::unordered_map<std::size_t, double> volumes;
    for (std::size_t t = 0; t < count; ++t) {
      const std::size_t part = parts.find(t);
      is_turned[t] = orientations.find(2 * t) == orientations.find(2 * part) ? 0 : 1;
      volumes[part] += (is_turned[t] != 0 ? -1 : 1) * volume_below(t);
    }
    for (std::size_t t = 0; t < count; ++t)
      is_turned[t] ^= volumes[parts.find(t)] < 0 ? 1 : 0;  // outwards
    keep_largest(parts, volumes, is_turned);
  }

  /// Six times that of the tetrahedron of a triangle and the first point.
  [[nodiscard]] double volume_below(std::size_t t) const {
    const auto at = [&](std::size_t i) -> Eigen::Vector3d {
      return data_.points[static_cast<std::size_t>(data_.triangles[t][i])] - data_.points[0];
    };
    return at(0).dot(at(1).cross(at(2)));
  }

  void keep_largest(mesh::DisjointSets& parts,
                    const std::unordered_map<std::size_t, double>& volumes,
                    std::vector<char>& is_turned) {
    const auto largest = std::ranges::max_element(volumes, {}, [](const auto& part) {
      return std::tuple(std::abs(part.second), part.first);
    });
    std::size_t turned = 0;
    std::vector<char> keeps;
    for (std::size_t t = 0; t < is_turned.size(); ++t) {
      keeps.push_back(parts.find(t) == largest->first ? 1 : 0);
      if (is_turned[t] == 0) continue;
      turned += static_cast<std::size_t>(keeps[t]);
      std::swap(data_.triangles[t][1], data_.triangles[t][2]);
      if (!data_.middles.empty()) std::swap(data_.middles[t][0], data_.middles[t][2]);
    }
    const std::size_t dropped = keep(keeps);
    note(dropped, "the largest of {} parts kept, {} of {} triangles", volumes.size(),
         keeps.size() - dropped, keeps.size());
    note(turned, "{} of {} triangles turned", turned, keeps.size() - dropped);
  }

  void drop_unused_points() {
    std::vector<mesh::NodeIndex> numbers(data_.points.size(), -1);
    for (const auto* triangles : {&data_.triangles, &data_.middles}) {
      for (const mesh::Corners& corners : *triangles) {
        for (const mesh::NodeIndex node : corners) numbers[static_cast<std::size_t>(node)] = 0;
      }
    }
    mesh::NodeIndex next = 0;
    for (mesh::NodeIndex& number : numbers) {
      if (number == 0) number = next++;
    }
    const std::size_t dropped = numbers.size() - static_cast<std::size_t>(next);
    note(dropped, "{} of {} vertices dropped that no triangle uses", dropped, numbers.size());
    if (dropped > 0) renumber(data_, numbers, next);
  }

  SurfaceData& data_;
  std::vector<std::string> done_;
};

}  // namespace

std::vector<std::string> repair(SurfaceData& data) {
  if (data.triangles.empty()) return {};
  return Repair(data).run();
}

std::string coincident_points(const SurfaceData& data) {
  const std::vector<mesh::NodeIndex> first = first_at_place(data);
  std::string example;
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (static_cast<std::size_t>(first[i]) == i) continue;
    if (count++ == 0) example = fmt::format("nodes {} and {} coincide", first[i], i);
  }
  if (count < 2) return example;
  return fmt::format("{}, and so do {} other pairs", example, count - 1);
}

}  // namespace vesica::shapes
