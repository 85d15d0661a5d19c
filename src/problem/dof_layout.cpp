#include "vesica/problem/dof_layout.hpp"

namespace vesica::problem {

DofLayout::DofLayout(mesh::NodeIndex num_nodes, const model::Model& model)
    : num_nodes_(num_nodes), is_two_phase_(model.is_two_phase) {
  multipliers_.fill(-1);
  for (const int place : model::active_constraints(model))
    multipliers_[static_cast<std::size_t>(place)] = num_multipliers_++;
}

Eigen::VectorXd DofLayout::pack(const Fields& fields) const {
  Eigen::VectorXd flat(size());
  const auto block = block_size();
  for (Eigen::Index i = 0; i < num_nodes_; ++i) {
    flat.segment<3>(i * block) = fields.positions.row(i).transpose();
    flat[i * block + 3] = fields.mean_curvature[i];
    if (is_two_phase_) flat[i * block + 4] = fields.order_parameter[i];
  }
  for (std::size_t i = 0; i < multipliers_.size(); ++i) {
    if (multipliers_[i] >= 0)
      flat[num_nodal() + multipliers_[i]] = fields.multipliers[i].value_or(0.0);
  }
  return flat;
}

Fields DofLayout::unpack(const Eigen::Ref<const Eigen::VectorXd>& flat) const {
  Fields fields;
  const auto block = block_size();
  fields.positions.resize(num_nodes_, 3);
  fields.mean_curvature.resize(num_nodes_);
  if (is_two_phase_) fields.order_parameter.resize(num_nodes_);
  for (Eigen::Index i = 0; i < num_nodes_; ++i) {
    fields.positions.row(i) = flat.segment<3>(i * block).transpose();
    fields.mean_curvature[i] = flat[i * block + 3];
    if (is_two_phase_) fields.order_parameter[i] = flat[i * block + 4];
  }
  fields.multipliers = named(flat.tail(num_multipliers_));
  return fields;
}

model::PerConstraint DofLayout::named(const Eigen::Ref<const Eigen::VectorXd>& multipliers) const {
  model::PerConstraint result;
  for (std::size_t i = 0; i < multipliers_.size(); ++i) {
    if (multipliers_[i] >= 0) result[i] = multipliers[multipliers_[i]];
  }
  return result;
}

Eigen::VectorXd DofLayout::differential_mask() const {
  Eigen::VectorXd mask = Eigen::VectorXd::Ones(size());
  for (Eigen::Index i = 0; i < num_nodes_; ++i) mask[i * block_size() + 3] = 0;
  mask.tail(num_multipliers_).setZero();
  return mask;
}

}  // namespace vesica::problem
