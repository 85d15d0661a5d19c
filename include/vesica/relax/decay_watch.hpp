#pragma once

#include <optional>

#include "vesica/relax/controller.hpp"

namespace vesica::relax {

/// Watches the energy of a flow against its least value. The energy of a gradient flow falls, so one
/// that rises tells that the mesh decays: the weak form does not stay at its equilibrium on some
/// meshes. What changes in time, and minimisers, which look after their mesh, are not watched.
class DecayWatch {
 public:
  explicit DecayWatch(const model::Model& model) : model_(model) {}

  /// Tells whether the energy has been above its least value by a hundredth of itself, or of 8 pi k,
  /// in the last ten steps. To be called once a step.
  [[nodiscard]] bool has_decayed(const StepView& view);
  /// Returns the state of least energy, at the time of the last step. Only after `has_decayed`.
  [[nodiscard]] problem::State best() const;
  /// Returns the stop of a run that has decayed.
  [[nodiscard]] Stop stop() const;
  /// Forgets what it has seen: on another mesh the energy is another one.
  void forget();

 private:
  const model::Model& model_;
  std::optional<problem::State> best_;
  double least_ = 0;
  double now_ = 0;
  double time_ = 0;
  int steps_above_ = 0;
};

}  // namespace vesica::relax
