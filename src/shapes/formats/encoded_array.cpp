#include "shapes/formats/encoded_array.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <cstdint>
#include <vector>

namespace vesica::shapes {
namespace {

constexpr std::string_view alphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Numbers of the header from `first` on.
std::vector<std::size_t> header_numbers(const ArrayCoding& coding, std::string_view bytes,
                                        std::size_t count, std::size_t file_size,
                                        const RefuseArray& refuse) {
  // no array is a thousand times larger than its file: zlib does not compress further
  const double most = 1100 * static_cast<double>(file_size);
  const std::size_t size = size_of(coding.header);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < count; ++i) {
    const double value = decode(coding.header, bytes.data() + i * size, coding.is_big_endian);
    if (!(value >= 0 && value <= most))
      refuse(fmt::format("size {} in the header: must be what the file can hold", value));
    numbers.push_back(static_cast<std::size_t>(value));
  }
  return numbers;
}

std::string decompressed(std::string_view compressed, std::size_t size, const RefuseArray& refuse) {
  std::string bytes(size, '\0');
  uLongf length = size;
  const int code =
      ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length,
                   reinterpret_cast<const Bytef*>(compressed.data()), compressed.size());
  if (code != Z_OK || length != size)
    refuse(fmt::format("a block cannot be decompressed to {} bytes (zlib: {})", size, code));
  return bytes;
}

}  // namespace

std::string decode_base64(std::string_view text, std::size_t size, const RefuseArray& refuse) {
  std::string bytes;
  std::uint32_t buffer = 0;
  int num_digits = 0;
  int padding = 0;
  for (const char c : text) {
    if (bytes.size() >= size) break;
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const std::size_t digit = c == '=' ? 0 : alphabet.find(c);
    if (digit == std::string_view::npos) refuse(fmt::format("'{}': must be base64", c));
    padding += c == '=' ? 1 : 0;
    buffer = (buffer << 6) | static_cast<std::uint32_t>(digit);
    if (++num_digits < 4) continue;
    for (int i = 0; i < 3 - padding; ++i)
      bytes.push_back(static_cast<char>((buffer >> (16 - 8 * i)) & 0xffU));
    buffer = 0;
    num_digits = padding = 0;
  }
  if (bytes.size() < size)
    refuse(fmt::format("ends after {} bytes: must have {}", bytes.size(), size));
  bytes.resize(size);
  return bytes;
}

std::string array_bytes(const ArrayCoding& coding,
                        const std::function<std::string(std::size_t)>& first_bytes,
                        std::size_t file_size, const RefuseArray& refuse) {
  const std::size_t unit = size_of(coding.header);
  if (!coding.is_compressed) {
    const std::size_t size =
        header_numbers(coding, first_bytes(unit), 1, file_size, refuse).front();
    return first_bytes(unit + size).substr(unit);
  }
  const std::size_t num_blocks =
      header_numbers(coding, first_bytes(unit), 1, file_size, refuse).front();
  const std::size_t header_size = (3 + num_blocks) * unit;
  if (num_blocks > file_size)
    refuse(fmt::format("{} blocks: must be what the file can hold", num_blocks));
  const std::vector<std::size_t> header =
      header_numbers(coding, first_bytes(header_size), 3 + num_blocks, file_size, refuse);
  std::size_t stored_size = header_size;
  for (std::size_t b = 0; b < num_blocks; ++b) stored_size += header[3 + b];
  const std::string stored = first_bytes(stored_size);
  std::string bytes;
  std::size_t begin = header_size;
  for (std::size_t b = 0; b < num_blocks; ++b) {
    const bool is_partial = b + 1 == num_blocks && header[2] > 0;
    bytes += decompressed(std::string_view(stored).substr(begin, header[3 + b]),
                          is_partial ? header[2] : header[1], refuse);
    begin += header[3 + b];
  }
  return bytes;
}

}  // namespace vesica::shapes
