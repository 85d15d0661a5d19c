#include "start_care.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <utility>

#include "minimise/mesh_care.hpp"
#include "minimise/target_approach.hpp"
#include "problem/zero_fields.hpp"
#include "vesica/adapt/size_field.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/relax/remesh.hpp"
#include "vesica/relax/stationarity.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica::run {
namespace {

constexpr double far_from_targets = 0.02;  // relative
constexpr double largest_part = 0.1;       // of a way to the targets
constexpr double most_parts = 30;
constexpr int steps_of_a_part = 4;
constexpr int steps_of_a_try = 2;  // of the minimiser
constexpr int steps_before_adaption = 4;
constexpr int max_tries = 5;

/// Some outer iterations from `start`, at its time; returns how many, 0 where none is possible.
int smooth(const solve::SolverOptions& options, const model::Model& model, problem::State& start,
           int steps) {
  const double time = start.time;
  solve::SolverOptions minimiser = options;
  minimiser.method = solve::Method::minimize;
  int done = 0;
  try {
    const auto stepper = make_stepper(minimiser, model, start);
    while (done < steps && stepper->step(0).status == solve::StepStatus::accepted) ++done;
    start = stepper->state();
  } catch (const SolverError&) {
    return 0;
  }
  start.time = time;
  start.rates = problem::zero_fields(start.values.positions.rows(), start.is_two_phase());
  return done;
}

void add_smoothing_note(FitStart& start, std::string_view purpose, int steps) {
  start.notes.push_back(fmt::format(
      "the start was too rough {}: {} steps of minimisation made it smooth", purpose, steps));
}

/// Returns what `attempt()` returns. As long as it throws SolverError, `smooth_start()` makes the
/// start smoother and returns the steps that took, 0 where it cannot; then, and after some tries, the
/// error stands. What was done becomes a note; `purpose(first error)` says for what.
template <class Purpose, class Attempt, class SmoothStart>
auto with_smoothing(FitStart& start, const Purpose& purpose, const Attempt& attempt,
                    const SmoothStart& smooth_start) {
  std::string trouble;
  int steps = 0;
  for (int tries = 0;; ++tries) {
    try {
      auto result = attempt();
      if (steps > 0) add_smoothing_note(start, purpose(trouble), steps);
      return result;
    } catch (const SolverError& error) {
      if (tries == max_tries) throw;
      if (trouble.empty()) trouble = error.what();
      const int more = smooth_start();
      if (more == 0) throw;
      steps += more;
    }
  }
}

/// The way of a start to its targets: in parts, between which the shape relaxes a little.
class Way {
 public:
  Way(const model::Model& model, const solve::SolverOptions& options,
      const std::atomic<int>* interrupt)
      : model_(model), options_(options), interrupt_(interrupt) {}

  /// Takes the start there; where it is too rough for that, after some steps of minimisation at the
  /// volume, area and phases that it has.
  int go_from_rough(FitStart& start, bool is_sphere) {
    const auto attempt = [&] {
      problem::State state = start.state;
      const int stages = go(state, is_sphere);
      start.state = std::move(state);
      return stages;
    };
    const auto purpose = [](const std::string&) { return "to be taken to its targets"; };
    return with_smoothing(start, purpose, attempt, [&] {
      const model::Measures present = measure::measure(model_, start.state).measures;
      return smooth(options_, between(present, 0), start.state, steps_of_a_try);
    });
  }

  /// Takes the state there, or as far as it comes before an interrupt; returns the number of
  /// changes of the shape. Throws SolverError when the targets are not reached.
  int go(problem::State& state, bool is_sphere) {
    const model::Measures first = measure::measure(model_, state).measures;
    const double error = minimise::largest_target_error(model_, state);
    const int parts =
        static_cast<int>(std::clamp(std::ceil(error / largest_part), 1.0, most_parts));
    int stages = 0;
    for (int part = 1; part <= parts && !is_interrupted(); ++part) {
      const model::Model there = between(first, static_cast<double>(part) / parts);
      minimise::ApproachOptions how{options_.threads, is_sphere && part == 1, {}};
      how.may_go_on = [this] { return !is_interrupted(); };
      auto approach = approach_targets(there, std::move(state), how);
      stages += approach.stages;
      if (!approach.is_done && !is_interrupted()) throw SolverError(failure(error, approach));
      state = std::move(approach.state);
      if (part < parts) {
        (void)smooth(options_, there, state, steps_of_a_part);
        look_after_mesh(there, state);
      }
    }
    return stages;
  }

