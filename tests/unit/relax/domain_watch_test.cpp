#include "vesica/relax/domain_watch.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace vesica::relax {
namespace {

constexpr double width = 0.2;  // a disc of this diameter: area 0.0314

/// Domains of phase 1 with the given areas beside one of phase 2, step by step.
std::vector<Event> events_of(const std::vector<std::vector<double>>& areas, bool finishes = false) {
  DomainWatch watch(width);
  std::vector<Event> events;
  const auto add = [&](const std::vector<Event>& more) {
    events.insert(events.end(), more.begin(), more.end());
  };
  for (std::size_t step = 0; step < areas.size(); ++step) {
    problem::State state;
    state.time = 0.5 * static_cast<double>(step);
    solve::StepReport report;
    report.counts.steps = static_cast<long>(step);
    measure::Diagnostics measured;
    for (const double area : areas[step]) measured.domains.push_back({1, area, 0});
    measured.domains.push_back({2, 1, 0});
    add(watch.look({state, report, measured}));
  }
  if (finishes) add(watch.finish());
  return events;
}

TEST(DomainWatch, TellsAChangeThatLastsThreeSteps) {
  const auto events = events_of({{1, 1}, {1, 1}, {2}, {2}, {2}, {2}});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step, 2);
  EXPECT_EQ(events[0].time, 1);
  EXPECT_EQ(events[0].what, "domains of phase 1: 2 -> 1");
}

TEST(DomainWatch, DoesNotTellAChangeThatGoesAwayAgain) {
  EXPECT_TRUE(events_of({{1}, {1, 1}, {1, 1}, {1}, {1}, {1, 1}, {1}}, true).empty());
}

TEST(DomainWatch, DoesNotSeeSpecks) {
  EXPECT_TRUE(events_of({{1}, {1, 0.03}, {1, 0.03}, {1, 0.03}, {1, 0.03}}, true).empty());
  EXPECT_EQ(events_of({{1}, {1, 0.033}, {1, 0.033}, {1, 0.033}}).size(), 1U);
}

TEST(DomainWatch, TellsOneChangeOfANumberThatChangesInSteps) {
  const auto events = events_of({{1}, {1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}});
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, "domains of phase 1: 1 -> 3");
}

TEST(DomainWatch, TellsAtTheEndWhatHasJustChanged) {
  EXPECT_TRUE(events_of({{1}, {1}, {}}).empty());
  const auto events = events_of({{1}, {1}, {}}, true);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].what, "domains of phase 1: 1 -> 0");
  EXPECT_EQ(events_of({{1}, {}, {}, {}}, true).size(), 1U);  // not twice
}

}  // namespace
}  // namespace vesica::relax
