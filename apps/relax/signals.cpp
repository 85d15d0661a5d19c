#include "signals.hpp"

namespace vesica {
namespace {

std::atomic<int> received_signal{0};
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may store it");

}  // namespace

const std::atomic<int>& catch_signals() {
  struct sigaction action {};
  action.sa_handler = [](int signal) { received_signal.store(signal); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return received_signal;
}

DelayedSignals::DelayedSignals() {
  sigset_t delayed{};
  sigemptyset(&delayed);
  sigaddset(&delayed, SIGINT);
  sigaddset(&delayed, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &delayed, &before_);
}

DelayedSignals::~DelayedSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace vesica
