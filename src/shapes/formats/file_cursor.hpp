#pragma once

#include <fmt/format.h>

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "vesica/core/error.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// How numbers stand in a file.
enum class Encoding { text, little_endian, big_endian };

enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

[[nodiscard]] std::size_t size_of(NumberType type);
[[nodiscard]] bool is_integer(NumberType type);
/// The number of type `type` that begins at `bytes`.
[[nodiscard]] double decode(NumberType type, const char* bytes, bool is_big_endian);

/// Goes through a file that is made of words, lines and numbers, which may be binary.
class FileCursor {
 public:
  FileCursor(std::string path, std::string_view bytes) : path_(std::move(path)), bytes_(bytes) {}

  Encoding encoding = Encoding::text;

  /// What is being read, for messages: "vertex 3 of 42".
  void enter(std::string_view object) { object_ = object, count_ = 0; }
  void enter(std::string_view object, std::size_t index, std::size_t count) {
    object_ = object, index_ = index, count_ = count;
  }

  /// True when nothing but blanks is left.
  [[nodiscard]] bool is_at_end() const;
  /// The rest of the line, without its end; the cursor moves behind it.
  std::string_view line();
  /// The next word, wherever it stands.
  std::string_view word();
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  /// The next word as a number of things that the file has: not negative, at most its bytes.
  std::size_t count();
  /// The next number: a word, or binary; NaN and infinity are numbers.
  double number(NumberType type);
  /// The next number as an index below `size`.
  mesh::NodeIndex index(NumberType type, std::size_t size);
  /// Three numbers that are finite.
  Eigen::Vector3d point(NumberType type);
  void skip_bytes(std::size_t size);

  /// Throws ConfigError `path:line: object: text`, or `path: byte n: ...` in binary parts.
  template <class... Args>
  [[noreturn]] void refuse(fmt::format_string<Args...> text, Args&&... args) const {
    throw ConfigError(place() + fmt::format(text, std::forward<Args>(args)...));
  }

 private:
  [[nodiscard]] std::string place() const;

  std::string path_;
  std::string_view bytes_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;  ///< of the last word or line
  std::size_t next_line_ = 1;
  std::string object_;
  std::size_t index_ = 0;
  std::size_t count_ = 0;
  bool is_binary_ = false;  ///< what was read last
};

}  // namespace vesica::shapes
