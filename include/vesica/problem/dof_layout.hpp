#pragma once

#include <Eigen/Core>
#include <array>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::problem {

/// Tells where the unknowns stand in the flat vector of an integrator: node by node x, y, z, kappa
/// and, with a phase field, c; then the multipliers of the active constraints in the order of
/// model::Constraints.
class DofLayout {
 public:
  DofLayout(mesh::NodeIndex num_nodes, const model::Model& model);

  [[nodiscard]] int block_size() const { return is_two_phase_ ? 5 : 4; }
  [[nodiscard]] bool is_two_phase() const { return is_two_phase_; }
  [[nodiscard]] Eigen::Index num_nodes() const { return num_nodes_; }
  [[nodiscard]] Eigen::Index num_nodal() const { return num_nodes_ * block_size(); }
  [[nodiscard]] int num_multipliers() const { return num_multipliers_; }
  [[nodiscard]] Eigen::Index size() const { return num_nodal() + num_multipliers_; }
  /// Returns the row of the multiplier of the constraint at a place of model::Constraints, behind
  /// the nodal unknowns; -1 if it is free.
  [[nodiscard]] int multiplier(int constraint) const {
    return multipliers_[static_cast<std::size_t>(constraint)];
  }

  /// Returns the fields as one vector, shape (size()).
  [[nodiscard]] Eigen::VectorXd pack(const Fields& fields) const;
  /// Returns the fields that are in such a vector, the inverse of `pack`.
  [[nodiscard]] Fields unpack(const Eigen::Ref<const Eigen::VectorXd>& flat) const;
  /// Returns the multipliers of the active constraints, shape (num_multipliers()), as one value for
  /// each constraint.
  [[nodiscard]] model::PerConstraint named(
      const Eigen::Ref<const Eigen::VectorXd>& multipliers) const;
  /// Returns a vector of shape (size()) with 1 where an unknown has a time derivative in the
  /// equations (x, c), 0 for kappa and the multipliers.
  [[nodiscard]] Eigen::VectorXd differential_mask() const;

 private:
  Eigen::Index num_nodes_;
  bool is_two_phase_;
  std::array<int, model::num_constraints> multipliers_{};
  int num_multipliers_ = 0;
};

}  // namespace vesica::problem
