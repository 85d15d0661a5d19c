#pragma once

#include <functional>
#include <string_view>

namespace vesica {

/// The exit status that `run` returns. An exception is printed to the standard error output behind
/// the program's name and becomes 2 (ConfigError), 4 (IoError) or 3 (any other).
[[nodiscard]] int guarded(std::string_view program, const std::function<int()>& run);

}  // namespace vesica
