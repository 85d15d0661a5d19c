#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vesica::io {

/// A JSON file. Values are named by JSON pointers, "/energy/total".
class JsonReader {
 public:
  /// Throws IoError for a file that cannot be read or is no JSON.
  explicit JsonReader(std::filesystem::path path);
  ~JsonReader();

  [[nodiscard]] bool has(const std::string& pointer) const;
  /// All values that are numbers or null, in alphabetical order.
  [[nodiscard]] std::vector<std::string> number_pointers() const;
  /// NaN for null, which stands for a number that is not finite. Throws IoError when there is no
  /// such value or it is no number.
  [[nodiscard]] double number(const std::string& pointer) const;
  /// Nothing for null.
  [[nodiscard]] std::optional<double> optional_number(const std::string& pointer) const;
  [[nodiscard]] std::optional<int> optional_count(const std::string& pointer) const;
  [[nodiscard]] long count(const std::string& pointer) const;
  [[nodiscard]] std::string text(const std::string& pointer) const;
  /// Number of elements of an array.
  [[nodiscard]] std::size_t size(const std::string& pointer) const;
  /// Nothing for null.
  [[nodiscard]] std::optional<bool> optional_flag(const std::string& pointer) const;

 private:
  struct Document;

  std::filesystem::path path_;
  std::unique_ptr<const Document> document_;
};

}  // namespace vesica::io
