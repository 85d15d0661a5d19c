#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

#include "vesica/core/error.hpp"
#include "vesica/phase/initial_phase.hpp"

namespace vesica::phase {

/// Interface width of the tests of the initial phase.
inline constexpr double width = 0.1;

/// Message of the exception that initial_phase throws.
template <class Exception = ConfigError>
std::string refusal(const PhaseOptions& options, const mesh::Surface& surface,
                    std::optional<double> target = {}, double interface_width = width) {
  try {
    (void)initial_phase(options, surface, interface_width, target);
  } catch (const Exception& error) {
    return error.what();
  }
  return "accepted";
}

/// A file in the test folder, removed at the end.
class PhaseFile {
 public:
  explicit PhaseFile(const std::string& text) : path_(testing::TempDir() + "order_parameter.txt") {
    std::ofstream(path_) << text;
  }
  PhaseFile(const PhaseFile&) = delete;
  PhaseFile& operator=(const PhaseFile&) = delete;
  ~PhaseFile() { std::remove(path_.c_str()); }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline PhaseOptions of_kind(PhaseKind kind) {
  PhaseOptions options;
  options.kind = kind;
  options.directions = {{1, 0, 0}, {0, 0, -1}};
  return options;
}

}  // namespace vesica::phase
