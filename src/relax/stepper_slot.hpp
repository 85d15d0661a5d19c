#pragma once

#include <memory>
#include <utility>

#include "vesica/relax/relax.hpp"

namespace vesica::relax {

/// The stepper of a run, and how it is replaced.
struct StepperSlot {
  solve::Stepper* current;
  std::unique_ptr<solve::Stepper>* owner = nullptr;
  const StepperFactory* factory = nullptr;

  void replace(problem::State start, const solve::Restart& restart) {
    *owner = (*factory)(std::move(start), restart);
    current = owner->get();
  }
};

}  // namespace vesica::relax
