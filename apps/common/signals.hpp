#pragma once

#include <atomic>
#include <csignal>

namespace vesica {

/// Lets SIGINT and SIGTERM through to the calling thread. They are blocked when main() begins.
void admit_signals();

/// Catches SIGINT and SIGTERM: the first one is stored in the result, a second one ends the program
/// at once.
const std::atomic<int>& catch_signals();

/// Holds SIGINT and SIGTERM back while it lives. While METIS orders, its own handler stands in
/// place of ours: it makes the ordering fail, and crashes in a thread that does not run METIS.
class DelayedSignals {
 public:
  DelayedSignals();
  DelayedSignals(const DelayedSignals&) = delete;
  DelayedSignals& operator=(const DelayedSignals&) = delete;
  ~DelayedSignals();

 private:
  sigset_t before_{};
};

}  // namespace vesica
