#include "vesica/run/make_stepper.hpp"

#include <fmt/format.h>

#include <utility>

#include "flow/ida_stepper.hpp"
#include "minimise/ceres_stepper.hpp"
#include "paper/semi_implicit_stepper.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"

namespace vesica::run {

std::unique_ptr<solve::Stepper> make_stepper(const solve::SolverOptions& options,
                                             const model::Model& model, problem::State start) {
  check("solver", options);
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
  check("solver", options);
  if (options.method == solve::Method::minimize) {
    return std::make_unique<minimise::CeresStepper>(options, model, std::move(start),
                                                    minimise::MeshKeeper::caller);
  }
  if (options.method != solve::Method::ida) {
    throw ConfigError(fmt::format(
        "solver.method = {}: a run goes on from a given state only with ida or minimize",
        name_of(options.method)));
  }
  return std::make_unique<flow::IdaStepper>(options, model, std::move(start), restart);
}

}  // namespace vesica::run
