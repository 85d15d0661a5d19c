#include "vesica/core/check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "vesica/core/error.hpp"

namespace vesica {

std::string rule_text(const Rule& rule) {
  if (rule.least == Rule::any.least) return "must be finite";
  if (rule.most != Rule::any.most)
    return fmt::format("must be between {} and {}", rule.least, rule.most);
  return fmt::format("must be {} {}", rule.excludes_least ? ">" : ">=", rule.least);
}

std::string broken_rule(const Rule& rule, std::span<const double> numbers) {
  for (const double number : numbers) {
    const bool is_inside =
        number <= rule.most && (rule.excludes_least ? number > rule.least : number >= rule.least);
    if (!is_inside) return rule_text(rule);
    if (std::isinf(number) && !rule.allows_infinity) return "must be finite";
  }
  return {};
}

std::string text_of(std::span<const double> numbers) {
  return numbers.size() == 1 ? fmt::format("{}", numbers[0])
                             : fmt::format("[{}]", fmt::join(numbers, ", "));
}

void refuse_option(std::string_view table, std::string_view key, std::string_view value,
                   std::string_view rule) {
  throw ConfigError(fmt::format("{}.{} = {}: {}", table, key, value, rule));
}

}  // namespace vesica
