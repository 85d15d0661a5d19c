#pragma once

#include <iosfwd>
#include <string>

#include "vesica/config/config.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {

/// Returns the JSON text of `verdict.json`; docs/output.md lists its keys.
[[nodiscard]] std::string to_json(const relax::Verdict& verdict);

/// Prints the verdict as a table for people.
void print_verdict(std::ostream& out, const relax::Verdict& verdict);
/// Prints the files of a finished run, one a line.
void print_files(std::ostream& out, const config::RunConfig& config);

}  // namespace vesica::io
