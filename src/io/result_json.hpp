#pragma once

#include <filesystem>
#include <string_view>

#include "vesica/relax/verdict.hpp"

namespace vesica::io {

/// Reads the text of `verdict.json` back; `file` stands in messages. Only the velocities over R_c
/// and the number of remeshings are those of the file, times and reasons of remeshings stand in the
/// trajectory. Throws IoError `<file>: <path> <rule>`.
[[nodiscard]] relax::Verdict read_verdict(const std::filesystem::path& file, std::string_view text);

}  // namespace vesica::io
