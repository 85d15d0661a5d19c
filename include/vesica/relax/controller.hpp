#pragma once

#include <string>
#include <variant>
#include <vector>

#include "vesica/adapt/size_field.hpp"
#include "vesica/paper/bisection.hpp"
#include "vesica/relax/observer.hpp"

namespace vesica::relax {

/// Request for this tangential damping alpha [length^2/energy] from the next step on.
struct SetDamping {
  double alpha = 1;
};

/// Request to end the run with this status and one sentence that says why.
struct Stop {
  RunStatus status = RunStatus::stopped;
  std::string reason;
  int signal = 0;
};

/// Plan of one round of bisection and coarsening, paper::bisect.
struct BisectionPlan {
  paper::BisectionOptions marking;
  bool is_first = false;  ///< the present mesh was not made by bisection
};

/// Plan of a conformal image of a sphere mesh, paper::conformal_remesh. Where its quality is no
/// better than that of the present mesh, the bisection.
struct ConformalPlan {
  BisectionPlan otherwise;  ///< the bisection in place of an image that is no better
};

/// Plan of a new mesh. Options of a size field stand for adapt::local_remesh.
using MeshPlan = std::variant<adapt::SizeFieldOptions, BisectionPlan, ConformalPlan>;

/// Request for a new mesh of the surface, with `max_nodes` nodes at most.
struct Remesh {
  MeshPlan plan;
  double max_nodes = 0;
  std::string reason;  ///< what follows "because" in the log
};

/// A request of a controller, which relax() carries out between two steps.
using Request = std::variant<SetDamping, Stop, Remesh>;

/// Looks at the run after every accepted step and may ask for something. Derive from it to steer a
/// run.
class Controller {
 public:
  Controller() = default;
  Controller(const Controller&) = delete;
  Controller& operator=(const Controller&) = delete;
  virtual ~Controller() = default;

  /// Returns what the controller asks for after an accepted step. Requests are carried out in
  /// order, before the next step; without any the run goes on.
  [[nodiscard]] virtual std::vector<Request> respond(const StepView& view) = 0;

  /// Returns what the controller asks for when a step has failed; `view` is the last good state.
  /// With a Remesh the run goes on from there, unless a limit is reached or a Stop has status
  /// interrupted; else a Stop tells why it ends, and the reason of the failure is added to its
  /// reason.
  [[nodiscard]] virtual std::vector<Request> respond_to_failure(const StepView& view) {
    (void)view;
    return {};
  }

  /// Returns what the controller asks for when the run is about to end at a limit. Only a Stop
  /// counts: it tells why the run got no further; the limit is added to its reason.
  [[nodiscard]] virtual std::vector<Request> respond_to_limit(const StepView& view) {
    (void)view;
    return {};
  }

  /// Returns what the controller asks for when the run is about to end in an equilibrium. A Stop
  /// ends it with another status; with a Remesh the run goes on.
  [[nodiscard]] virtual std::vector<Request> respond_to_rest(const StepView& view) {
    (void)view;
    return {};
  }
};

}  // namespace vesica::relax
