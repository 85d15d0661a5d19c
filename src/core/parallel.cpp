#include "vesica/core/parallel.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <thread>
#include <vector>

#include "core/held_signals.hpp"

namespace vesica {

int resolved_threads(int requested) {
  if (requested > 0) return requested;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int count, int threads, const std::function<void(int, int)>& body) {
  const int parts = std::clamp(threads, 1, std::max(1, count));
  if (parts == 1) return body(0, count);
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(parts));
  // The threads that TBB makes and keeps must never get them (linalg/metis_signals.hpp).
  const HeldSignals held;
  tbb::parallel_for(0, parts, [&](int part) {
    try {
      const auto bound = [&](std::int64_t p) { return static_cast<int>(p * count / parts); };
      body(bound(part), bound(part + 1));
    } catch (...) {
      failures[static_cast<std::size_t>(part)] = std::current_exception();
    }
  });
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

}  // namespace vesica
