#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vesica/config/config.hpp"
#include "vesica/model/make_model.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::setup {

/// What "initial" stands for. A run that goes on with another keeps the origin of that one.
struct Origin {
  model::Measures measures;
  bool is_sphere = false;  ///< then volume and area are one constraint
};

/// A run ready to be computed.
struct Case {
  model::Model model;
  problem::State
      start;  ///< positions and order parameter; curvature, rates and multipliers are zero
  Origin origin;
  std::vector<std::string> warnings;  ///< legal input that probably is not meant, one sentence each
};

/// Surface, initial phase, targets and material of the configuration. Throws ConfigError when they
/// do not fit together, the surface has several pieces or no mesh method for its genus, IoError
/// when a surface or phase file cannot be read.
[[nodiscard]] Case make_case(const config::RunConfig& config);

/// The same with a start that is there already: positions and, for two phases, order parameter.
/// Without `origin` it is its own. Throws ConfigError.
[[nodiscard]] Case case_of(const config::RunConfig& config, problem::State start,
                           const std::optional<Origin>& origin = {});

}  // namespace vesica::setup
