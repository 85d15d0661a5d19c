#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "io/record/xdmf.hpp"

namespace vesica::io {

/// The XDMF file of a run that goes on: every frame is put in place of the end of the text, in one
/// write, so that the file can be read at any time and is never written as a whole again.
class XdmfFile {
 public:
  /// Makes the file with the frames there are. Throws IoError, as `add` does.
  XdmfFile(std::filesystem::path path, std::string_view hdf5_name, std::string_view run,
           std::span<const XdmfFrame> frames);
  XdmfFile(const XdmfFile&) = delete;
  XdmfFile& operator=(const XdmfFile&) = delete;
  ~XdmfFile();

  /// Takes the place of the frame before when it has the same time.
  void add(const XdmfFrame& frame);

 private:
  void write(std::string_view text);
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::string hdf5_name_;
  int descriptor_;
  std::int64_t last_frame_ = 0;  ///< where it begins
  std::int64_t end_ = 0;         ///< of the last frame
  double last_time_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace vesica::io
