#pragma once

namespace vesica::model {

/// What a constraint holds its quantity at: what the start has, nothing, or a given target.
enum class TargetKind { initial, free, prescribed };

}  // namespace vesica::model
