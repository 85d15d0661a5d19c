#include "vesica/solve/make_stepper.hpp"

#include <utility>

#include "ida_stepper.hpp"
#include "semi_implicit_stepper.hpp"

namespace vesica::solve {

std::unique_ptr<Stepper> make_stepper(const SolverOptions& options, const model::Model& model,
                                      problem::State start) {
  switch (options.method) {
    case Method::semi_implicit:
      return std::make_unique<SemiImplicitStepper>(options, model, std::move(start));
    case Method::ida:
      break;
  }
  return std::make_unique<IdaStepper>(options, model, std::move(start));
}

}  // namespace vesica::solve
