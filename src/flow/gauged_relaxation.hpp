#pragma once

#include <memory>

#include "vesica/problem/normal_graph.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica::flow {

/// The weak form with the rigid gauge of a reference: six more multipliers mu_k with columns
/// gauge(i, k) in equation (a) of node i, and rows sum_i gauge(i, k) n_i . (x_i - X_i) = 0. They
/// stop the spurious rigid drift of the weak form, which otherwise slides the shape through its
/// mesh for ever, and a state at rest exists.
class GaugedRelaxation final : public problem::AssembledProblem {
 public:
  GaugedRelaxation(const problem::State& start, const model::Model& model, int threads);

  [[nodiscard]] const model::Model& model() const override { return inner_.model(); }
  [[nodiscard]] int block_size() const override { return inner_.block_size(); }
  [[nodiscard]] Eigen::Index num_nodal() const override { return inner_.num_nodal(); }
  [[nodiscard]] Eigen::Index num_multipliers() const override {
    return inner_.num_multipliers() + 6;
  }
  [[nodiscard]] Eigen::VectorXd initial_values(const problem::State& start) const override;
  [[nodiscard]] problem::Unknowns unknowns(const problem::State& state) const override;
  [[nodiscard]] problem::Fields values(double time, const Eigen::VectorXd& y) const override;
  [[nodiscard]] problem::Fields rates(const Eigen::VectorXd& y,
                                      const Eigen::VectorXd& y_rate) const override;
  [[nodiscard]] Eigen::VectorXd differential_mask() const override;
  [[nodiscard]] Eigen::VectorXd units(const problem::Scales& scales) const override;
  [[nodiscard]] Eigen::VectorXd residual(const problem::EquationSettings& settings, double time,
                                         const Eigen::VectorXd& y,
                                         const Eigen::VectorXd& y_rate) const override;
  [[nodiscard]] linalg::BorderedMatrix make_matrix() const override;
  void jacobian(const problem::EquationSettings& settings, const problem::JacobianWeights& weights,
                double time, const Eigen::VectorXd& y, const Eigen::VectorXd& y_rate,
                linalg::BorderedMatrix& matrix) const override;

 private:
  [[nodiscard]] Eigen::VectorXd without_gauge(const Eigen::VectorXd& y) const {
    return y.head(inner_.size());
  }

  problem::RelaxationProblem inner_;
  problem::NormalGraph graph_;
};

}  // namespace vesica::flow
