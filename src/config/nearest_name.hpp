#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vesica::config {

/// The candidate with the smallest edit distance to `word`, unless even that one is too far to be
/// meant.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view word,
                                                      std::span<const std::string> candidates);

/// `, did you mean "line_tension"?`; without a near name ` (known: ...)`.
[[nodiscard]] std::string suggestion(std::string_view word,
                                     std::span<const std::string> candidates);

}  // namespace vesica::config
