#include "energy_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "vesica/fem/block_assembly.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::minimise {

namespace {

constexpr double smallest_reduced_tension = 1e-2;  // of sigma, in k_1 / R_c

/// Weights of grad . grad and of the product at a point, by order parameter.
struct Weights {
  double stiffness = 0;
  double mass = 0;
};

template <class WeightsAt>
linalg::SparseMatrix assemble(const problem::EnergyProblem& problem,
                              const mesh::Positions& positions,
                              const Eigen::VectorXd& order_parameter, WeightsAt&& weights_at) {
  const auto& triangles = problem.triangulation().triangles();
  std::vector<double> local(triangles.size() * 36, 0.0);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    fem::for_each_point(triangles[t], positions, [&](const fem::SurfaceSample& sample) {
      const auto& shape = sample.shape;
      const Weights weights =
          weights_at(order_parameter.size() > 0 ? fem::scalar_at(order_parameter, sample) : 1.0);
      std::array<Vec3<double>, 6> gradient;
      for (std::size_t i = 0; i < 6; ++i)
        gradient[i] = fem::surface_gradient(sample.frame, shape.du[i], shape.dv[i]);
      for (std::size_t i = 0; i < 6; ++i) {
        for (std::size_t j = 0; j < 6; ++j) {
          local[36 * t + 6 * i + j] +=
              sample.weight * (weights.stiffness * dot(gradient[i], gradient[j]) +
                               weights.mass * shape.value[i] * shape.value[j]);
        }
      }
    });
  }
  auto matrix = problem.graph().block_pattern(1);
  fem::gather_blocks<1>(problem.graph(), local, 1, matrix);
  return matrix;
}

}  // namespace

EnergyMetric::EnergyMetric(const problem::EnergyProblem& problem, const problem::Scales& scales)
    : problem_(problem),
      curvature_squared_(2 / (scales.length * scales.length)),
      smallest_tension_(smallest_reduced_tension * scales.energy / scales.length),
      is_two_phase_(problem.model().is_two_phase),
      num_nodes_(problem.triangulation().num_nodes()),
      bending_(problem.graph().block_pattern(1)),
      mass_(problem.graph().block_pattern(1)),
      phase_(problem.graph().block_pattern(1)) {}

void EnergyMetric::factorise(const mesh::Positions& positions,
                             const Eigen::VectorXd& order_parameter) {
  const auto material = problem_.model().material.at(0);
  const auto add = [&](linalg::SparseCholesky& factors, auto&& weights_at) {
    factors.factorise(assemble(problem_, positions, order_parameter, weights_at));
  };
  add(bending_, [&](double c) {
    const double k = is_two_phase_ ? model::interpolate(material.bending_rigidity, c)
                                   : material.bending_rigidity.phase_1;
    return Weights{std::sqrt(k), curvature_squared_ * std::sqrt(k)};
  });
  add(mass_, [](double) { return Weights{0, 1}; });
  if (!is_two_phase_) return;
  const double sigma = std::max(material.line_tension, smallest_tension_);
  const double eps = material.interface_width;
  add(phase_, [&](double c) {
    return Weights{sigma * eps, sigma / eps * std::max(0.5, 6 * c * c - 2)};
  });
}

Eigen::VectorXd EnergyMetric::spread(const Eigen::VectorXd& z) const {
  Eigen::VectorXd u(size());
  u.head(num_nodes_) = bending_.solve(mass_.multiply(z.head(num_nodes_)));
  if (is_two_phase_) u.tail(num_nodes_) = phase_.solve_transposed(z.tail(num_nodes_));
  return u;
}

Eigen::VectorXd EnergyMetric::gather(const Eigen::VectorXd& gradient) const {
  Eigen::VectorXd z(size());
  z.head(num_nodes_) = mass_.multiply_transposed(bending_.solve(gradient.head(num_nodes_)));
  if (is_two_phase_) z.tail(num_nodes_) = phase_.solve_factor(gradient.tail(num_nodes_));
  return z;
}

Eigen::VectorXd EnergyMetric::l2_gradient(const Eigen::VectorXd& gradient) const {
  Eigen::VectorXd result(size());
  result.head(num_nodes_) = mass_.solve(gradient.head(num_nodes_));
  if (is_two_phase_) result.tail(num_nodes_) = mass_.solve(gradient.tail(num_nodes_));
  return result;
}

}  // namespace vesica::minimise
