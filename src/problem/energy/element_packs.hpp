#pragma once

#include <algorithm>
#include <memory>
#include <span>

#include "core/pack.hpp"
#include "energy_element.hpp"
#include "vesica/core/dual.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::problem {

/// Eight numbers with their derivatives along one direction.
using PackDual = Dual<1, Pack>;

/// A change of the arguments of the energy, along which derivatives are taken.
struct EnergyChange {
  const EnergyFields& fields;
  const EnergyRates& rates;
};

/// What is summed over elements: the numbers themselves, or their derivatives along the change.
inline const Pack& summand(const Pack& a) { return a; }
inline const Pack& summand(const PackDual& a) { return a.derivatives[0]; }
template <class T>
Vec3<Pack> summand(const Vec3<T>& a) {
  return {summand(a.x), summand(a.y), summand(a.z)};
}

inline Pack& values_of(Pack& a) { return a; }
inline Pack& values_of(PackDual& a) { return a.value; }
inline void put_change(Pack&, int, double) {}
inline void put_change(PackDual& a, int lane, double change) { a.derivatives[0].set(lane, change); }

/// Calls visit(first) for every eighth triangle, on `threads` threads.
template <class Visit>
void for_each_pack(int num_triangles, int threads, const Visit& visit) {
  parallel_for((num_triangles + Pack::size - 1) / Pack::size, threads, [&](int begin, int end) {
    for (int pack = begin; pack < end; ++pack) visit(pack * Pack::size);
  });
}

template <class T>
void put(T& number, int lane, double value, double change) {
  values_of(number).set(lane, value);
  put_change(number, lane, change);
}

template <class T>
void put(Vec3<T>& vector, int lane, const Vec3<double>& value, const Vec3<double>& change) {
  put(vector.x, lane, value.x, change.x);
  put(vector.y, lane, value.y, change.y);
  put(vector.z, lane, value.z, change.z);
}

/// Returns the fields of the eight elements from the one of number `first` on; lanes beyond the
/// last one repeat it. With a change, T = PackDual.
template <class T>
ElementFields<T> element_pack(const mesh::Triangulation& triangulation, int first,
                              const EnergyFields& fields, const EnergyRates& rates,
                              const EnergyChange* change = nullptr) {
  ElementFields<T> pack;
  const auto& triangles = triangulation.triangles();
  for (int lane = 0; lane < Pack::size; ++lane) {
    const auto t = std::min(static_cast<std::size_t>(first + lane), triangles.size() - 1);
    const auto element = energy_element(fields, rates, triangles[t]);
    EnergyElement moved;
    if (change != nullptr) moved = energy_element(change->fields, change->rates, triangles[t]);
    if (change == nullptr || change->fields.order_parameter.size() == 0) moved.c = {};
    for (std::size_t i = 0; i < 6; ++i) {
      put(pack.x[i], lane, element.x[i], moved.x[i]);
      put(pack.p[i], lane, element.p[i], moved.p[i]);
      put(pack.velocity[i], lane, element.velocity[i], moved.velocity[i]);
      put(pack.c[i], lane, element.c[i], moved.c[i]);
      put(pack.c_rate[i], lane, element.c_rate[i], moved.c_rate[i]);
    }
  }
  return pack;
}

/// Puts what is around the elements of a pack into it.
template <class T>
void surround(const mesh::Triangulation& triangulation, int first, const Surroundings& around,
              ElementFields<T>& pack) {
  const auto& triangles = triangulation.triangles();
  for (int lane = 0; lane < Pack::size; ++lane) {
    const auto t = std::min(static_cast<std::size_t>(first + lane), triangles.size() - 1);
    for (std::size_t i = 0; i < 6; ++i) {
      const auto node = triangles[t][i];
      pack.vertex_angle[i].set(lane, around.vertex_angles[node]);
      if (around.directions.rows() > 0)
        put(pack.normal[i], lane, row_of(around.directions, node), {});
    }
  }
}

/// Numbers of all elements, each of which is written before it is read: not set to zero first.
class ElementNumbers {
 public:
  ElementNumbers(int num_triangles, std::size_t per_triangle)
      : size_(static_cast<std::size_t>(num_triangles) * per_triangle),
        numbers_(std::make_unique_for_overwrite<double[]>(size_)) {}

  [[nodiscard]] std::span<double> span() { return {numbers_.get(), size_}; }
  [[nodiscard]] std::span<const double> span() const { return {numbers_.get(), size_}; }

 private:
  std::size_t size_;
  std::unique_ptr<double[]> numbers_;
};

/// Writes what a pack of elements has at its nodes to entries of shape (T, Size).
template <std::size_t Size>
void store(const std::array<Pack, Size>& table, int first, std::span<double> local) {
  const auto begin = static_cast<std::size_t>(first) * Size;
  const auto lanes =
      std::min<std::size_t>(Pack::size, local.size() / Size - static_cast<std::size_t>(first));
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    for (std::size_t k = 0; k < Size; ++k)
      local[begin + lane * Size + k] = table[k][static_cast<int>(lane)];
  }
}

inline void add(const Vec3<Pack>& a, Pack* out) {
  out[0] += a.x;
  out[1] += a.y;
  out[2] += a.z;
}

/// Returns the sum over the three derivatives of an integrand times those of the shape function of
/// node i.
template <class V>
V test_with(const fem::ShapeValues& shape, std::size_t i, const V& value, const V& du,
            const V& dv) {
  return shape.value[i] * value + shape.du[i] * du + shape.dv[i] * dv;
}

}  // namespace vesica::problem
