#include "tangent_newton.hpp"

#include <cmath>

namespace vesica::minimise {

namespace {

constexpr int max_products = 200;
constexpr double resolution = 1e-3;  // of the lowest eigenvalue

/// The positive t with |along + t direction| = radius.
double length_to_radius(const Eigen::VectorXd& along, const Eigen::VectorXd& direction,
                        double radius) {
  const double a = direction.squaredNorm();
  const double b = along.dot(direction);
  const double c = radius * radius - along.squaredNorm();
  return c / (b + std::sqrt(b * b + a * c));
}

}  // namespace

TangentHessian::TangentHessian(const ReducedHessian& hessian,
                               const MinimiserCoordinates& coordinates, const Slopes& slopes)
    : hessian_(hessian),
      coordinates_(coordinates),
      slopes_(slopes),
      constrained_(orthonormal_basis(slopes.constraints)) {}

Eigen::VectorXd TangentHessian::times(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd tangent = along_constraints(coordinates_.without_rigid(z));
  // what is not tangent gets the eigenvalue 1, far from the lowest
  return along_constraints(coordinates_.slope(hessian_.times(coordinates_.spread(tangent)))) + z -
         tangent;
}

Eigen::VectorXd TangentHessian::along_constraints(Eigen::VectorXd z) const {
  z -= constrained_ * (constrained_.transpose() * z);
  return z;
}

NewtonStep TangentHessian::step(const Eigen::VectorXd& multipliers, const Eigen::VectorXd& errors,
                                double reduction, std::optional<double> radius) const {
  NewtonStep result;
  result.across = -slopes_.change_for(errors);
  result.along.setZero(coordinates_.size());
  const Eigen::VectorXd curved =
      coordinates_.slope(hessian_.times(coordinates_.spread(result.across)));
  result.across_change = result.across.dot(curved) / 2;
  const Eigen::VectorXd start =
      along_constraints(-slopes_.energy - slopes_.constraints * multipliers - curved);
  Eigen::VectorXd residual = start;
  Eigen::VectorXd direction = start;
  double squared = residual.squaredNorm();
  const double small = reduction * reduction * squared;
  while (squared > small && result.products < max_products && !result.is_bounded) {
    ++result.products;
    const Eigen::VectorXd image = times(direction);
    const double curvature = direction.dot(image);
    result.meets_saddle = result.meets_saddle || curvature <= 0;
    if (curvature == 0 && !radius) break;
    double length = squared / curvature;
    if (radius) {
      const double end = length_to_radius(result.along, direction, *radius);
      result.is_bounded = curvature <= 0 || length >= end;
      if (result.is_bounded) length = end;
    }
    result.along += length * direction;
    residual -= length * image;
    const double before = squared;
    squared = residual.squaredNorm();
    direction = residual + squared / before * direction;
  }
  result.slope = -start.dot(result.along);
  result.curvature = result.along.dot(start - residual);
  return result;
}

solve::Eigenpair TangentHessian::lowest() const {
  return solve::lowest_eigenvalue([this](const Eigen::VectorXd& z) { return times(z); },
                                  coordinates_.size(), resolution);
}

}  // namespace vesica::minimise
