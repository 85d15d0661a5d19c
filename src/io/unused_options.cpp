#include "io/unused_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace vesica::io {
namespace {

/// `text` up to the first `end`, which is taken off it.
std::string_view take(std::string_view& text, std::string_view end) {
  const auto at = text.find(end);
  const std::string_view taken = text.substr(0, at);
  text.remove_prefix(at == std::string_view::npos ? text.size() : at + end.size());
  return taken;
}

/// The kinds that use a field, as its meaning names them: "kind, kind: ...; kind: ...". None where
/// it begins otherwise: then all kinds do.
template <class Kind>
std::vector<Kind> users_of(const Field& field) {
  std::vector<Kind> users;
  std::string_view rest = field.meaning;
  while (!rest.empty()) {
    std::string_view part = take(rest, "; ");
    if (part.find(": ") == std::string_view::npos) continue;
    std::string_view words = take(part, ": ");
    while (!words.empty()) {
      const std::string_view word = take(words, ", ");
      for (const auto& [kind, name] : EnumNames<Kind>::names)
        if (name == word) users.push_back(kind);
    }
  }
  return users;
}

template <class Options>
void add_unused(std::string_view table, const Options& options,
                std::vector<std::string>& sentences) {
  for (const Field& field : changed_fields(options)) {
    const auto users = users_of<decltype(options.kind)>(field);
    if (users.empty() || std::find(users.begin(), users.end(), options.kind) != users.end())
      continue;
    sentences.push_back(fmt::format("{}.{} means nothing with {}.kind = \"{}\"", table, field.name,
                                    table, name_of(options.kind)));
  }
}

}  // namespace

std::vector<std::string> unused_options(const RunConfig& config) {
  std::vector<std::string> sentences;
  add_unused("shape", config.shape, sentences);
  if (config.phase) add_unused("phase", *config.phase, sentences);
  return sentences;
}

}  // namespace vesica::io
