#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

namespace vesica::io::hdf5 {

inline constexpr std::uint64_t page_size = 4096;

/// Pages of a file by their number: what a commit changes in place.
using Pages = std::map<std::uint64_t, std::array<char, page_size>>;

/// Writes `pages` as the whole journal, with a checksum, and waits until the disk has it. Returns 0
/// or the errno of what failed.
[[nodiscard]] int write_journal(int descriptor, const Pages& pages);

/// Reads the pages of a journal; none when there is no journal, or none that is whole: then the
/// commit that it belongs to has changed nothing in place.
[[nodiscard]] Pages read_journal(const std::string& path);

/// Writes all bytes at `address`, whatever interrupts. Returns 0 or an errno.
[[nodiscard]] int write_at(int descriptor, std::uint64_t address, const void* bytes,
                           std::uint64_t size);

/// Reads bytes at `address`; those behind the end of the file are zero. Returns 0 or an errno.
[[nodiscard]] int read_at(int descriptor, std::uint64_t address, void* bytes, std::uint64_t size);

}  // namespace vesica::io::hdf5
