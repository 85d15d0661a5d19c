#pragma once

#include <functional>

namespace vesica {

/// Returns the number of threads to use when `requested` are asked for; 0 means all cores. At least
/// 1.
[[nodiscard]] int resolved_threads(int requested);

/// Calls body(begin, end) on `threads` contiguous parts of [0, count) at the same time, as far as
/// there are cores, and waits for all. Parts are the same for the same arguments. The first
/// exception of a part is rethrown here.
void parallel_for(int count, int threads, const std::function<void(int begin, int end)>& body);

}  // namespace vesica
