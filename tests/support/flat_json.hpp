#pragma once

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace vesica::test {

/// The values of a JSON file by their pointers, "/energy/total".
inline nlohmann::json flat_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file).flatten();
}

}  // namespace vesica::test
