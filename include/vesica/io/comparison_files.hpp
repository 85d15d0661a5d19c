#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>

#include "vesica/io/comparison.hpp"

namespace vesica::io {

/// Whether a comparison may be written to `folder`; nothing is created. Throws ConfigError when it
/// holds one and `overwrite` is false.
void check_comparison_folder(const std::filesystem::path& folder, bool overwrite);

/// Writes to `folder`, which exists: `comparison.json`; for each run `profile_<name>.csv`, the cut
/// through the long axis of the first run (the others moved onto it), and `energy_<name>.csv`; and
/// `comparison.gp`, the gnuplot script that draws them. Throws IoError.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

/// Lets gnuplot carry out `comparison.gp`, which makes `profiles.png` and `energy.png`. Without
/// gnuplot, or when it fails, there are no pictures: the result is a sentence that says why and how
/// to draw them later.
[[nodiscard]] std::optional<std::string> draw_comparison(const std::filesystem::path& folder);

/// The files of a comparison, one a line.
void print_comparison_files(std::ostream& out, const Comparison& comparison,
                            const std::filesystem::path& folder);

/// The text of `comparison.gp`.
[[nodiscard]] std::string plot_script(const Comparison& comparison);

}  // namespace vesica::io
