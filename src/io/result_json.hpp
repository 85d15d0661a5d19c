#pragma once

#include <filesystem>

#include "vesica/relax/verdict.hpp"

namespace vesica::io {

/// Reads `verdict.json` back; only the velocities over R_c and the number of remeshings are those
/// of the file, times and reasons of remeshings stand in the trajectory. Throws IoError
/// `<file>: <path> <rule>`.
[[nodiscard]] relax::Verdict read_verdict(const std::filesystem::path& file);

}  // namespace vesica::io
