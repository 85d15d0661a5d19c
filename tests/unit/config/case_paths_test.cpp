#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "expect_message.hpp"
#include "temporary_folder.hpp"
#include "vesica/config/config.hpp"
#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

namespace fs = std::filesystem;

const std::string text_of_case =
    "[shape]\nkind = \"file\"\npath = \"mesh.off\"\n"
    "[phase]\nkind = \"file\"\npath = \"../phase.txt\"\n";

/// The current folder holds sub/case.toml, and what a test adds.
class CasePaths : public testing::Test {
 protected:
  void SetUp() override {
    before_ = fs::current_path();
    fs::current_path(temporary_.path());
    fs::create_directory("sub");
    write("sub/case.toml", text_of_case);
  }
  void TearDown() override { fs::current_path(before_); }

  static void write(const std::string& name, const std::string& text) {
    std::ofstream(name) << text;
  }
  static RunConfig read(const std::vector<std::string>& overrides = {}) {
    return read_config("sub/case.toml", overrides);
  }
  static std::string here(const std::string& name) { return (fs::current_path() / name).string(); }

  test::TemporaryFolder temporary_;
  fs::path before_;
};

TEST_F(CasePaths, AreRelativeToTheCaseFile) {
  write("sub/mesh.off", "");
  write("mesh.off", "");
  write("phase.txt", "");
  const RunConfig config = read();
  EXPECT_EQ(config.shape.path, here("sub/mesh.off"));
  EXPECT_EQ(config.phase->path, here("phase.txt"));
  EXPECT_TRUE(config.notes.empty());
  EXPECT_NO_THROW(check_file(config, config.shape.path));
}

TEST_F(CasePaths, FallBackToTheCurrentFolderWithANote) {
  write("mesh.off", "");
  const RunConfig config = read();
  EXPECT_EQ(config.shape.path, here("mesh.off"));
  ASSERT_EQ(config.notes.size(), 1U);
  EXPECT_EQ(
      config.notes[0],
      "sub/case.toml:3:8: shape.path = \"mesh.off\": not in the folder of the case file, so " +
          here("mesh.off") +
          " is taken, from the current folder; a path is relative to the case file");
}

TEST_F(CasePaths, ThatLeadNowhereAreRefusedWithBothPlacesWhenTheFileIsNeeded) {
  const RunConfig config = read();
  test::expect_message<IoError>([&] { check_file(config, config.shape.path); },
                                "sub/case.toml:3:8: shape.path = \"mesh.off\": there is no file " +
                                    here("sub/mesh.off") + " (relative to the case file) nor " +
                                    here("mesh.off") + " (relative to the current folder)");
}

TEST_F(CasePaths, OfOverridesAreRelativeToTheCurrentFolder) {
  write("sub/other.off", "");
  write("other.off", "");
  EXPECT_EQ(read({"shape.path=other.off"}).shape.path, here("other.off"));
  const RunConfig config = read({"shape.path=none.off"});
  test::expect_message<IoError>([&] { check_file(config, config.shape.path); },
                                "--set shape.path=none.off: shape.path = \"none.off\": there is "
                                "no file " +
                                    here("none.off"));
}

TEST_F(CasePaths, AreAbsoluteInAConfigurationThatIsWritten) {
  RunConfig config = read_config_text(text_of_case, "case.toml", {});
  EXPECT_EQ(config.shape.path, "mesh.off");
  const RunConfig echo = read_config_text(to_toml(config), "elsewhere/case.toml", {});
  EXPECT_EQ(echo.shape.path, here("mesh.off"));
  EXPECT_EQ(echo.phase->path, (fs::current_path().parent_path() / "phase.txt").string());
}

}  // namespace
}  // namespace vesica::config
