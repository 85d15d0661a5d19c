#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vesica/config/config.hpp"
#include "vesica/model/make_model.hpp"
#include "vesica/model/model.hpp"
#include "vesica/problem/state.hpp"

namespace vesica::setup {

/// The measures that "initial" stands for: those of the surface with which a run, or the first run
/// of a chain of resumed runs, began.
struct Origin {
  model::Measures measures;
  bool is_sphere = false;  ///< then volume and area are one constraint
};

/// Where a case goes on with an older run.
struct Resumption {
  std::filesystem::path folder;
  std::string run;             ///< the number that the files of that run share
  std::size_t num_frames = 0;  ///< of its record
  std::size_t frame = 0;       ///< the one that is the start, as a rule the last
  /// Size of its last step where the run was in motion and its rates still hold, since no option
  /// of the equations has changed; else 0 [time].
  double step_size = 0;
  bool is_checkpoint = false;  ///< the record is damaged, and the start that of a checkpoint
};

/// A case that is ready to be relaxed: model, start, and what "initial" stands for.
struct Case {
  model::Model model;
  /// Positions and order parameter of the start; curvature, rates and multipliers are zero, unless
  /// the case goes on with an older run (io::resumed_case).
  problem::State start;
  Origin origin;
  std::vector<std::string> warnings;  ///< legal input that probably is not meant, one sentence each
  std::optional<Resumption> resumed{};
};

/// Makes surface, initial phase, targets and material of the configuration. Throws ConfigError when
/// they do not fit together, the surface has several pieces or no mesh method for its genus,
/// IoError when a surface or phase file cannot be read.
[[nodiscard]] Case make_case(const config::RunConfig& config);

/// Makes the case of a configuration with the given start, which has positions and, for two phases,
/// the order parameter; `config.shape` and `config.phase` are not used. Without `origin`, "initial"
/// stands for the measures of `start`. Throws ConfigError.
[[nodiscard]] Case case_of(const config::RunConfig& config, problem::State start,
                           const std::optional<Origin>& origin = {});

}  // namespace vesica::setup
