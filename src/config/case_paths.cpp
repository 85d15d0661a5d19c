#include "config/case_paths.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <utility>

#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

namespace fs = std::filesystem;

/// Calls visit("table.key", path) for the files that a case names by a relative path.
template <class Visit>
void for_each_relative_path(RunConfig& config, const Visit& visit) {
  const auto look_at = [&](const char* key, std::string& path) {
    if (!path.empty() && fs::path(path).is_relative()) visit(key, path);
  };
  look_at("shape.path", config.shape.path);
  if (config.phase) look_at("phase.path", config.phase->path);
}

fs::path absolute_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

}  // namespace

void locate_files(const CaseDocument& document, const fs::path& folder, RunConfig& config) {
  for_each_relative_path(config, [&](const char* key, std::string& path) {
    const std::string option = placed(config, fmt::format("{} = \"{}\"", key, path));
    const fs::path in_current = absolute_path(path);
    const fs::path meant = document.is_overridden(key) ? in_current : absolute_path(folder / path);
    path = meant.string();
    std::error_code ignored;
    if (fs::exists(meant, ignored)) return;
    if (fs::exists(in_current, ignored)) {
      path = in_current.string();
      config.notes.push_back(
          fmt::format("{}: not in the folder of the case file, so {} is taken, from the current "
                      "folder; a path is relative to the case file",
                      option, path));
      return;
    }
    std::string places = meant.string();
    if (meant != in_current)
      places += fmt::format(
          " (relative to the case file) nor {} (relative "
          "to the current folder)",
          in_current.string());
    config.missing_files[path] = fmt::format("{}: there is no file {}", option, places);
  });
}

RunConfig with_absolute_paths(RunConfig config) {
  for_each_relative_path(
      config, [](const char*, std::string& path) { path = absolute_path(path).string(); });
  return config;
}

void check_file(const RunConfig& config, const std::string& path) {
  const auto found = config.missing_files.find(path);
  if (found != config.missing_files.end()) throw IoError(found->second);
}

}  // namespace vesica::config
