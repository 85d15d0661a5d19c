#pragma once

#include "io/json_writer.hpp"
#include "vesica/relax/verdict.hpp"

namespace vesica::io {

/// Adds the fields of `verdict.json` to the object that is being written.
void add_verdict(JsonWriter& json, const relax::Verdict& verdict);

}  // namespace vesica::io
