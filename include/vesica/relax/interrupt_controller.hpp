#pragma once

#include <atomic>
#include <vector>

#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Ends the run after the current step once a signal has arrived: status `interrupted`, state and
/// files complete.
class InterruptController final : public Controller {
 public:
  /// Makes the controller. `signal` is written by the signal handler: the number of the signal, 0
  /// as long as there is none. It must outlive the controller.
  explicit InterruptController(const std::atomic<int>& signal) : signal_(signal) {}
  [[nodiscard]] std::vector<Request> respond(const StepView& view) override;
  [[nodiscard]] std::vector<Request> respond_to_failure(const StepView& view) override;

 private:
  const std::atomic<int>& signal_;
};

}  // namespace vesica::relax
