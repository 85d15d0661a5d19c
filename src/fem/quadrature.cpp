#include "vesica/fem/quadrature.hpp"

#include <array>
#include <cmath>

namespace vesica::fem {

namespace {

std::array<QuadraturePoint, 7> make_rule() {
  const double root = std::sqrt(15.0);
  std::array<QuadraturePoint, 7> rule;
  rule[0] = {1.0 / 3, 1.0 / 3, 9.0 / 80, {}};
  std::size_t next = 1;
  for (const double sign : {-1.0, 1.0}) {
    const double a = (6 + sign * root) / 21;
    const double weight = (155 + sign * root) / 2400;
    rule[next++] = {a, a, weight, {}};
    rule[next++] = {1 - 2 * a, a, weight, {}};
    rule[next++] = {a, 1 - 2 * a, weight, {}};
  }
  for (auto& point : rule) point.shape = shape_values(point.u, point.v);
  return rule;
}

}  // namespace

std::span<const QuadraturePoint> triangle_rule() {
  static const std::array<QuadraturePoint, 7> rule = make_rule();
  return rule;
}

}  // namespace vesica::fem
