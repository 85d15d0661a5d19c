#include "vesica/core/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace vesica {
namespace {

TEST(ParallelFor, CoversEveryIndexOnce) {
  for (const int count : {0, 1, 2, 7, 1000}) {
    for (const int threads : {1, 2, 3, 8}) {
      std::vector<std::atomic<int>> visits(static_cast<std::size_t>(count));
      parallel_for(count, threads, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) ++visits[static_cast<std::size_t>(i)];
      });
      for (const auto& visit : visits) EXPECT_EQ(visit, 1) << count << " on " << threads;
    }
  }
}

std::set<std::pair<int, int>> parts_of(int count, int threads) {
  std::set<std::pair<int, int>> parts;
  std::mutex mutex;
  parallel_for(count, threads, [&](int begin, int end) {
    const std::scoped_lock lock(mutex);
    parts.emplace(begin, end);
  });
  return parts;
}

TEST(ParallelFor, CutsTheRangeIntoTheSamePartsEveryTime) {
  const auto parts = parts_of(100, 3);
  EXPECT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts_of(100, 3), parts);
}

TEST(ParallelFor, MakesNoMorePartsThanThereAreIndices) { EXPECT_EQ(parts_of(2, 8).size(), 2U); }

TEST(ParallelFor, RethrowsTheExceptionOfTheFirstPartThatFailsAfterAllHaveEnded) {
  std::atomic<int> ended = 0;
  std::string message;
  try {
    parallel_for(40, 4, [&](int begin, int) {
      ++ended;
      if (begin >= 20) throw std::runtime_error("part from " + std::to_string(begin));
    });
  } catch (const std::runtime_error& error) {
    message = error.what();
  }
  EXPECT_EQ(message, "part from 20");
  EXPECT_EQ(ended, 4);
}

TEST(ResolvedThreads, TakesTheRequestOrAtLeastOne) {
  EXPECT_EQ(resolved_threads(3), 3);
  EXPECT_GE(resolved_threads(0), 1);
}

}  // namespace
}  // namespace vesica
