#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "shapes/formats/file_cursor.hpp"

namespace vesica::shapes {

/// How the arrays of an XML file of VTK are encoded.
struct ArrayCoding {
  NumberType header = NumberType::u32;
  bool is_big_endian = false;
  bool is_compressed = false;  ///< by zlib
};

/// Refuses with a text behind the place in the file.
using RefuseArray = std::function<void(const std::string& text)>;

/// Decodes base64 until there are `size` bytes or the text ends. Padding may stand within the text,
/// where VTK ends one part and begins the next.
[[nodiscard]] std::string decode_base64(std::string_view text, std::size_t size,
                                        const RefuseArray& refuse);

/// Returns the bytes of an array of `num_bytes` bytes. `first_bytes(n)` gives the first n bytes of
/// what is stored: a header with sizes, and the data, compressed or not. Refuses sizes that do not
/// fit, and data that cannot be decompressed.
[[nodiscard]] std::string array_bytes(const ArrayCoding& coding,
                                      const std::function<std::string(std::size_t)>& first_bytes,
                                      std::size_t file_size, const RefuseArray& refuse);

}  // namespace vesica::shapes
