#pragma once

#include <functional>

#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::minimise {

/// How a start is taken to its targets.
struct ApproachOptions {
  int threads = 0;            ///< of the assembly; 0: all cores
  bool is_symmetric = false;  ///< the start is a sphere: a small random displacement comes first
  /// Asked before each stage; false ends the approach. Empty: it goes on.
  std::function<bool()> may_go_on{};
};

/// A start that was taken to its targets.
struct Approach {
  problem::State state;  ///< rates are zero
  double error = 0;      ///< the largest that is left, relative
  int stages = 0;        ///< changes of the shape
  bool is_done = false;  ///< false: no stage brings the targets closer, or it was ended
};

/// Returns the largest relative error of the constraints (of the phase difference: to the area).
/// The targets of `model` must be constant.
[[nodiscard]] double largest_target_error(const model::Model& model, const problem::State& start);

/// Multiplies all lengths of a state so that the area is the one wanted or, without one, the volume;
/// the centre of the nodes stays. Returns the factor. The targets of `model` must be constant.
double scale_to_targets(const model::Model& model, problem::State& state);

/// Takes volume, area, phase difference and the rest to their targets by the smallest change of the
/// shape, in the metric of the bending energy, whatever the energy does meanwhile: in stages, each
/// the shortest change that meets the linearised constraints, cut to a tenth of R_c. Nodes move
/// along the surface when the mesh becomes worse. A sphere, on which volume and area cannot change
/// apart, gets a random normal displacement of 0.03 R_c first, with a fixed seed, in which the
/// lowest modes prevail.
///
/// The model must be constant in time. Throws ConfigError for a target that is not, SolverError
/// when the surface degenerates on the way.
[[nodiscard]] Approach approach_targets(const model::Model& model, problem::State start,
                                        const ApproachOptions& options);

}  // namespace vesica::minimise
