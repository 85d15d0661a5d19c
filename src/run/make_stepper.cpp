#include "vesica/run/make_stepper.hpp"

#include <fmt/format.h>

#include <utility>

#include "flow/ida_stepper.hpp"
#include "minimise/ceres_stepper.hpp"
#include "paper/semi_implicit_stepper.hpp"
#include "vesica/core/error.hpp"

namespace vesica::run {

namespace {

void check(const solve::SolverOptions& options) {
  if (options.max_order < 1 || options.max_order > 5) {
    throw ConfigError(fmt::format("solver.max_order = {}: must be 1 to 5", options.max_order));
  }
  if (options.initial_step > options.max_step) {
    throw ConfigError(fmt::format("solver.initial_step = {}: must be <= solver.max_step = {}",
                                  options.initial_step, options.max_step));
  }
  if (options.scheme == solve::Scheme::variational &&
      options.method == solve::Method::semi_implicit) {
    throw ConfigError(
        "solver.scheme = variational: must be paper for solver.method = semi-implicit");
  }
  if (options.polish && options.method == solve::Method::semi_implicit)
    throw ConfigError("solver.polish = true: must be false for solver.method = semi-implicit");
}

}  // namespace

std::unique_ptr<solve::Stepper> make_stepper(const solve::SolverOptions& options,
                                             const model::Model& model, problem::State start) {
  check(options);
  switch (options.method) {
    case solve::Method::semi_implicit:
      return std::make_unique<paper::SemiImplicitStepper>(options, model, std::move(start));
    case solve::Method::minimize:
      return std::make_unique<minimise::CeresStepper>(options, model, std::move(start));
    case solve::Method::ida:
      break;
  }
  return std::make_unique<flow::IdaStepper>(options, model, std::move(start));
}

std::unique_ptr<solve::Stepper> restart_stepper(const solve::SolverOptions& options,
                                                const model::Model& model, problem::State start,
                                                const solve::Restart& restart) {
  check(options);
  if (options.method != solve::Method::ida || options.scheme != solve::Scheme::paper) {
    throw ConfigError(fmt::format(
        "solver.method = {}, solver.scheme = {}: a run goes on from a given state only with ida "
        "and paper",
        name_of(options.method), name_of(options.scheme)));
  }
  return std::make_unique<flow::IdaStepper>(options, model, std::move(start), restart);
}

}  // namespace vesica::run
