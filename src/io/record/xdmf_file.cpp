#include "io/record/xdmf_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "io/hdf5/journal.hpp"
#include "io/record/durable_files.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io {

XdmfFile::XdmfFile(std::filesystem::path path, std::string_view hdf5_name, std::string_view run,
                   std::span<const XdmfFrame> frames)
    : path_(std::move(path)), hdf5_name_(hdf5_name), descriptor_(-1) {
  remove_file(path_);
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (descriptor_ < 0) fail();
  write(xdmf_head(run));
  for (const XdmfFrame& frame : frames) add(frame);
}

XdmfFile::~XdmfFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void XdmfFile::add(const XdmfFrame& frame) {
  const bool replaces = frame.time == last_time_;
  if (!replaces) last_frame_ = end_;
  end_ = last_frame_;
  last_time_ = frame.time;
  write(xdmf_frame(hdf5_name_, frame));
}

/// The text and the end of the file behind it.
void XdmfFile::write(std::string_view text) {
  const std::string all = std::string(text) + std::string(xdmf_foot);
  const auto place = static_cast<std::uint64_t>(end_);
  if (const int error = hdf5::write_at(descriptor_, place, all.data(), all.size()); error != 0) {
    errno = error;
    fail();
  }
  end_ += static_cast<std::int64_t>(text.size());
  const auto size = static_cast<off_t>(place + all.size());
  if (::lseek(descriptor_, 0, SEEK_END) > size && ::ftruncate(descriptor_, size) != 0) fail();
}

void XdmfFile::fail() const {
  throw IoError(fmt::format("{}: cannot be written ({})", path_.string(),
                            std::generic_category().message(errno)));
}

}  // namespace vesica::io
