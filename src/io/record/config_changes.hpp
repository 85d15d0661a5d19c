#pragma once

#include <string>
#include <vector>

#include "vesica/config/config.hpp"

namespace vesica::io {

/// An option that differs between two configurations, its values as in a case file; the text is
/// empty where there is none.
struct ConfigChange {
  std::string key;  ///< "table.key"
  std::string before;
  std::string after;
};

/// Returns what differs, `output.directory` left out.
[[nodiscard]] std::vector<ConfigChange> changes_between(const config::RunConfig& before,
                                                        const config::RunConfig& after);

}  // namespace vesica::io
