#include "io/record/run_description.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "io/record/attributes.hpp"
#include "io/record/record_reader.hpp"
#include "vesica/core/version.hpp"
#include "vesica/flow/library_versions.hpp"
#include "vesica/linalg/library_versions.hpp"

namespace vesica::io {
namespace {

#if defined(__clang__)
constexpr std::string_view compiler = "Clang " __clang_version__;
#else
constexpr std::string_view compiler = "GCC " __VERSION__;
#endif

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// UTC, as in 2026-11-29T01:20:00Z.
std::string present_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  std::array<char, 32> text{};
  (void)::gmtime_r(&now, &utc);
  (void)std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

/// Words of the command with blanks between them, at most 30 000 bytes.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text(30'000, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (!text.empty() && text.back() == '\0') text.pop_back();
  std::replace(text.begin(), text.end(), '\0', ' ');
  return text;
}

}  // namespace

void write_configuration(hdf5::WritableFile& file, const config::RunConfig& config) {
  const std::string root = "/configuration";
  if (file.has(root)) file.remove(root);
  file.make_group(root);
  file.set_attribute(root, "title", config.title);
  file.write_text(root + "/toml", config::to_toml(config));
  config::RunConfig::tables(
      config, [&file, &root]<class Options>(const config::Table& table, const Options& options) {
        const std::string group = fmt::format("{}/{}", root, table.name);
        if constexpr (requires { options.has_value(); }) {
          if (!options) return;
          file.make_group(group);
          Options::value_type::fields(*options, AttributeWriter(file, group));
        } else {
          file.make_group(group);
          Options::fields(options, AttributeWriter(file, group));
        }
      });
}

void write_origin(hdf5::WritableFile& file, const setup::Origin& origin) {
  const std::string group = "/origin";
  file.make_group(group);
  model::Measures::fields(origin.measures, AttributeWriter(file, group));
  file.set_attribute(group, "is_sphere", static_cast<std::int64_t>(origin.is_sphere));
}

void add_provenance(hdf5::WritableFile& file, const setup::Case& vesicle) {
  const std::string root = "/provenance";
  if (!file.has(root)) file.make_group(root);
  std::size_t index = 0;
  while (file.has(numbered("provenance", index))) ++index;
  const std::string group = numbered("provenance", index);
  file.make_group(group);
  file.set_attribute(group, "host", host_name());
  file.set_attribute(group, "date", present_date());
  file.set_attribute(group, "command", command_line());
  file.set_attribute(group, "warnings", fmt::format("{}", fmt::join(vesicle.warnings, "\n")));
  if (!vesicle.resumed) return;
  std::error_code ignored;
  file.set_attribute(group, "resumed_run", vesicle.resumed->run);
  file.set_attribute(group, "resumed_folder",
                     std::filesystem::absolute(vesicle.resumed->folder, ignored).string());
}

void write_versions(hdf5::WritableFile& file) {
  const std::string group = "/versions";
  if (file.has(group)) file.remove(group);
  file.make_group(group);
  file.set_attribute(group, "vesica", std::string(version()));
  file.set_attribute(group, "sundials", flow::sundials_version());
  file.set_attribute(group, "suitesparse", linalg::suitesparse_versions());
  file.set_attribute(group, "hdf5",
                     fmt::format("{}.{}.{}", H5_VERS_MAJOR, H5_VERS_MINOR, H5_VERS_RELEASE));
  file.set_attribute(
      group, "eigen",
      fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION));
  file.set_attribute(group, "compiler", std::string(compiler));
}

}  // namespace vesica::io
