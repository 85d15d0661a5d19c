#include "config/unused_options.hpp"

namespace vesica::config {
namespace {

/// `text` up to the first `end`, which is taken off it.
std::string_view take(std::string_view& text, std::string_view end) {
  const auto at = text.find(end);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
  return taken;
}

}  // namespace

std::vector<std::string_view> names_before_colons(const Field& field) {
  std::vector<std::string_view> names;
  std::string_view rest = field.meaning;
  while (!rest.empty()) {
    std::string_view part = take(rest, "; ");
    if (part.find(": ") == std::string_view::npos) continue;
    std::string_view words = take(part, ": ");
    while (!words.empty()) names.push_back(take(words, ", "));
  }
  return names;
}

}  // namespace vesica::config
