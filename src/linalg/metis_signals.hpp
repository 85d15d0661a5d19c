#pragma once

#include <csignal>

namespace vesica::linalg {

/// Holds SIGTERM back from the calling thread while METIS orders, and then gives the program its
/// handler back with all flags. METIS puts a handler of its own in that place, which makes the
/// ordering fail and crashes in a thread that does not run METIS: a program that catches the signal
/// in several threads has to block it in the others.
class SignalsHeldFromMetis {
 public:
  SignalsHeldFromMetis() {
    sigset_t held{};
    sigemptyset(&held);
    sigaddset(&held, SIGTERM);
    pthread_sigmask(SIG_BLOCK, &held, &mask_);
    sigaction(SIGTERM, nullptr, &action_);
  }
  SignalsHeldFromMetis(const SignalsHeldFromMetis&) = delete;
  SignalsHeldFromMetis& operator=(const SignalsHeldFromMetis&) = delete;
  ~SignalsHeldFromMetis() {
    sigaction(SIGTERM, &action_, nullptr);
    pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
  }

 private:
  sigset_t mask_{};
  struct sigaction action_ {};
};

}  // namespace vesica::linalg
