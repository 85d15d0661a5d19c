#pragma once

#include <span>

#include "vesica/model/model.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/relax/stationarity.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::relax {

/// The loop: step, measure, let every observer look, let every controller answer, carry the
/// requests out; until the stopping criterion of `stop`, a limit, a request to stop, or a failed
/// step. Ends with the stepper's final constraint solve when converged. Observers are finished in
/// every case, also before an exception leaves. Controllers are asked in order; the stopping
/// criterion comes last. Nothing numerical is thrown: a failed step is
/// `RunStatus::numerical_failure`, with the stepper's state at the last good step.
Outcome relax(solve::Stepper& stepper, const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers);

}  // namespace vesica::relax
