#include "minimiser_coordinates.hpp"

#include <limits>
#include <utility>

#include "vesica/linalg/dense.hpp"

namespace vesica::minimise {

namespace {

/// Constraints whose directions differ by less than this count as dependent.
constexpr double dependence = 1e-5;

Eigen::VectorXd column_norms(const Eigen::MatrixXd& columns) {
  return columns.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
}

Eigen::MatrixXd normalised(const Eigen::MatrixXd& columns) {
  return columns * column_norms(columns).cwiseInverse().asDiagonal();
}

/// Least-squares solution of smallest norm.
Eigen::VectorXd solve(const Eigen::MatrixXd& columns, const Eigen::VectorXd& rhs) {
  return linalg::singular_system(columns).solve(rhs, dependence);
}

}  // namespace

Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return columns;
  const auto system = linalg::singular_system(columns);
  return system.left.leftCols(system.rank(1e-6));
}

Eigen::VectorXd Slopes::multipliers() const {
  if (constraints.cols() == 0) return {};
  return -solve(normalised(constraints), energy).cwiseQuotient(column_norms(constraints));
}

Eigen::VectorXd Slopes::change_for(const Eigen::VectorXd& errors) const {
  if (constraints.cols() == 0) return Eigen::VectorXd::Zero(energy.size());
  const Eigen::MatrixXd columns = normalised(constraints);
  // least squares twice: columns (columns^T columns)^+ errors
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  return columns * solve(gram, errors.cwiseQuotient(column_norms(constraints)));
}

MinimiserCoordinates::MinimiserCoordinates(const EnergyMetric& metric,
                                           const problem::NormalGraph& graph)
    : metric_(&metric) {
  const auto n = graph.reference.rows();
  Eigen::MatrixXd columns(metric.size(), 6);
  Eigen::VectorXd gauge = Eigen::VectorXd::Zero(metric.size());
  for (Eigen::Index k = 0; k < 6; ++k) {
    gauge.head(n) = graph.gauge.col(k);
    columns.col(k) = metric.gather(gauge);
  }
  rigid_ = orthonormal_basis(columns);
}

void MinimiserCoordinates::absorb(const Eigen::MatrixXd& constraint_slopes,
                                  const Eigen::VectorXd& weights, double step) {
  step_ = step;
  if (constraint_slopes.cols() == 0) return;
  auto system = linalg::singular_system(constraint_slopes * weights.cwiseSqrt().asDiagonal());
  constrained_ = std::move(system.left);
  shrinkage_ = (1 + system.values.array().square()).rsqrt() - 1;
}

Eigen::VectorXd MinimiserCoordinates::change(const Eigen::VectorXd& y) const {
  return metric_->spread(without_rigid(rescale(y)));
}

Eigen::VectorXd MinimiserCoordinates::pull_back(const Eigen::VectorXd& gradient) const {
  return rescale(slope(gradient));
}

Eigen::VectorXd MinimiserCoordinates::slope(const Eigen::VectorXd& gradient) const {
  return without_rigid(metric_->gather(gradient));
}

Eigen::VectorXd MinimiserCoordinates::without_rigid(Eigen::VectorXd z) const {
  z -= rigid_ * (rigid_.transpose() * z);
  return z;
}

Eigen::VectorXd MinimiserCoordinates::rescale(Eigen::VectorXd y) const {
  if (constrained_.cols() > 0)
    y += constrained_ * shrinkage_.cwiseProduct(constrained_.transpose() * y);
  return step_ * y;
}

}  // namespace vesica::minimise
