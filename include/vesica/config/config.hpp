#pragma once

#include <array>
#include <iosfwd>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/error.hpp"
#include "vesica/core/fields.hpp"
#include "vesica/model/constraints.hpp"
#include "vesica/model/material.hpp"
#include "vesica/phase/initial_phase.hpp"
#include "vesica/relax/damping_controller.hpp"
#include "vesica/relax/mesh_controller.hpp"
#include "vesica/relax/stationarity.hpp"
#include "vesica/shapes/shapes.hpp"
#include "vesica/solve/solver_options.hpp"

namespace vesica::config {

/// Options that tell what a run writes and where.
struct OutputOptions {
  std::string directory = "out";
  int every_steps = 5;
  bool paraview = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"directory", "-", "folder of the run, made if it does not exist"}, self.directory);
    visit(Field{"every_steps", "-", "a frame every so many steps, besides the first and the last",
                Rule::at_least_one},
          self.every_steps);
    visit(Field{"paraview", "-", "write trajectory.xdmf, which ParaView opens"}, self.paraview);
  }
};

/// Presets of `solver.rtol` and `stop.normal_velocity` for a case that does not give them:
/// draft 1e-2 and 1e-2; normal: the defaults; reference 1e-5 and 1e-4. It stands in the table
/// [solver].
enum class Accuracy { draft, normal, reference };

/// A table of the case file: its name, and the line that the template has for it.
struct Table {
  std::string_view name;
  std::string_view meaning;
};

/// The configuration of a run: everything a case file says, with a default for what it leaves out.
struct RunConfig {
  std::string title;
  shapes::ShapeOptions shape;
  std::optional<phase::PhaseOptions> phase;  ///< absent: single-phase vesicle
  model::MaterialOptions material;
  model::ConstraintOptions constraints;
  Accuracy accuracy = Accuracy::normal;
  solve::SolverOptions solver{.method = solve::Method::automatic};
  relax::DampingOptions damping;
  relax::StopOptions stop;
  relax::AdaptionOptions adaption;
  OutputOptions output;
  /// Where each "table.key" was written: "file:line:column", or the text of its override.
  std::map<std::string, std::string> places;
  /// What read_config had to decide, one sentence each. setup::make_case makes warnings of them.
  std::vector<std::string> notes;
  /// Files of the case that are nowhere: for each path, where read_config looked for it.
  std::map<std::string, std::string> missing_files;

  template <class Self, class Visitor>
  static void tables(Self& self, Visitor&& visit) {
    visit(Table{"shape", "starting surface; each kind has its own keys"}, self.shape);
    visit(Table{"phase", "initial order parameter; leave the table out for a single-phase vesicle"},
          self.phase);
    visit(Table{"material", "the membrane; phase 1 is c = +1, phase 2 is c = -1"}, self.material);
    visit(Table{"constraints", "what is kept fixed"}, self.constraints);
    visit(Table{"solver", "how the equations are solved"}, self.solver);
    visit(Table{"damping", "tangential damping alpha of the mesh velocity, (3.4)"}, self.damping);
    visit(Table{"stop", "when the run ends"}, self.stop);
    visit(Table{"adaption", "changes of the mesh during the run"}, self.adaption);
    visit(Table{"output", "what is written, and where"}, self.output);
  }
};

/// Reads a case file and then `overrides`, each "table.key=value" with a TOML value; a bare word
/// that is no TOML value counts as a string. Throws ConfigError, `file:line:column: table.key =
/// value: rule`, for a file that is no TOML, an unknown or repeated key, a wrong type, a value that
/// breaks its rule; IoError for a file that cannot be read. In messages about an override its text
/// stands in place of file, line and column.
///
/// Relative paths in `shape.path` and `phase.path` become absolute ones. They are relative to the
/// folder of the case file, those of overrides to the current folder. A file that is only in the
/// current folder is taken, with one of the `notes`; one that is nowhere is among `missing_files`.
[[nodiscard]] RunConfig read_config(const std::string& path,
                                    std::span<const std::string> overrides);

/// Reads the text of a case file and then `overrides`, as read_config does; `name` stands for the
/// file in messages. Paths stay as they are; relative ones are relative to the current folder.
[[nodiscard]] RunConfig read_config_text(std::string_view text, std::string_view name,
                                         std::span<const std::string> overrides);

/// Refuses options that break a rule, of their own or between tables. Throws ConfigError
/// `table.key = value: rule`.
void check(const RunConfig& config);

/// A method, and in words why it is taken.
struct MethodChoice {
  solve::Method method = solve::Method::minimize;
  std::string reason;
};

/// Returns the method that `solver.method` names or, where it is "auto", the one for what the case
/// asks: minimisation for an equilibrium; ida where the way to it counts, that is where the case
/// has a finite stop.end_time, a material constant or a target that changes in time, an option that
/// the flow alone uses, or a method of mesh changes that needs it.
[[nodiscard]] MethodChoice choose_method(const RunConfig& config);

/// Returns `config` with `solver.method` as `choose_method` has it.
[[nodiscard]] RunConfig resolved(RunConfig config);

/// Sets what a preset sets: `solver.rtol` and `stop.normal_velocity`.
void apply_accuracy(Accuracy accuracy, RunConfig& config);

/// Refuses a path of the case, `config.shape.path` for example, that is among the missing files.
/// Throws IoError with the places where the file was looked for.
void check_file(const RunConfig& config, const std::string& path);

/// Returns `message` with the place where the key "table.key" that it begins with was written.
[[nodiscard]] std::string placed(const RunConfig& config, std::string_view message);

/// Returns what `call()` returns. A ConfigError about a key of the case tells where the key was
/// written, also when it is thrown by a part of the library that knows nothing of case files.
template <class Call>
auto with_places(const RunConfig& config, const Call& call) {
  try {
    return call();
  } catch (const ConfigError& error) {
    throw ConfigError(placed(config, error.what()));
  }
}

/// Writes a case file with every table and option, its default, unit and meaning. Options are
/// commented out (`#key = default`), so the file reads back as the default RunConfig.
void write_template(std::ostream& out);

/// Returns the effective configuration as the text of a case file that reads back as the same
/// RunConfig, from any folder: relative paths of files become absolute ones.
[[nodiscard]] std::string to_toml(const RunConfig& config);

}  // namespace vesica::config

namespace vesica {
template <>
struct EnumNames<config::Accuracy> {
  static constexpr std::array<std::pair<config::Accuracy, std::string_view>, 3> names{
      {{config::Accuracy::draft, "draft"},
       {config::Accuracy::normal, "normal"},
       {config::Accuracy::reference, "reference"}}};
};
}  // namespace vesica
