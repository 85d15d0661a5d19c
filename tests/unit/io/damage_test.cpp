#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "io/hdf5/writable_file.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_reader.hpp"
#include "written_run.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

/// The start and one step of a case that was resumed.
struct FakeSteps {
  explicit FakeSteps(const setup::Case& resumed) : vesicle(resumed) {}
  void write(const fs::path& folder, const config::RunConfig& config) const {
    TrajectoryWriter writer(folder, config, vesicle);
    const measure::Diagnostics measured = fake_diagnostics();
    problem::State state = vesicle.start;
    solve::StepReport report = fake_report(0);
    writer.observe({state, report, measured});
    report = fake_report(1);
    state.time += 0.125;
    writer.observe({state, report, measured});
    writer.finish({state, report, measured}, fake_outcome(relax::RunStatus::converged));
  }
  const setup::Case& vesicle;
};

/// A run whose files are changed behind its back.
class DamageTest : public ::testing::Test {
 protected:
  DamageTest() {
    write_fake_run(folder(), relax::RunStatus::step_limit);
    whole_ = bytes_of(record());
  }

  [[nodiscard]] const fs::path& folder() const { return temporary_.path(); }
  [[nodiscard]] fs::path record() const { return folder() / "trajectory.h5"; }

  static std::string bytes_of(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  void replace_record(const std::string& bytes) const {
    std::ofstream(record(), std::ios::binary | std::ios::trunc) << bytes;
  }

  [[nodiscard]] std::string error_of_reading() const {
    try {
      (void)read_run(folder());
    } catch (const IoError& error) {
      return error.what();
    }
    return "no IoError";
  }
  /// The error after a change of the record through HDF5.
  std::string error_after(const std::function<void(hid_t)>& change) const {
    replace_record(whole_);
    const hid_t file = H5Fopen(record().c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    return error_of_reading();
  }
  static void replace_numbers(hid_t file, const char* path, const std::vector<hsize_t>& shape,
                              double value) {
    H5Ldelete(file, path, H5P_DEFAULT);
    const hdf5::SpaceHandle space(
        H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr));
    const hdf5::DatasetHandle dataset(H5Dcreate2(file, path, H5T_NATIVE_DOUBLE, space.get(),
                                                 H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    hsize_t count = 1;
    for (const hsize_t extent : shape) count *= extent;
    const std::vector<double> values(std::min<hsize_t>(count, 1000), value);
    if (count == values.size())
      H5Dwrite(dataset.get(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  static void replace_attribute(hid_t file, const char* object, const char* name, hsize_t count,
                                double value) {
    H5Adelete_by_name(file, object, name, H5P_DEFAULT);
    const hdf5::SpaceHandle space(H5Screate_simple(1, &count, nullptr));
    const hdf5::AttributeHandle attribute(H5Acreate_by_name(
        file, object, name, H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
    const std::vector<double> values(count, value);
    H5Awrite(attribute.get(), H5T_NATIVE_DOUBLE, values.data());
  }

  config::RunConfig config() const { return recorded_config(folder(), {}); }

  test::TemporaryFolder temporary_;
  std::string whole_;
};

TEST_F(DamageTest, TypeShapeAndRangeOfEveryObjectAreChecked) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const std::string frame = "/frames/000003";
  const auto expect = [](const std::string& error, const std::string& part) {
    EXPECT_NE(error.find("trajectory.h5: " + part), std::string::npos) << error;
  };
  expect(
      error_after([](hid_t file) { replace_attribute(file, "/frames/000003", "time", 1000, 1); }),
      frame + " @time must be one value");
  expect(error_after([&](hid_t file) {
           replace_attribute(file, "/frames/000003", "multiplier_area", 1, nan);
         }),
         frame + " @multiplier_area must be finite");
  expect(
      error_after([](hid_t file) { replace_attribute(file, "/frames/000003", "damping", 1, -1); }),
      frame + " @damping must be >= 0");
  expect(error_after(
             [](hid_t file) { H5Adelete_by_name(file, "/frames/000003", "time", H5P_DEFAULT); }),
         frame + " @time cannot be read");
  expect(error_after([&](hid_t file) {
           replace_numbers(file, "/frames/000003/positions", {18, 3}, nan);
         }),
         frame + "/positions must hold finite numbers only");
  expect(error_after([](hid_t file) {
           replace_numbers(file, "/frames/000003/positions", {18, 4}, 1);
         }),
         frame + "/positions must have 3 columns, not 4");
  expect(error_after([](hid_t file) {
           replace_numbers(file, "/frames/000003/positions", {hsize_t{1} << 40U, 3}, 1);
         }),
         frame + "/positions claims more values than the file has bytes for");
  expect(error_after(
             [](hid_t file) { replace_numbers(file, "/frames/000003/order_parameter", {17}, 1); }),
         frame + "/order_parameter must have 18 rows, not 17");
  expect(error_after([](hid_t file) {
           replace_numbers(file, "/meshes/000000/triangles", {8, 6}, 1);
         }),
         frame + "/mesh/triangles must hold whole numbers");
  expect(
      error_after([](hid_t file) { replace_numbers(file, "/series/seconds_processor", {5}, 1); }),
      "/series/seconds_processor must have 13 rows, not 5");
  expect(error_after([](hid_t file) { H5Ldelete(file, "/frames", H5P_DEFAULT); }),
         "/frames cannot be read");
  expect(error_after(
             [](hid_t file) { H5Ldelete(file, "/frames/000003/order_parameter", H5P_DEFAULT); }),
         "the last frame has no order_parameter, case.toml has a table [phase]");
}

TEST_F(DamageTest, NothingLeadsOutOfTheFile) {
  const fs::path other = folder() / "other.h5";
  fs::copy_file(record(), other);
  const std::string linked = error_after([&](hid_t file) {
    H5Ldelete(file, "/frames/000003/positions", H5P_DEFAULT);
    H5Lcreate_external(other.c_str(), "/frames/000003/positions", file, "/frames/000003/positions",
                       H5P_DEFAULT, H5P_DEFAULT);
  });
  EXPECT_NE(linked.find("/frames/000003/positions cannot be read"), std::string::npos) << linked;
  const std::string stored = error_after([&](hid_t file) {
    H5Ldelete(file, "/frames/000003/mean_curvature", H5P_DEFAULT);
    const hsize_t rows = 18;
    const hdf5::SpaceHandle space(H5Screate_simple(1, &rows, nullptr));
    const hdf5::PropertiesHandle creation(H5Pcreate(H5P_DATASET_CREATE));
    H5Pset_external(creation.get(), other.c_str(), 0, 18 * sizeof(double));
    const hdf5::DatasetHandle dataset(H5Dcreate2(file, "/frames/000003/mean_curvature",
                                                 H5T_NATIVE_DOUBLE, space.get(), H5P_DEFAULT,
                                                 creation.get(), H5P_DEFAULT));
  });
  EXPECT_NE(stored.find("/mean_curvature must not have its values in another file"),
            std::string::npos)
      << stored;
}

TEST_F(DamageTest, FilesOfTwoRunsAreNotMixed) {
  const test::TemporaryFolder second;
  write_fake_run(second.path(), relax::RunStatus::step_limit);
  for (const std::string name : {"verdict.json", "case.toml"}) {
    const std::string own = bytes_of(folder() / name);
    std::ofstream(folder() / name) << bytes_of(second.path() / name);
    const std::string error = error_of_reading();
    EXPECT_NE(error.find(name + ": belongs to "), std::string::npos) << error;
    std::ofstream(folder() / name) << own;
  }
}

TEST_F(DamageTest, AChangedVerdictIsNotBelieved) {
  const std::string verdict = bytes_of(folder() / "verdict.json");
  const auto error_with = [&](const std::string& part, const std::string& other) {
    std::string changed = verdict;
    changed.replace(changed.find(part), part.size(), other);
    std::ofstream(folder() / "verdict.json") << changed;
    return error_of_reading();
  };
  const std::string smaller = error_with("58.75", "51.75");
  EXPECT_NE(smaller.find("verdict.json: was changed"), std::string::npos) << smaller;
  const std::string negative = error_with("\"remeshings\": 2", "\"remeshings\": -1");
  EXPECT_NE(negative.find("verdict.json: /mesh/remeshings must be from 0 to"), std::string::npos)
      << negative;
  const std::string many = error_with("\"remeshings\": 2", "\"remeshings\": 2000000000");
  EXPECT_NE(many.find("verdict.json: /mesh/remeshings must be at most"), std::string::npos) << many;
}

/// Flips of one bit, all over the file: the run reads as before, or the reader names what is wrong.
TEST_F(DamageTest, AFlippedBitIsSeenOrMakesNoDifference) {
  const FinishedRun before = read_run(folder());
  int num_seen = 0;
  for (std::size_t place = 0; place < whole_.size(); place += 61) {
    std::string damaged = whole_;
    damaged[place] = static_cast<char>(damaged[place] ^ (1 << (place % 8)));
    replace_record(damaged);
    try {
      const FinishedRun after = read_run(folder());
      ASSERT_EQ(after.state.values.positions, before.state.values.positions) << place;
      ASSERT_EQ(after.state.rates.positions, before.state.rates.positions) << place;
      ASSERT_EQ(after.state.values.order_parameter, before.state.values.order_parameter) << place;
      ASSERT_EQ(after.state.values.mean_curvature, before.state.values.mean_curvature) << place;
      ASSERT_EQ(after.state.time, before.state.time) << place;
      ASSERT_EQ(after.history.energy, before.history.energy) << place;
      ASSERT_EQ(after.history.seconds, before.history.seconds) << place;
    } catch (const IoError& error) {
      ASSERT_NE(std::string(error.what()).find("trajectory.h5"), std::string::npos);
      ++num_seen;
    }
  }
  EXPECT_GT(num_seen, 100);
}

TEST_F(DamageTest, ADamagedFrameIsNamedAndTheOneBeforeItUsed) {
  const FinishedRun run = read_run(folder());
  const auto* const value = reinterpret_cast<const char*>(run.state.values.positions.data());
  const std::size_t place = whole_.find(std::string(value, 4 * sizeof(double)));
  ASSERT_NE(place, std::string::npos);
  std::string damaged = whole_;
  damaged[place + 9] = static_cast<char>(damaged[place + 9] ^ 4);
  replace_record(damaged);
  EXPECT_NE(error_of_reading().find("/frames/000003/positions cannot be read"), std::string::npos)
      << error_of_reading();
  const setup::Case vesicle = resumed_case(config(), folder());
  EXPECT_EQ(vesicle.start.time, 1.25);
  ASSERT_TRUE(vesicle.resumed);
  EXPECT_EQ(vesicle.resumed->frame, 2U);
  EXPECT_NE(vesicle.warnings.back().find("trajectory.h5: /frames/000003/positions cannot be read"),
            std::string::npos)
      << vesicle.warnings.back();
  EXPECT_NE(vesicle.warnings.back().find("frame 2 at t = 1.25 is the last one"), std::string::npos)
      << vesicle.warnings.back();

  // the record goes on behind that frame
  FakeSteps(vesicle).write(folder(), config());
  const FinishedRun mended = read_run(folder());
  EXPECT_EQ(mended.state.time, 1.375);
  EXPECT_EQ(mended.history.step.size(), 12U);
  EXPECT_EQ(mended.history.step.back(), 11);
}

TEST_F(DamageTest, ARunWhoseRecordWasCutGoesOnFromItsCheckpoint) {
  const config::RunConfig recorded = config();
  int num_checkpoints = 0;
  for (std::size_t size = 0; size < whole_.size(); size += whole_.size() / 50) {
    replace_record(whole_.substr(0, size));
    const setup::Case vesicle = resumed_case(recorded, folder());
    const std::string& warning = vesicle.warnings.back();
    if (vesicle.resumed->is_checkpoint) {
      ++num_checkpoints;
      EXPECT_EQ(vesicle.start.time, 1.5) << size;
      EXPECT_NE(warning.find("trajectory.h5: /"), std::string::npos) << warning;
      EXPECT_NE(warning.find("goes on from checkpoint.h5 at t = 1.5"), std::string::npos)
          << warning;
    } else if (vesicle.resumed->frame < 3) {
      EXPECT_LT(vesicle.start.time, 1.5);
      EXPECT_NE(warning.find("trajectory.h5: /frames/"), std::string::npos) << warning;
    }
  }
  EXPECT_GT(num_checkpoints, 20);
}

TEST_F(DamageTest, ADamagedCheckpointLeavesTheOneBeforeIt) {
  const std::string checkpoint = bytes_of(folder() / "checkpoint.h5");
  for (const char* name : {"trajectory.h5", "checkpoint.h5"})
    std::ofstream(folder() / name) << "no HDF5";
  EXPECT_EQ(resumed_case(config(), folder()).start.time, 0);
  std::ofstream(folder() / "checkpoint.previous.h5") << "no HDF5";
  EXPECT_THROW((void)recorded_config(folder(), {}), IoError);
}

TEST_F(DamageTest, ADamagedRecordIsSetAsideInItsFolder) {
  replace_record(whole_.substr(0, whole_.size() / 2));
  const setup::Case vesicle = resumed_case(config(), folder());
  FakeSteps(vesicle).write(folder(), config());
  EXPECT_EQ(bytes_of(folder() / "trajectory.damaged.h5"), whole_.substr(0, whole_.size() / 2));
  const FinishedRun run = read_run(folder());
  EXPECT_EQ(run.history.step, (std::vector<double>{0, 1}));
  EXPECT_EQ(run.verdict.warnings, vesicle.warnings);
}

}  // namespace
}  // namespace vesica::io
