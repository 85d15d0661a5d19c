#include "signals.hpp"

namespace vesica {
namespace {

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may store it");

sigset_t handled_signals() {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

void block_signals() {
  const sigset_t signals = handled_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Runs before the shared libraries are initialised: threads that they start there (OpenBLAS does)
/// inherit the mask and never get a signal that `DelayedSignals` holds back from the main thread.
using Initialiser = void (*)();
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser before_libraries = block_signals;

}  // namespace

void admit_signals() {
  const sigset_t signals = handled_signals();
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

const std::atomic<int>& catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { received_signal.store(signal); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return received_signal;
}

DelayedSignals::DelayedSignals() {
  const sigset_t delayed = handled_signals();
  pthread_sigmask(SIG_BLOCK, &delayed, &before_);
}

DelayedSignals::~DelayedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace vesica
