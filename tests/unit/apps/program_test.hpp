#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "temporary_folder.hpp"

namespace vesica::test {

/// A coarse ellipsoid with loose tolerances.
inline constexpr const char* prolate_case = R"(
[shape]
kind = "ellipsoid"
semi_axes = [1.4, 0.9, 0.9]
resolution = 2

[solver]
rtol = 1e-2

[stop]
normal_velocity = 1e-2
)";

/// Runs programs as a user does, in a folder of its own.
class ProgramTest : public ::testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  /// Exit status of `program arguments`; its output is kept.
  int run(const std::string& program, const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.string() + "' && '" + program + "' " + arguments + " > output.txt 2>&1";
    const int status = std::system(command.c_str());
    std::ostringstream text;
    text << std::ifstream(folder_ / "output.txt").rdbuf();
    output_ = text.str();
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  TemporaryFolder temporary_;
  std::filesystem::path folder_ = temporary_.path();
  std::string output_;
};

}  // namespace vesica::test