 private:
  [[nodiscard]] bool is_interrupted() const { return interrupt_ != nullptr && *interrupt_ != 0; }

  [[nodiscard]] static minimise::Approach approach_targets(const model::Model& model,
                                                           problem::State state,
                                                           const minimise::ApproachOptions& how) {
    try {
      return minimise::approach_targets(model, std::move(state), how);
    } catch (const RecoverableError& trouble) {
      throw SolverError(trouble.what());
    }
  }

  /// The model with targets between what the start has and those of the case.
  [[nodiscard]] model::Model between(const model::Measures& first, double fraction) const {
    model::Model result = model_;
    for (std::size_t place = 0; place < result.targets.values.size(); ++place) {
      auto& target = result.targets[place];
      if (target) target = std::lerp(first.values[place].value(), target->first(), fraction);
    }
    return result;
  }

  /// A new mesh of about as many nodes where the old one has become bad.
  static void look_after_mesh(const model::Model& model, problem::State& state) {
    const mesh::Surface surface = state.surface();
    const minimise::MeshCare care(surface, minimise::even_mesh);
    if (!care.is_worn(minimise::mesh_condition(surface))) return;
    const double num_nodes = state.triangulation->num_nodes();
    adapt::SizeFieldOptions sizes;
    const double area = measure::measure(model, state).measures.area();
    const double of_an_element = area / state.triangulation->num_triangles();
    sizes.max_size = std::sqrt(4 / std::sqrt(3.0) * of_an_element);  // equilateral
    auto even =
        relax::remeshed(model, state, {sizes, num_nodes, "the start is far from its targets"});
    if (even) state = std::move(*even);
  }

  [[nodiscard]] static std::string failure(double error, const minimise::Approach& approach) {
    return fmt::format(
        "the start is off its targets by {:.2g} (relative), and a part of the way is left by "
        "{:.2g} after {} changes of the shape: another start, a finer mesh or a target that is "
        "\"free\" "
        "may help, and solver.mend_start = false begins from it as it is",
        error, approach.error, approach.stages);
  }

  const model::Model& model_;
  const solve::SolverOptions& options_;
  const std::atomic<int>* interrupt_;
};

/// Not a number for a surface that is degenerate: then the stepper tells what is wrong.
double target_error(const model::Model& model, const problem::State& start) {
  try {
    return minimise::largest_target_error(model, start);
  } catch (const RecoverableError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

FitStart near_targets(const setup::Case& vesicle, const solve::SolverOptions& options,
                      const std::atomic<int>* interrupt) {
  FitStart result{vesicle.start};
  if (!options.mend_start) return result;
  const model::Model model = vesicle.model.frozen(vesicle.start.time);
  const double error = target_error(model, vesicle.start);
  if (!(error > far_from_targets)) return result;
  const double scale = minimise::scale_to_targets(model, result.state);
  int stages = 0;
  try {
    stages = Way(model, options, interrupt).go_from_rough(result, vesicle.origin.is_sphere);
  } catch (const SolverError& trouble) {
    return {vesicle.start,
            {fmt::format("the run begins off its targets by {:.2g} (relative), since {}", error,
                         trouble.what())}};
  }
  const std::string scaling =
      std::abs(scale - 1) < 1e-4
          ? ""
          : fmt::format("all lengths were multiplied by {:.6g}, then ", scale);
  result.notes.push_back(fmt::format(
      "the start was off its targets by {:.2g} (relative): {}its shape was changed in {} stages "
      "until they were met",
      error, scaling, stages));
  return result;
}

void smooth_before_adaption(const solve::SolverOptions& options, const model::Model& model,
                            FitStart& start) {
  if (!options.mend_start || !relax::Stationarity::unresolved(start.state)) return;
  const int steps =
      smooth(options, model.frozen(start.state.time), start.state, steps_before_adaption);
  if (steps > 0) add_smoothing_note(start, "for its mesh to be adapted", steps);
}

std::unique_ptr<solve::Stepper> make_stepper_somehow(const solve::SolverOptions& options,
                                                     const model::Model& model, FitStart& start) {
  const bool may_smooth = options.method != solve::Method::minimize && options.mend_start;
  const auto purpose = [](const std::string& trouble) {
    return fmt::format("for the flow ({})", trouble);
  };
  return with_smoothing(
      start, purpose, [&] { return make_stepper(options, model, start.state); },
      [&] {
        if (!may_smooth) return 0;
        return smooth(options, model.frozen(start.state.time), start.state, steps_of_a_try);
      });
}

}  // namespace vesica::run
