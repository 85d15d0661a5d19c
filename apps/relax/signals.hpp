#pragma once

#include <atomic>
#include <csignal>

namespace vesica {

/// Catches SIGINT and SIGTERM: the first one is stored in the result, a second one ends the program
/// at once.
const std::atomic<int>& catch_signals();

/// Holds SIGINT and SIGTERM back while it lives. METIS answers SIGTERM itself, with a failed
/// ordering.
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
