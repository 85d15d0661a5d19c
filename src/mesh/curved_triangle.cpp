#include "curved_triangle.hpp"

#include <algorithm>
#include <limits>

#include "vesica/mesh/local_nodes.hpp"

namespace vesica::mesh {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int max_iterations = 30;
constexpr int max_halvings = 10;
/// Steps below the first are taken without a look at the distance, whose rounding errors would
/// refuse them; one below the second is the last.
constexpr double trusted_step = 1e-4;
constexpr double last_step = 1e-8;

bool is_inside(const Vector2d& p) { return p.x() >= 0 && p.y() >= 0 && p.x() + p.y() <= 1; }

/// Minimum of g . s + 1/2 s . H s with H positive definite, s = q - p, over q in the reference
/// triangle.
Vector2d minimum_on_triangle(const Matrix2d& h, const Vector2d& g, const Vector2d& p) {
  const double determinant = h(0, 0) * h(1, 1) - h(0, 1) * h(0, 1);
  const Vector2d free_minimum =
      p -
      Vector2d(h(1, 1) * g.x() - h(0, 1) * g.y(), h(0, 0) * g.y() - h(0, 1) * g.x()) / determinant;
  if (is_inside(free_minimum)) return free_minimum;
  const std::array<Vector2d, 3> corners = {Vector2d(0, 0), Vector2d(1, 0), Vector2d(0, 1)};
  Vector2d best = p;
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2d along = corners[(i + 1) % 3] - corners[i];
    const Vector2d start = corners[i] - p;
    const double t = -along.dot(g + h * start) / along.dot(h * along);
    const Vector2d s = start + std::clamp(t, 0.0, 1.0) * along;
    const double value = s.dot(g + 0.5 * (h * s));
    if (value < smallest) {
      smallest = value;
      best = p + s;
    }
  }
  return best;
}

}  // namespace

CurvedTriangle::CurvedTriangle(const QuadraticTriangle& nodes, const Positions& positions) {
  std::array<Vector3d, 6> x;
  for (std::size_t i = 0; i < 6; ++i) x[i] = positions.row(nodes[i]);
  a_ = {x[0],
        4 * x[3] - 3 * x[0] - x[1],
        4 * x[5] - 3 * x[0] - x[2],
        2 * (x[0] + x[1]) - 4 * x[3],
        4 * (x[0] - x[3] + x[4] - x[5]),
        2 * (x[0] + x[2]) - 4 * x[5]};
}

Vector3d CurvedTriangle::point(const Vector2d& p) const {
  const double u = p.x();
  const double v = p.y();
  return a_[0] + u * (a_[1] + u * a_[3] + v * a_[4]) + v * (a_[2] + v * a_[5]);
}

Vector3d CurvedTriangle::area_vector(const Vector2d& p) const {
  return derivative_u(p).cross(derivative_v(p));
}

Eigen::AlignedBox3d CurvedTriangle::box() const {
  // Bezier coefficients of the polynomial, by its polar form.
  Eigen::AlignedBox3d box(a_[0]);
  box.extend(point({1, 0}));
  box.extend(point({0, 1}));
  box.extend(a_[0] + 0.5 * a_[1]);
  box.extend(a_[0] + 0.5 * a_[2]);
  box.extend(a_[0] + 0.5 * (a_[1] + a_[2] + a_[4]));
  return box;
}

Vector2d CurvedTriangle::closest_node(const Vector3d& target) const {
  Vector2d best(0, 0);
  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& [u, v] : node_parameters) {
    const double squared = (point({u, v}) - target).squaredNorm();
    if (squared < smallest) {
      smallest = squared;
      best = {u, v};
    }
  }
  return best;
}

Vector2d CurvedTriangle::model_minimum(const Vector2d& p, const Vector3d& offset) const {
  const Vector3d x_u = derivative_u(p);
  const Vector3d x_v = derivative_v(p);
  const Vector2d gradient(x_u.dot(offset), x_v.dot(offset));
  Matrix2d metric;
  metric << x_u.squaredNorm(), x_u.dot(x_v), x_u.dot(x_v), x_v.squaredNorm();
  const double twist = a_[4].dot(offset);
  Matrix2d hessian = metric;
  hessian(0, 0) += 2 * a_[3].dot(offset);
  hessian(1, 1) += 2 * a_[5].dot(offset);
  hessian(0, 1) += twist;
  hessian(1, 0) += twist;
  const double trace = metric.trace();
  const bool is_convex = hessian.trace() > 0 && hessian.determinant() > 1e-6 * metric.determinant();
  if (is_convex) return minimum_on_triangle(hessian, gradient, p);
  metric.diagonal().array() += 1e-12 * trace + std::numeric_limits<double>::min();
  return minimum_on_triangle(metric, gradient, p);
}

CurvedTriangle::ClosestPoint CurvedTriangle::closest(const Vector3d& target) const {
  Vector2d p = closest_node(target);
  Vector3d offset = point(p) - target;
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Vector2d step = model_minimum(p, offset) - p;
    const double size = step.cwiseAbs().maxCoeff();
    Vector3d next = point(p + step) - target;
    int halvings = 0;
    while (size > trusted_step && next.squaredNorm() > offset.squaredNorm()) {
      if (++halvings > max_halvings) return {p, offset.squaredNorm()};
      step *= 0.5;
      next = point(p + step) - target;
    }
    p += step;
    offset = next;
    if (size < last_step) break;
  }
  return {p, offset.squaredNorm()};
}

}  // namespace vesica::mesh
