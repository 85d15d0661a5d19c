#include "shapes/formats/file_cursor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <system_error>

namespace vesica::shapes {
namespace {

constexpr std::string_view blanks = " \t\r\v\f\n";

template <class T>
double decode_as(const char* bytes, bool is_big_endian) {
  std::array<char, sizeof(T)> copy{};
  std::copy_n(bytes, sizeof(T), copy.begin());
  if (is_big_endian != (std::endian::native == std::endian::big)) std::ranges::reverse(copy);
  T value{};
  std::memcpy(&value, copy.data(), sizeof(T));
  return static_cast<double>(value);
}

}  // namespace

std::size_t size_of(NumberType type) {
  using enum NumberType;
  switch (type) {
    case i8:
    case u8:
      return 1;
    case i16:
    case u16:
      return 2;
    case i32:
    case u32:
    case f32:
      return 4;
    case i64:
    case u64:
    case f64:
      break;
  }
  return 8;
}

bool is_integer(NumberType type) { return type != NumberType::f32 && type != NumberType::f64; }

double decode(NumberType type, const char* bytes, bool is_big_endian) {
  using enum NumberType;
  switch (type) {
    case i8:
      return decode_as<std::int8_t>(bytes, is_big_endian);
    case u8:
      return decode_as<std::uint8_t>(bytes, is_big_endian);
    case i16:
      return decode_as<std::int16_t>(bytes, is_big_endian);
    case u16:
      return decode_as<std::uint16_t>(bytes, is_big_endian);
    case i32:
      return decode_as<std::int32_t>(bytes, is_big_endian);
    case u32:
      return decode_as<std::uint32_t>(bytes, is_big_endian);
    case i64:
      return decode_as<std::int64_t>(bytes, is_big_endian);
    case u64:
      return decode_as<std::uint64_t>(bytes, is_big_endian);
    case f32:
      return decode_as<float>(bytes, is_big_endian);
    case f64:
      break;
  }
  return decode_as<double>(bytes, is_big_endian);
}

bool FileCursor::is_at_end() const {
  return bytes_.find_first_not_of(blanks, position_) == std::string_view::npos;
}

std::string_view FileCursor::line() {
  is_binary_ = false;
  line_ = next_line_;
  if (position_ >= bytes_.size()) refuse("the file ends here");
  const std::size_t end = std::min(bytes_.find('\n', position_), bytes_.size());
  std::string_view text = bytes_.substr(position_, end - position_);
  position_ = std::min(end + 1, bytes_.size());
  ++next_line_;
  if (text.ends_with('\r')) text.remove_suffix(1);
  return text;
}

std::string_view FileCursor::word() {
  is_binary_ = false;
  const std::size_t begin = std::min(bytes_.find_first_not_of(blanks, position_), bytes_.size());
  next_line_ += static_cast<std::size_t>(
      std::ranges::count(bytes_.substr(position_, begin - position_), '\n'));
  line_ = next_line_;
  const std::size_t end = std::min(bytes_.find_first_of(blanks, begin), bytes_.size());
  position_ = end;
  if (begin == end) refuse("the file ends here");
  return bytes_.substr(begin, end - begin);
}

std::size_t FileCursor::count() {
  const std::string_view text = word();
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size())
    refuse("'{}': must be a whole number, not negative", text);
  if (value > bytes_.size() || value > std::numeric_limits<mesh::NodeIndex>::max())
    refuse("{}: is more than a file of {} bytes can hold", value, bytes_.size());
  return value;
}

double FileCursor::number(NumberType type) {
  if (encoding != Encoding::text) {
    const std::size_t begin = position_;
    skip_bytes(size_of(type));
    return decode(type, bytes_.data() + begin, encoding == Encoding::big_endian);
  }
  std::string_view text = word();
  const std::string_view digits =
      text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    refuse("'{}': must be a number", text);
  const double limit = std::min(9e18, std::exp2(8 * static_cast<double>(size_of(type))));
  if (is_integer(type) && !(std::abs(value) < limit && value == std::trunc(value)))
    refuse("'{}': must be an integer of {} bytes", text, size_of(type));
  return value;
}

mesh::NodeIndex FileCursor::index(NumberType type, std::size_t size) {
  const double value = number(type);
  if (!(value >= 0 && value < static_cast<double>(size) && value == std::trunc(value)))
    refuse("point {}: must be one of the {} points, counted from 0", value, size);
  return static_cast<mesh::NodeIndex>(value);
}

Eigen::Vector3d FileCursor::point(NumberType type) {
  Eigen::Vector3d point;
  for (double& coordinate : point) {
    coordinate = number(type);
    if (!std::isfinite(coordinate)) refuse("coordinate {}: must be finite", coordinate);
  }
  return point;
}

void FileCursor::skip_bytes(std::size_t size) {
  is_binary_ = true;
  if (size > bytes_.size() - position_) refuse("the file ends here, at {} bytes", bytes_.size());
  position_ += size;
}

std::string FileCursor::place() const {
  std::string text = is_binary_ ? fmt::format("{}: byte {}: ", path_, position_)
                                : fmt::format("{}:{}: ", path_, line_);
  if (count_ > 0) return text + fmt::format("{} {} of {}: ", object_, index_ + 1, count_);
  return object_.empty() ? text : text + object_ + ": ";
}

}  // namespace vesica::shapes
