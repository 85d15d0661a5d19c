#include "tangent_newton.hpp"

namespace vesica::minimise {

namespace {

constexpr int max_products = 200;
constexpr double resolution = 1e-3;  // of the lowest eigenvalue

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
                                double reduction, bool passes_saddles) const {
  NewtonStep result;
  result.change = -slopes_.change_for(errors);
  const Eigen::VectorXd curved =
      coordinates_.slope(hessian_.times(coordinates_.spread(result.change)));
  Eigen::VectorXd residual =
      along_constraints(-slopes_.energy - slopes_.constraints * multipliers - curved);
  Eigen::VectorXd direction = residual;
  double squared = residual.squaredNorm();
  const double small = reduction * reduction * squared;
  while (squared > small && result.products < max_products) {
    ++result.products;
    const Eigen::VectorXd image = times(direction);
    const double curvature = direction.dot(image);
    result.meets_saddle = result.meets_saddle || curvature <= 0;
    if (curvature == 0 || (curvature < 0 && !passes_saddles)) break;
    const double length = squared / curvature;
    result.change += length * direction;
    residual -= length * image;
    const double before = squared;
    squared = residual.squaredNorm();
    direction = residual + squared / before * direction;
  }
  return result;
}

solve::Eigenpair TangentHessian::lowest() const {
  return solve::lowest_eigenvalue([this](const Eigen::VectorXd& z) { return times(z); },
                                  coordinates_.size(), resolution);
}

}  // namespace vesica::minimise
