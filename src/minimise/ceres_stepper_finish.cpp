#include <fmt/format.h>

#include <optional>
#include <utility>

#include "ceres_stepper.hpp"
#include "solve/newton_system.hpp"
#include "vesica/core/error.hpp"

namespace vesica::minimise {

namespace {

constexpr int max_constraint_iterations = 8;
constexpr double constraint_tolerance = 1e-13;
constexpr double constraint_met = 1e-8;
constexpr double constraint_missed = 1e-3;  // more than an outer iteration leaves far from the end
constexpr double nearly_there = 1e-3;       // distance to the minimum, in k_1^(1/2)

/// Where the rounding of the energy ends the line search, in k_1^(1/2).
constexpr double rounding = 1e-6;

}  // namespace

solve::StepReport CeresStepper::finish() {
  std::string kind;
  if (distance() < near_minimum) {
    kind = find_kind();
    if (kind.empty()) return report(solve::StepStatus::accepted, {});
  }
  solve::StepReport result = options_.polish ? polish() : meet_constraints();
  if (result.reason.empty()) result.reason = kind;
  return result;
}

solve::StepReport CeresStepper::meet_constraints() {
  if (!options_.final_constraint_solve) return report(solve::StepStatus::accepted, {});
  std::string trouble;
  {
    const ScopedTimer timer(seconds_.total);
    trouble = restore_constraints();
  }
  const auto status = trouble.empty() ? solve::StepStatus::accepted : solve::StepStatus::failed;
  return report(status, std::move(trouble));
}

/// Newton's method on the equations of the equilibrium. Its work is in the report.
solve::StepReport CeresStepper::polish() {
  std::optional<solve::Equilibrium> equilibrium;
  std::string trouble;
  try {
    const ScopedTimer timer(seconds_.total);
    equilibrium =
        solve::find_equilibrium(options_, problem_.model(), state_, state_.values.positions);
    if (equilibrium->report.is_converged) {
      take(*equilibrium);
    } else {
      trouble = solve::no_equilibrium_text(equilibrium->report);
    }
  } catch (const RecoverableError& error) {
    trouble = fmt::format("polish: {}", error.what());
  }
  const auto status = trouble.empty() ? solve::StepStatus::accepted : solve::StepStatus::failed;
  auto result = report(status, std::move(trouble));
  if (!equilibrium) return result;
  result.counts += equilibrium->counts;
  result.seconds += equilibrium->seconds;
  result.polish = equilibrium->report;
  return result;
}

void CeresStepper::take(const solve::Equilibrium& equilibrium) {
  const auto& values = equilibrium.state.values;
  sample_at(values.positions, values.order_parameter);
  renew_reference();
  next_multipliers_ = multipliers_;
  store();
  state_.values.multipliers = values.multipliers;
}

/// Newton's method along the constraint directions, with the derivatives kept. What went wrong;
/// empty: nothing.
std::string CeresStepper::restore_constraints() {
  GraphPoint restored = point_;
  auto& constraints = restored.sample.constraints;
  try {
    for (int iteration = 0; iteration < max_constraint_iterations; ++iteration) {
      if (constraints_.largest_error(constraints) < constraint_tolerance) break;
      const auto errors = constraints_.errors(constraints);
      restored.unknowns -= coordinates_->spread(slopes_.change_for(errors));
      constraints = problem_.constraints(positions_of(graph_, restored.unknowns),
                                         order_parameter_of(graph_, restored.unknowns));
    }
    if (!(constraints_.largest_error(constraints) < constraint_met))
      return "final constraint solve: " + constraint_text();
    sample_at(positions_of(graph_, restored.unknowns),
              order_parameter_of(graph_, restored.unknowns));
  } catch (const RecoverableError& trouble) {
    return fmt::format("final constraint solve: {}", trouble.what());
  }
  point_.unknowns = restored.unknowns;
  linearise();
  store();
  return {};
}

std::string CeresStepper::stall_text() const {
  const double error = constraints_.largest_error(point_.sample.constraints);
  if (error > (distance() < nearly_there ? constraint_met : constraint_missed))
    return constraint_text();
  return fmt::format(
      "the line search finds no lower energy at distance {:.1e} from the minimum ({}); {}",
      distance(), describe(mesh_condition(surface(point_.sample.fields.positions))),
      distance() < rounding
          ? "that is round-off: raise stop.gradient or set solver.polish = true"
          : "a finer or more even mesh, another start or solver.method = ida may help");
}

std::string CeresStepper::constraint_text() const {
  return fmt::format(
      "constraints.{} is off by {:.1e} (relative) and comes no closer: the targets cannot be met "
      "together on this mesh; change one of them or leave it \"free\"",
      constraints_.worst_name(point_.sample.constraints),
      constraints_.largest_error(point_.sample.constraints));
}

}  // namespace vesica::minimise
