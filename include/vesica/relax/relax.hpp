#pragma once

#include <functional>
#include <memory>
#include <span>

#include "vesica/model/model.hpp"
#include "vesica/relax/controller.hpp"
#include "vesica/relax/observer.hpp"
#include "vesica/relax/stationarity.hpp"
#include "vesica/solve/stepper.hpp"

namespace vesica::relax {

/// Relaxes a vesicle by the loop: step, measure, let every observer look, let every controller
/// answer, carry the requests out; until the stopping criterion of `stop`, a limit, a request to
/// stop, or a failed step. Ends with the stepper's final constraint solve when converged. Observers
/// are finished in every case, also before an exception leaves. Controllers are asked in order; the
/// stopping criterion comes last. Nothing numerical is thrown: a failed step is
/// `RunStatus::numerical_failure`, with the stepper's state at the last good step. Throws
/// ConfigError when a controller asks for a new mesh.
Outcome relax(solve::Stepper& stepper, const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers);

/// Makes the stepper with which a run goes on from a state on a new mesh.
using StepperFactory = std::function<std::unique_ptr<solve::Stepper>(
    problem::State start, const solve::Restart& restart)>;

/// Relaxes a vesicle by the same loop with controllers that may ask for new meshes. `stepper` is
/// replaced at every change of the mesh by one of `restart`, whose first step is 0.3 of the last
/// one (0.03 after a failed step); counts and seconds go on. A mesh that turns out unusable is
/// dropped, and the run goes on with the one it has.
Outcome relax(std::unique_ptr<solve::Stepper>& stepper, const StepperFactory& restart,
              const model::Model& model, const StopOptions& stop,
              std::span<Observer* const> observers, std::span<Controller* const> controllers);

}  // namespace vesica::relax
