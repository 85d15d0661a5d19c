#pragma once

#include <string>
#include <variant>
#include <vector>

#include "vesica/relax/observer.hpp"

namespace vesica::relax {

/// Tangential damping from the next step on [length^2/energy].
struct SetDamping {
  double alpha = 1;
};

/// End the run with this status and one sentence that says why.
struct Stop {
  RunStatus status = RunStatus::stopped;
  std::string reason;
  int signal = 0;
};

/// An event between steps. relax() alone carries requests out.
using Request = std::variant<SetDamping, Stop>;

/// Looks at the run after every accepted step and may ask for something. Derive from it to steer a
/// run.
class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  /// Requests are carried out in order, before the next step; empty: go on.
  [[nodiscard]] virtual std::vector<Request> respond(const StepView& view) = 0;
};

}  // namespace vesica::relax
