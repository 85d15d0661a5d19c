#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <stop_token>
#include <thread>

#include "core/held_signals.hpp"
#include "linalg/node_ordering.hpp"
#include "vesica/core/parallel.hpp"

namespace vesica::linalg {
namespace {

std::atomic<int> num_received{0};

void mask_signals(int how) {
  sigset_t signals{};
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(how, &signals, nullptr);
}

/// As the programs do: the threads that OpenBLAS starts when it is loaded must not get the signal.
void block_signals() { mask_signals(SIG_BLOCK); }
using Initialiser = void (*)();
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser before_libraries = block_signals;

/// The nodes of an n x n grid and the edges between them.
SparseMatrix grid(int n) {
  SparseMatrix matrix;
  matrix.size = n * n;
  matrix.column_starts = {0};
  for (int node = 0; node < n * n; ++node) {
    if (node >= n) matrix.rows.push_back(node - n);
    if (node % n > 0) matrix.rows.push_back(node - 1);
    matrix.rows.push_back(node);
    if (node % n < n - 1) matrix.rows.push_back(node + 1);
    if (node < n * n - n) matrix.rows.push_back(node + n);
    matrix.column_starts.push_back(static_cast<SparseIndex>(matrix.rows.size()));
  }
  matrix.values.assign(matrix.rows.size(), 1);
  return matrix;
}

/// Sends SIGTERM to this process, again and again, from a thread that does not take it.
class Sender {
 public:
  Sender()
      : thread_([](const std::stop_token& stop) {
          const HeldSignals held;
          while (!stop.stop_requested()) {
            kill(getpid(), SIGTERM);
            std::this_thread::sleep_for(std::chrono::microseconds(200));
          }
        }) {}

 private:
  std::jthread thread_;
};

TEST(NodeOrdering, LeavesSignalsToTheHandlerOfTheProgram) {
  struct sigaction action {};
  action.sa_handler = [](int) { ++num_received; };
  action.sa_flags = SA_NODEFER;
  struct sigaction before {};
  sigaction(SIGTERM, &action, &before);
  mask_signals(SIG_UNBLOCK);
  const SparseMatrix matrix = grid(100);
  const auto expected = node_ordering(matrix, 1);
  parallel_for(8, 8, [](int, int) {});  // its threads stay, and are not to get the signals
  {
    const Sender sender;
    for (int i = 0; i < 10; ++i) EXPECT_EQ(node_ordering(matrix, 1), expected);
  }
  struct sigaction after {};
  sigaction(SIGTERM, &before, &after);
  EXPECT_GT(num_received, 0);
  EXPECT_EQ(after.sa_handler, action.sa_handler);
  EXPECT_NE(after.sa_flags & SA_NODEFER, 0) << "METIS gives the handler back without its flags";
}

}  // namespace
}  // namespace vesica::linalg
