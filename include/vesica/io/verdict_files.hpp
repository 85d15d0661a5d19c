#pragma once

#include <iosfwd>
#include <string>

#include "vesica/config/config.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {

/// The JSON text of `verdict.json`; keys in docs/output.md.
[[nodiscard]] std::string to_json(const relax::Verdict& verdict);

/// Writes `verdict.json` and the effective configuration `case.toml` to the output folder of
/// `config`. Throws IoError.
void write_verdict(const config::RunConfig& config, const relax::Verdict& verdict);

/// The verdict as a table for people.
void print_verdict(std::ostream& out, const relax::Verdict& verdict);
/// The files of a finished run, one a line.
void print_files(std::ostream& out, const config::RunConfig& config);

}  // namespace vesica::io
