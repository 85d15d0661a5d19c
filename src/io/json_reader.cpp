#include "io/json_reader.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "vesica/core/error.hpp"

namespace vesica::io {

struct JsonReader::Document {
  std::filesystem::path path;
  nlohmann::json root;

  [[nodiscard]] const nlohmann::json& at(const std::string& pointer) const {
    const nlohmann::json::json_pointer at(pointer);
    if (!root.contains(at)) refuse(pointer, "is missing");
    return root.at(at);
  }
  [[noreturn]] void refuse(const std::string& pointer, std::string_view rule) const {
    throw IoError(fmt::format("{}: {} {}", path.string(), pointer, rule));
  }
};

JsonReader::JsonReader(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream file(path_);
  if (!file) {
    throw IoError(fmt::format("{}: cannot be read ({})", path_.string(),
                              std::generic_category().message(errno)));
  }
  try {
    document_ = std::make_unique<const Document>(Document{path_, nlohmann::json::parse(file)});
  } catch (const nlohmann::json::exception& error) {
    throw IoError(fmt::format("{}: is no JSON: {}", path_.string(), error.what()));
  }
}

JsonReader::~JsonReader() = default;

bool JsonReader::has(const std::string& pointer) const {
  return document_->root.contains(nlohmann::json::json_pointer(pointer));
}

std::vector<std::string> JsonReader::number_pointers() const {
  std::vector<std::string> pointers;
  const nlohmann::json flat = document_->root.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    // An empty array is flattened to null, too.
    if (value.is_number() || (value.is_null() && document_->at(pointer).is_null()))
      pointers.push_back(pointer);
  }
  return pointers;
}

std::optional<double> JsonReader::optional_number(const std::string& pointer) const {
  const nlohmann::json& value = document_->at(pointer);
  if (value.is_null()) return std::nullopt;
  if (!value.is_number()) document_->refuse(pointer, "must be a number or null");
  return value.get<double>();
}

double JsonReader::number(const std::string& pointer) const {
  return optional_number(pointer).value_or(std::numeric_limits<double>::quiet_NaN());
}

std::optional<int> JsonReader::optional_count(const std::string& pointer) const {
  if (document_->at(pointer).is_null()) return std::nullopt;
  return static_cast<int>(count(pointer));
}

long JsonReader::count(const std::string& pointer) const {
  const nlohmann::json& value = document_->at(pointer);
  if (!value.is_number_integer()) document_->refuse(pointer, "must be a whole number");
  return value.get<long>();
}

std::string JsonReader::text(const std::string& pointer) const {
  const nlohmann::json& value = document_->at(pointer);
  if (!value.is_string()) document_->refuse(pointer, "must be a text");
  return value.get<std::string>();
}

std::size_t JsonReader::size(const std::string& pointer) const {
  const nlohmann::json& value = document_->at(pointer);
  if (!value.is_array()) document_->refuse(pointer, "must be an array");
  return value.size();
}

std::optional<bool> JsonReader::optional_flag(const std::string& pointer) const {
  const nlohmann::json& value = document_->at(pointer);
  if (value.is_null()) return std::nullopt;
  if (!value.is_boolean()) document_->refuse(pointer, "must be true, false or null");
  return value.get<bool>();
}

}  // namespace vesica::io
