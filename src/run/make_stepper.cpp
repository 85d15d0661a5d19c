#include "vesica/run/make_stepper.hpp"

#include <utility>

#include "flow/ida_stepper.hpp"
#include "minimise/ceres_stepper.hpp"
#include "paper/semi_implicit_stepper.hpp"
#include "scaled_stepper.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"

namespace vesica::run {
namespace {

/// What a stepper is made of, in units in which its numbers are near 1.
class Ingredients {
 public:
  Ingredients(const solve::SolverOptions& options, const model::Model& model,
              const problem::State& start)
      : units_(near_natural_units(model, start)), options_(options), model_(model), start_(start) {}

  /// The unit of the times of the stepper; those of a minimiser count iterations.
  [[nodiscard]] double clock() const {
    return options_.method == solve::Method::minimize ? 1 : units_.time();
  }

  /// Makes a stepper that speaks the units of the case.
  template <class S, class... Arguments>
  [[nodiscard]] std::unique_ptr<solve::Stepper> make(const Arguments&... arguments) const {
    if (units_ == model::Units{})
      return std::make_unique<S>(options_, model_, start_, arguments...);
    problem::State start = in_units(start_, units_);
    start.time /= clock();
    const double width =
        model_.is_two_phase ? model_.material.interface_width.value(start_.time) : 0;
    return std::make_unique<ScaledStepper>(
        std::make_unique<S>(in_units(options_, units_, width), model::in_units(model_, units_),
                            std::move(start), arguments...),
        units_, clock());
  }

 private:
  model::Units units_;
  const solve::SolverOptions& options_;
  const model::Model& model_;
  const problem::State& start_;
};

[[noreturn]] void refuse_automatic() {
  throw ConfigError(
      "solver.method = auto: is a choice for a whole configuration (config::resolved): name a "
      "method");
}

}  // namespace

std::unique_ptr<solve::Stepper> make_stepper(const solve::SolverOptions& options,
                                             const model::Model& model, problem::State start) {
  check("solver", options);
  const Ingredients of(options, model, start);
  switch (options.method) {
    case solve::Method::semi_implicit:
      return of.make<paper::SemiImplicitStepper>();
    case solve::Method::minimize:
      return of.make<minimise::CeresStepper>();
    case solve::Method::automatic:
      refuse_automatic();
    case solve::Method::ida:
      break;
  }
  return of.make<flow::IdaStepper>();
}

std::unique_ptr<solve::Stepper> restart_stepper(const solve::SolverOptions& options,
                                                const model::Model& model, problem::State start,
                                                const solve::Restart& restart) {
  check("solver", options);
  const Ingredients of(options, model, start);
  if (options.method == solve::Method::minimize)
    return of.make<minimise::CeresStepper>(minimise::MeshKeeper::caller);
  if (options.method == solve::Method::semi_implicit) return of.make<paper::SemiImplicitStepper>();
  if (options.method != solve::Method::ida) refuse_automatic();
  return of.make<flow::IdaStepper>(solve::Restart{restart.initial_step / of.clock()});
}

}  // namespace vesica::run
