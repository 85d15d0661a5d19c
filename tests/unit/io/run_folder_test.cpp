#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

TEST(RunFolder, CheckingCreatesNothing) {
  const test::TemporaryFolder folder;
  check_run_folder(folder.path() / "a" / "b", "case.toml", false);
  EXPECT_FALSE(fs::exists(folder.path() / "a"));
  create_run_folder(folder.path() / "a" / "b");
  EXPECT_TRUE(fs::is_directory(folder.path() / "a" / "b"));
}

TEST(RunFolder, AFolderThatHoldsARunIsRefusedUnlessItMayBeOverwritten) {
  for (const char* name : {"trajectory.h5", "trajectory.part.h5", "verdict.json"}) {
    const test::TemporaryFolder folder;
    std::ofstream(folder.path() / name) << "old";
    EXPECT_THROW(check_run_folder(folder.path(), "case.toml", false), ConfigError) << name;
    EXPECT_NO_THROW(check_run_folder(folder.path(), "case.toml", true)) << name;
  }
}

TEST(RunFolder, AFolderToWhichARunIsWritingIsRefused) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "trajectory.part.h5") << "growing";
  {
    const FolderLock run(folder.path());
    EXPECT_THROW(check_run_folder(folder.path(), "case.toml", true), ConfigError);
    EXPECT_THROW(FolderLock{folder.path()}, ConfigError);
  }
  EXPECT_NO_THROW(check_run_folder(folder.path(), "case.toml", true));
  EXPECT_THROW(FolderLock{folder.path() / "missing"}, IoError);
}

TEST(RunFolder, TheCaseFileItselfIsNeverOverwritten) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "case.toml") << "title = 'mine'";
  EXPECT_THROW(check_run_folder(folder.path(), folder.path() / "case.toml", true), ConfigError);
}

TEST(RunFolder, AFileInPlaceOfTheFolderIsAnIoError) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "file") << "x";
  EXPECT_THROW(check_run_folder(folder.path() / "file", "case.toml", false), IoError);
  EXPECT_THROW(check_run_folder(folder.path() / "file" / "out", "case.toml", true), IoError);
}

TEST(RunFolder, ATextFileIsReplacedWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "verdict.json";
  write_text_file(path, "first");
  write_text_file(path, "second");
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "second");
  EXPECT_FALSE(fs::exists(path.string() + ".tmp"));
  EXPECT_THROW(write_text_file(folder.path() / "missing" / "x.json", "text"), IoError);
}

}  // namespace
}  // namespace vesica::io
