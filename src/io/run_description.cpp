#include "io/run_description.hpp"

#include <fmt/format.h>

#include <string>
#include <string_view>

#include "io/attributes.hpp"
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
