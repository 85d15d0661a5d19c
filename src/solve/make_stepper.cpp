#include "vesica/solve/make_stepper.hpp"

#include <fmt/format.h>

#include <utility>

#include "ceres_stepper.hpp"
#include "ida_stepper.hpp"
#include "semi_implicit_stepper.hpp"
#include "vesica/core/error.hpp"

namespace vesica::solve {

namespace {

void check(const SolverOptions& options) {
  if (options.max_order < 1 || options.max_order > 5) {
    throw ConfigError(fmt::format("solver.max_order = {}: must be 1 to 5", options.max_order));
  }
  if (options.initial_step > options.max_step) {
    throw ConfigError(fmt::format("solver.initial_step = {}: must be <= solver.max_step = {}",
                                  options.initial_step, options.max_step));
  }
  if (options.scheme == Scheme::variational && options.method == Method::semi_implicit) {
    throw ConfigError(
        "solver.scheme = variational: must be paper for solver.method = semi-implicit");
  }
  if (options.polish && options.method == Method::semi_implicit)
    throw ConfigError("solver.polish = true: must be false for solver.method = semi-implicit");
}

}  // namespace

std::unique_ptr<Stepper> make_stepper(const SolverOptions& options, const model::Model& model,
                                      problem::State start) {
  check(options);
  switch (options.method) {
    case Method::semi_implicit:
      return std::make_unique<SemiImplicitStepper>(options, model, std::move(start));
    case Method::minimize:
      return std::make_unique<CeresStepper>(options, model, std::move(start));
    case Method::ida:
      break;
  }
  return std::make_unique<IdaStepper>(options, model, std::move(start));
}

std::unique_ptr<Stepper> restart_stepper(const SolverOptions& options, const model::Model& model,
                                         problem::State start, const Restart& restart) {
  check(options);
  if (options.method != Method::ida || options.scheme != Scheme::paper) {
    throw ConfigError(fmt::format(
        "solver.method = {}, solver.scheme = {}: a run goes on from a given state only with ida "
        "and paper",
        name_of(options.method), name_of(options.scheme)));
  }
  return std::make_unique<IdaStepper>(options, model, std::move(start), restart);
}

}  // namespace vesica::solve
