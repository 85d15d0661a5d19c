#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fake_run.hpp"
#include "io/hdf5/handles.hpp"
#include "vesica/config/config.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io {

/// Reads what a run wrote, through the C interface.
class ReadableFile {
 public:
  explicit ReadableFile(const std::filesystem::path& path)
      : file_(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT)) {
    if (file_.get() < 0) throw IoError("cannot open " + path.string());
  }
  [[nodiscard]] std::vector<hsize_t> shape(const std::string& path) const {
    const hdf5::DatasetHandle dataset(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT));
    const hdf5::SpaceHandle space(H5Dget_space(dataset.get()));
    std::vector<hsize_t> shape(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space.get())));
    H5Sget_simple_extent_dims(space.get(), shape.data(), nullptr);
    return shape;
  }
  template <class T>
  [[nodiscard]] std::vector<T> read(const std::string& path, hid_t type) const {
    hsize_t count = 1;
    for (const hsize_t extent : shape(path)) count *= extent;
    std::vector<T> values(count);
    const hdf5::DatasetHandle dataset(H5Dopen2(file_.get(), path.c_str(), H5P_DEFAULT));
    if (H5Dread(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
      throw IoError(path);
    return values;
  }
  [[nodiscard]] std::vector<double> numbers(const std::string& path) const {
    return read<double>(path, H5T_NATIVE_DOUBLE);
  }
  [[nodiscard]] double number_attribute(const std::string& object, const std::string& name) const {
    double value = NAN;
    const hdf5::AttributeHandle attribute = open_attribute(object, name);
    H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &value);
    return value;
  }
  [[nodiscard]] std::string text_attribute(const std::string& object,
                                           const std::string& name) const {
    const hdf5::AttributeHandle attribute = open_attribute(object, name);
    const hdf5::TypeHandle type(H5Aget_type(attribute.get()));
    std::string text(H5Tget_size(type.get()), '\0');
    H5Aread(attribute.get(), type.get(), text.data());
    return text;
  }
  [[nodiscard]] bool has(const std::string& path) const {
    return H5Lexists(file_.get(), path.c_str(), H5P_DEFAULT) > 0;
  }

 private:
  [[nodiscard]] hdf5::AttributeHandle open_attribute(const std::string& object,
                                                     const std::string& name) const {
    return hdf5::AttributeHandle(
        H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }
  hdf5::FileHandle file_;
};

inline std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A run that can be written step by step.
struct FakeRun {
  problem::State state = fake_state();
  measure::Diagnostics measured = fake_diagnostics();
  solve::StepReport report = fake_report(0);
  config::RunConfig config;

  void observe(relax::Observer& observer, long step) {
    report.counts.steps = step;
    state.time = 0.5 * static_cast<double>(step);
    observer.observe({state, report, measured});
  }
  void finish(relax::Observer& observer, relax::RunStatus status = relax::RunStatus::converged) {
    observer.finish({state, report, measured}, fake_outcome(status));
  }
};

}  // namespace vesica::io
