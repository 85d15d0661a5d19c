#include "gauged_relaxation.hpp"

namespace vesica::flow {

namespace {

constexpr Eigen::Index velocity_row = 3;

}  // namespace

GaugedRelaxation::GaugedRelaxation(const problem::State& start, const model::Model& model,
                                   int threads)
    : inner_(start.triangulation, model, threads),
      graph_(problem::make_normal_graph(*start.triangulation, start.values.positions)) {}

Eigen::VectorXd GaugedRelaxation::initial_values(const problem::State& start) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(size());
  y.head(inner_.size()) = inner_.layout().pack(start.values);
  return y;
}

problem::Unknowns GaugedRelaxation::unknowns(const problem::State& state) const {
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(size());
  rates.head(inner_.size()) = inner_.unknowns(state).rates;
  return {initial_values(state), rates};
}

problem::Fields GaugedRelaxation::values(double time, const Eigen::VectorXd& y) const {
  return inner_.values(time, without_gauge(y));
}

problem::Fields GaugedRelaxation::rates(const Eigen::VectorXd& y,
                                        const Eigen::VectorXd& y_rate) const {
  return inner_.rates(without_gauge(y), without_gauge(y_rate));
}

Eigen::VectorXd GaugedRelaxation::differential_mask() const {
  Eigen::VectorXd mask = Eigen::VectorXd::Zero(size());
  mask.head(inner_.size()) = inner_.differential_mask();
  return mask;
}

Eigen::VectorXd GaugedRelaxation::units(const problem::Scales& scales) const {
  Eigen::VectorXd units = Eigen::VectorXd::Constant(size(), scales.multiplier());
  units.head(inner_.size()) = inner_.units(scales);
  return units;
}

Eigen::VectorXd GaugedRelaxation::residual(const problem::EquationSettings& settings, double time,
                                           const Eigen::VectorXd& y,
                                           const Eigen::VectorXd& y_rate) const {
  const auto block = block_size();
  Eigen::VectorXd result(size());
  result.head(inner_.size()) =
      inner_.residual(settings, time, without_gauge(y), without_gauge(y_rate));
  const Eigen::VectorXd force = graph_.gauge * y.tail<6>();
  Eigen::VectorXd displacements(force.size());
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    result[i * block + velocity_row] += force[i];
    displacements[i] =
        graph_.directions.row(i).dot(y.segment<3>(i * block).transpose() - graph_.reference.row(i));
  }
  for (Eigen::Index k = 0; k < 6; ++k) {
    const auto column = graph_.gauge.col(k);
    result[inner_.size() + k] = column.isZero(0) ? y[inner_.size() + k] : column.dot(displacements);
  }
  return result;
}

linalg::BorderedMatrix GaugedRelaxation::make_matrix() const {
  linalg::BorderedMatrix matrix;
  matrix.block = inner_.make_matrix().block;
  const auto block = block_size();
  const auto inner = inner_.num_multipliers();
  matrix.columns = Eigen::MatrixXd::Zero(num_nodal(), num_multipliers());
  matrix.rows = Eigen::MatrixXd::Zero(num_multipliers(), num_nodal());
  matrix.corner = Eigen::MatrixXd::Zero(num_multipliers(), num_multipliers());
  for (Eigen::Index k = 0; k < 6; ++k) {
    if (graph_.gauge.col(k).isZero(0)) matrix.corner(inner + k, inner + k) = 1;
    for (Eigen::Index i = 0; i < graph_.gauge.rows(); ++i) {
      matrix.columns(i * block + velocity_row, inner + k) = graph_.gauge(i, k);
      matrix.rows.row(inner + k).segment<3>(i * block) =
          graph_.gauge(i, k) * graph_.directions.row(i);
    }
  }
  return matrix;
}

/// The border of the gauge is constant; make_matrix() has written it.
void GaugedRelaxation::jacobian(const problem::EquationSettings& settings,
                                const problem::JacobianWeights& weights, double time,
                                const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                                linalg::BorderedMatrix& matrix) const {
  const auto inner = inner_.num_multipliers();
  linalg::BorderedMatrix part{
      std::move(matrix.block), matrix.columns.leftCols(inner), matrix.rows.topRows(inner), {}};
  inner_.jacobian(settings, weights, time, without_gauge(y), without_gauge(y_rate), part);
  matrix.block = std::move(part.block);
  matrix.columns.leftCols(inner) = part.columns;
  matrix.rows.topRows(inner) = part.rows;
}

}  // namespace vesica::flow
