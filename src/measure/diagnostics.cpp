#include "vesica/measure/diagnostics.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
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

/// Integrals of the terms of a list that take part.
template <class List, class Point>
void add_integrals(const model::Physics& physics, const Point& point, double weight,
                   std::array<std::optional<double>, std::tuple_size_v<List>>& sum) {
  model::for_each_term<List>([&]<class Term>(std::size_t place) {
    if (model::takes_part<Term>(physics)) {
      sum[place] =
          sum[place].value_or(0.0) + weight * model::density_of<Term>(physics.material, point);
    }
  });
}

/// Energies and constrained functionals.
void integrate(const model::Physics& physics, const problem::State& state, Diagnostics& sum) {
  const auto shape_operator = shape_operator_of(physics.material, state);
  fem::for_each_point(
      *state.triangulation, state.values.positions, [&](const fem::SurfaceSample& sample) {
        const auto point = point_of(state, shape_operator, sample);
        add_integrals<model::Energies>(physics, point, sample.weight, sum.energy.values);
        add_integrals<model::Constraints>(physics, point, sample.weight, sum.measures.values);
      });
}

/// Relative errors of the constraints that have a target.
model::PerConstraint constraint_errors(const model::Model& model, double time,
                                       const model::Measures& measures) {
  model::PerConstraint errors;
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    if (measures[place] && model.targets[place]) {
      const double target = model.targets[place]->value(time);
      errors[place] =
          (*measures[place] - target) / model::error_scale<Constraint>(target, measures.area());
    }
  });
  return errors;
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

}  // namespace

double VelocityNorms::drift() const {
  const double squared = normal * normal - normal_rigid_free * normal_rigid_free;
  return squared < 0 ? 0 : std::sqrt(squared);
}

double Diagnostics::characteristic_radius() const {
  return std::sqrt(measures.area() / (4 * std::numbers::pi));
}

Diagnostics measure(const model::Model& model, const problem::State& state) {
  Diagnostics result;
  integrate(model.at(state.time), state, result);
  result.constraint_errors = constraint_errors(model, state.time, result.measures);
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
