#include "vesica/problem/dof_layout.hpp"

namespace vesica::problem {

DofLayout::DofLayout(mesh::NodeIndex num_nodes, const model::Model& model)
    : num_nodes_(num_nodes), is_two_phase_(model.is_two_phase) {
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
  const auto values = fields.multipliers.in_order();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (multipliers_[i] >= 0) flat[num_nodal() + multipliers_[i]] = values[i].value_or(0.0);
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
  const auto value = [&](int constraint) -> std::optional<double> {
    if (multiplier(constraint) < 0) return std::nullopt;
    return flat[num_nodal() + multiplier(constraint)];
  };
  fields.multipliers = {value(0), value(1), value(2)};
  return fields;
}

Eigen::VectorXd DofLayout::differential_mask() const {
  Eigen::VectorXd mask = Eigen::VectorXd::Ones(size());
  for (Eigen::Index i = 0; i < num_nodes_; ++i) mask[i * block_size() + 3] = 0;
  mask.tail(num_multipliers_).setZero();
  return mask;
}

}  // namespace vesica::problem
