#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "vesica/compare/comparison.hpp"

namespace vesica::io {

/// Reads two finished runs. They are named flow and minimize when one of them is a minimisation and
/// the other is not, else first and second. Throws what `read_run` throws.
[[nodiscard]] std::vector<compare::ComparedRun> read_runs(const std::filesystem::path& first,
                                                          const std::filesystem::path& second);

/// Returns the JSON text of `comparison.json`; docs/output.md lists its keys.
[[nodiscard]] std::string to_json(const compare::Comparison& comparison);

/// Prints the runs side by side, and what they found, as a table for people.
void print_comparison(std::ostream& out, const compare::Comparison& comparison);

/// Checks that a comparison may be written to `folder`; nothing is created. Throws ConfigError when
/// the folder holds one and `overwrite` is false.
void check_comparison_folder(const std::filesystem::path& folder, bool overwrite);

/// Writes to `folder`, which exists: `comparison.json`; for each run `profile_<name>.csv`, the cut
/// through the long axis of the first run (the others moved onto it), and `energy_<name>.csv`; and
/// `comparison.gp`, the gnuplot script that draws them. Throws IoError.
void write_comparison(const std::filesystem::path& folder, const compare::Comparison& comparison);

/// Lets gnuplot carry out `comparison.gp`, which makes `profiles.png` and `energy.png`. Without
/// gnuplot, or when it fails, there are no pictures: the result is a sentence that says why and how
/// to draw them later.
[[nodiscard]] std::optional<std::string> draw_comparison(const std::filesystem::path& folder);

/// Prints the files of a comparison, one a line.
void print_comparison_files(std::ostream& out, const compare::Comparison& comparison,
                            const std::filesystem::path& folder);

/// Returns the text of `comparison.gp`.
[[nodiscard]] std::string plot_script(const compare::Comparison& comparison);

}  // namespace vesica::io
