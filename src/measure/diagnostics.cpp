#include "vesica/measure/diagnostics.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <tuple>

#include "problem/point_equations.hpp"
#include "problem/rigid_modes.hpp"
#include "vesica/fem/recovery.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::measure {

namespace {

bool needs_shape_operator(const model::Material& material) {
  const auto& k_g = material.gaussian_rigidity;
  return k_g.phase_1 != 0 || k_g.phase_2 != 0;
}

fem::NodalShapeOperator shape_operator_of(const model::Material& material,
                                          const problem::State& state) {
  if (!needs_shape_operator(material))
    return fem::NodalShapeOperator::Zero(state.triangulation->num_nodes(), 6);
  const fem::NodeGraph graph(*state.triangulation);
  return fem::recover_shape_operator(*state.triangulation, graph, state.values.positions, 0);
}

model::SurfacePoint<double> point_of(const problem::State& state,
                                     const fem::NodalShapeOperator& shape_operator,
                                     const fem::SurfaceSample& sample) {
  model::SurfacePoint<double> point;
  point.position = fem::vector_at(state.values.positions, sample);
  point.normal = sample.frame.normal;
  point.mean_curvature = fem::scalar_at(state.values.mean_curvature, sample);
  point.mean_curvature_gradient = fem::gradient_at(state.values.mean_curvature, sample);
  const auto q = fem::combine<6>(shape_operator, sample.triangle, sample.shape.value);
  point.shape_operator = {q[0], q[1], q[2], q[3], q[4], q[5]};
  point.order_parameter = 1;
  if (state.is_two_phase()) {
    point.order_parameter = fem::scalar_at(state.values.order_parameter, sample);
    point.order_parameter_gradient = fem::gradient_at(state.values.order_parameter, sample);
  }
  return point;
}

/// Integrals of all energies and constrained functionals, in the order of the two lists.
struct Integrals {
  std::array<double, std::tuple_size_v<model::Energies>> energies{};
  std::array<double, model::num_constraints> constraints{};
};

Integrals integrate(const model::Physics& physics, const problem::State& state) {
  const auto shape_operator = shape_operator_of(physics.material, state);
  Integrals sum;
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const auto point = point_of(state, shape_operator, sample);
        std::size_t index = 0;
        const auto add_energy = [&]<class Energy>(const Energy&) {
          if (problem::takes_part<Energy>(physics))
            sum.energies[index] += sample.weight * Energy::density(physics.material, point);
          ++index;
        };
        std::apply([&](const auto&... energy) { (add_energy(energy), ...); }, model::Energies{});
        index = 0;
        const auto add_constraint = [&]<class Constraint>(const Constraint&) {
          if (problem::takes_part<Constraint>(physics))
            sum.constraints[index] += sample.weight * Constraint::density(point);
          ++index;
        };
        std::apply([&](const auto&... constraint) { (add_constraint(constraint), ...); },
                   model::Constraints{});
      });
  return sum;
}

/// ||v_nu|| and ||v_tau||, and ||v_nu|| after the least-squares rigid motion is removed; modes that
/// do not move the shape (rotations of a sphere) are left out.
VelocityNorms velocity_norms(const problem::State& state) {
  if (state.rates.positions.rows() == 0) return {};
  const auto centre = problem::centroid(*state.triangulation, state.values.positions);
  problem::RigidGram gram = problem::RigidGram::Zero();
  problem::RigidModes projection = problem::RigidModes::Zero();
  double normal_squared = 0;
  double tangential_squared = 0;
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const auto velocity = fem::vector_at(state.rates.positions, sample);
        const double normal = dot(velocity, sample.frame.normal);
        const auto modes = problem::rigid_modes(fem::vector_at(state.values.positions, sample),
                                                centre, sample.frame.normal);
        gram += sample.weight * modes * modes.transpose();
        projection += sample.weight * normal * modes;
        normal_squared += sample.weight * normal * normal;
        tangential_squared += sample.weight * (dot(velocity, velocity) - normal * normal);
      });
  const Eigen::SelfAdjointEigenSolver<problem::RigidGram> eigen(gram);
  problem::RigidModes coefficients = eigen.eigenvectors().transpose() * projection;
  for (int i = 0; i < 6; ++i) {
    const double value = eigen.eigenvalues()[i];
    coefficients[i] = value > 1e-6 * eigen.eigenvalues()[5] ? coefficients[i] / value : 0;
  }
  const problem::RigidModes rigid = eigen.eigenvectors() * coefficients;
  double rest_squared = 0;
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const double normal =
            dot(fem::vector_at(state.rates.positions, sample), sample.frame.normal);
        const auto modes = problem::rigid_modes(fem::vector_at(state.values.positions, sample),
                                                centre, sample.frame.normal);
        const double rest = normal - modes.dot(rigid);
        rest_squared += sample.weight * rest * rest;
      });
  return {std::sqrt(normal_squared), std::sqrt(rest_squared),
          std::sqrt(std::max(0.0, tangential_squared))};
}

std::optional<double> relative_error(const std::optional<model::Schedule>& target, double time,
                                     double value, double scale) {
  if (!target) return std::nullopt;
  return (value - target->value(time)) / scale;
}

}  // namespace

Diagnostics measure(const model::Model& model, const problem::State& state) {
  const auto integrals = integrate(model.at(state.time), state);
  Diagnostics result;
  result.energy.bending = integrals.energies[0];
  result.energy.gaussian = integrals.energies[1];
  if (model.is_two_phase) result.energy.line = integrals.energies[2];
  result.volume = integrals.constraints[0];
  result.area = integrals.constraints[1];
  if (model.is_two_phase) result.phase_difference = integrals.constraints[2];
  const auto& targets = model.targets;
  const double time = state.time;
  if (targets.volume) {
    result.constraint_errors.volume =
        relative_error(targets.volume, time, result.volume, std::abs(targets.volume->value(time)));
  }
  result.constraint_errors.area =
      relative_error(targets.area, time, result.area, targets.area ? targets.area->value(time) : 1);
  if (model.is_two_phase) {
    result.constraint_errors.phase =
        relative_error(targets.phase_difference, time, *result.phase_difference, result.area);
  }
  result.velocity = velocity_norms(state);
  result.quality = mesh::quality(*state.triangulation, state.values.positions);
  result.domains = phase_domains(state);
  return result;
}

NodalFields nodal_fields(const model::Model& model, const problem::State& state) {
  const auto n = state.triangulation->num_nodes();
  const auto material = model.material.at(state.time);
  NodalFields fields;
  fields.normals = problem::nodal_normals(*state.triangulation, state.values.positions);
  fields.normal_velocity = Eigen::VectorXd::Zero(n);
  if (state.rates.positions.rows() == n) {
    fields.normal_velocity = state.rates.positions.cwiseProduct(fields.normals).rowwise().sum();
  }
  fields.bending_energy_density.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    model::SurfacePoint<double> point;
    point.mean_curvature = state.values.mean_curvature[i];
    point.order_parameter = state.is_two_phase() ? state.values.order_parameter[i] : 1;
    fields.bending_energy_density[i] = model::BendingEnergy::density(material, point);
  }
  return fields;
}

}  // namespace vesica::measure
