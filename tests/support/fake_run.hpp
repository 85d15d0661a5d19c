#pragma once

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "vesica/measure/diagnostics.hpp"
#include "vesica/mesh/triangulation.hpp"
#include "vesica/problem/state.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::io {

/// Quadratic octahedron on the unit sphere: 18 nodes, 8 triangles.
inline mesh::Surface octahedron() {
  std::vector<Eigen::Vector3d> nodes{{1, 0, 0},  {0, 1, 0}, {-1, 0, 0},
                                     {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::map<std::pair<int, int>, int> middles;
  const auto middle = [&](int a, int b) {
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<int>(nodes.size()));
    if (is_new)
      nodes.push_back(
          (nodes[static_cast<std::size_t>(a)] + nodes[static_cast<std::size_t>(b)]).normalized());
    return found->second;
  };
  std::vector<mesh::QuadraticTriangle> triangles;
  for (int quarter = 0; quarter < 4; ++quarter) {
    const int next = (quarter + 1) % 4;
    for (const auto& [a, b, c] : {std::array{quarter, next, 4}, std::array{next, quarter, 5}}) {
      triangles.push_back({a, b, c, middle(a, b), middle(b, c), middle(c, a)});
    }
  }
  mesh::Positions positions(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    positions.row(static_cast<Eigen::Index>(i)) = nodes[i];
  return {std::make_shared<const mesh::Triangulation>(triangles,
                                                      static_cast<mesh::NodeIndex>(nodes.size())),
          positions};
}

/// A two-phase state on the octahedron with made-up numbers.
inline problem::State fake_state() {
  const mesh::Surface surface = octahedron();
  problem::State state;
  state.time = 0.25;
  state.triangulation = surface.triangulation;
  state.values.positions = surface.positions;
  state.values.mean_curvature = Eigen::VectorXd::Constant(18, -2);
  state.values.order_parameter = surface.positions.col(0);
  state.values.multipliers = {27.5, -9.25, std::nullopt};
  state.rates = state.values;
  state.rates.positions *= 0.5;
  state.damping = 0.75;
  return state;
}

inline measure::Diagnostics fake_diagnostics() {
  measure::Diagnostics measured;
  measured.energy = {50.5, 0.0, 8.25};
  measured.measures.of<model::Volume>() = 2.5;
  measured.measures.of<model::Area>() = 12.566370614359172;  // R_c = 1
  measured.measures.of<model::PhaseDifference>() = 4.75;
  measured.constraint_errors = {1e-9, -2e-9, std::nullopt};
  measured.velocity = {5e-3, 3e-3, 1e-3};
  measured.quality = 0.5;
  return measured;
}

inline solve::StepReport fake_report(long steps) {
  solve::StepReport report;
  report.step_size = 0.0125;
  report.order = 2;
  report.counts.steps = steps;
  report.counts.newton = 2 * steps;
  report.seconds.total = 0.5;
  report.seconds.processor = 0.5;
  return report;
}

inline relax::Outcome fake_outcome(relax::RunStatus status) {
  relax::Outcome outcome;
  outcome.status = status;
  outcome.reason = "because of the \"test\"";
  outcome.diagnostics = fake_diagnostics();
  outcome.report = fake_report(12);
  outcome.initial_quality = 0.625;
  outcome.smallest_quality = 0.375;
  return outcome;
}

}  // namespace vesica::io
