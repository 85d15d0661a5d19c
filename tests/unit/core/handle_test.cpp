#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "vesica/core/handle.hpp"

namespace vesica {
namespace {

std::vector<int> released;
void record(int object) { released.push_back(object); }
using Recorded = Handle<int, record>;

TEST(Handle, ReleasesItsObjectOnce) {
  released.clear();
  {
    Recorded first(7);
    const Recorded second(std::move(first));
    EXPECT_FALSE(first);
    EXPECT_EQ(second.get(), 7);
  }
  EXPECT_EQ(released, std::vector<int>{7});
}

TEST(Handle, SwapsWhenItIsMoveAssigned) {
  released.clear();
  {
    Recorded first(1);
    Recorded second(2);
    first = std::move(second);
    EXPECT_EQ(first.get(), 2);
    EXPECT_TRUE(released.empty());
  }
  EXPECT_EQ(released, (std::vector<int>{1, 2}));
}

TEST(Handle, DoesNotReleaseWhatWasGivenAway) {
  released.clear();
  {
    Recorded handle(3);
    EXPECT_EQ(handle.detach(), 3);
  }
  EXPECT_TRUE(released.empty());
}

}  // namespace
}  // namespace vesica
