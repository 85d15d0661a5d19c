#include "vesica/measure/diagnostics.hpp"
#include "vesica/linalg/dense.hpp"

#include <cmath>
#include <numbers>
#include <tuple>

#include "problem/energy/constraint_kernel.hpp"
#include "problem/point_equations.hpp"
#include "problem/rigid_modes.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/problem/normal_graph.hpp"

namespace vesica::measure {

namespace {

model::SurfacePoint<double> point_of(const problem::State& state,
                                     const fem::SurfaceSample& sample) {
  model::SurfacePoint<double> point;
  point.position = fem::vector_at(state.values.positions, sample);
  point.normal = sample.frame.normal;
  point.mean_curvature = fem::scalar_at(state.values.mean_curvature, sample);
  point.mean_curvature_gradient = fem::gradient_at(state.values.mean_curvature, sample);
  point.order_parameter = 1;
  if (state.is_two_phase()) {
    point.order_parameter = fem::scalar_at(state.values.order_parameter, sample);
    point.order_parameter_gradient = fem::gradient_at(state.values.order_parameter, sample);
  }
  return point;
}

/// Integrates the energies that take part. Those of the Gauss curvature are distributions, as in
/// E_h: from a recovered shape operator the energy of Section 4.3 has 16 times the error.
model::EnergyParts energies_of(const model::Physics& physics, const problem::State& state) {
  model::EnergyParts sum;
  const auto& positions = state.values.positions;
  const auto angles = problem::vertex_angles(*state.triangulation);
  model::for_each_term<model::Energies>([&]<class Energy>(std::size_t place) {
    if constexpr (model::CurvatureTerm<Energy>) {
      sum[place] = problem::curvature_energy<Energy>(physics, *state.triangulation, angles,
                                                     positions, state.values.order_parameter, 1);
    }
  });
  fem::for_each_point(*state.triangulation, positions, [&](const fem::SurfaceSample& sample) {
    const auto point = point_of(state, sample);
    model::for_each_term<model::Energies>([&]<class Energy>(std::size_t place) {
      if constexpr (!model::CurvatureTerm<Energy>) {
        if (!model::takes_part<Energy>(physics)) return;
        const double density = model::density_of<Energy>(physics.material, point);
        sum[place] = sum[place].value_or(0.0) + sample.weight * density;
      }
    });
  });
  return sum;
}

/// Returns the constrained functionals as the solvers have them, also of those without a target.
model::Measures measures_of(model::Physics physics, const problem::State& state) {
  physics.is_free = {};
  const auto values = problem::constraint_values(
      physics, *state.triangulation, state.values.positions, state.values.order_parameter, 1);
  model::Measures measures;
  model::for_each_term<model::Constraints>([&]<class Constraint>(std::size_t place) {
    if (model::takes_part<Constraint>(physics)) measures[place] = values[place];
  });
  return measures;
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
  const auto eigen = linalg::symmetric_eigensystem(gram);
  problem::RigidModes coefficients = eigen.vectors.transpose() * projection;
  for (int i = 0; i < 6; ++i) {
    const double value = eigen.values[i];
    coefficients[i] = value > 1e-6 * eigen.values[5] ? coefficients[i] / value : 0;
  }
  const problem::RigidModes rigid = eigen.vectors * coefficients;
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
  const auto physics = model.at(state.time);
  result.energy = energies_of(physics, state);
  result.measures = measures_of(physics, state);
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
