#pragma once

#include <fmt/format.h>

#include <string_view>

#include "vesica/core/error.hpp"

namespace vesica {

/// Throws ConfigError `key = value: rule`; `key` is "table.key".
template <class T>
[[noreturn]] void refuse(std::string_view key, const T& value, std::string_view rule) {
  throw ConfigError(fmt::format("{} = {}: {}", key, value, rule));
}

}  // namespace vesica
