#pragma once

#include <csignal>

#include "core/held_signals.hpp"

namespace vesica::linalg {

/// Holds SIGTERM back from the calling thread while METIS orders, and then gives the program its
/// handler back with all flags. METIS puts a handler of its own in that place, which makes the
/// ordering fail and crashes in a thread that does not run METIS: a program that catches the signal
/// in several threads has to block it in the others. Threads of element loops never get it.
class SignalsHeldFromMetis {
 public:
  SignalsHeldFromMetis() { sigaction(SIGTERM, nullptr, &action_); }
  SignalsHeldFromMetis(const SignalsHeldFromMetis&) = delete;
  SignalsHeldFromMetis& operator=(const SignalsHeldFromMetis&) = delete;
  ~SignalsHeldFromMetis() { sigaction(SIGTERM, &action_, nullptr); }

 private:
  HeldSignals held_;  // until the handler is back
  struct sigaction action_ {};
};

}  // namespace vesica::linalg
