#include "vesica/model/schedule.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "vesica/core/error.hpp"
#include "vesica/model/model.hpp"

namespace vesica::model {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double after(double time) { return std::nextafter(time, infinity); }

std::vector<double> kinks(const Schedule& schedule) {
  std::vector<double> result;
  for (double time = schedule.next_kink(-infinity); time < infinity;
       time = schedule.next_kink(time))
    result.push_back(time);
  return result;
}

std::string refusal(const std::vector<double>& times, const std::vector<double>& values) {
  try {
    (void)Schedule::points(ScheduleKind::linear, times, values);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Schedule, OfANumberIsConstant) {
  const Schedule schedule = 3;
  EXPECT_EQ(schedule.value(-1e9), 3);
  EXPECT_EQ(schedule.value(1e9), 3);
  EXPECT_EQ(schedule.rate(0), 0);
  EXPECT_TRUE(schedule.is_constant());
  EXPECT_TRUE(kinks(schedule).empty());
  EXPECT_EQ(schedule.rests_after(), -infinity);
}

TEST(Schedule, IsLinearBetweenItsPointsAndRestsOutside) {
  const auto schedule = Schedule::points(ScheduleKind::linear, {1, 2, 4}, {5, 3, 4});
  EXPECT_EQ(schedule.value(0), 5);
  EXPECT_EQ(schedule.value(1.25), 4.5);
  EXPECT_EQ(schedule.value(2), 3);
  EXPECT_EQ(schedule.value(3), 3.5);
  EXPECT_EQ(schedule.value(4), 4);
  EXPECT_EQ(schedule.value(100), 4);
  EXPECT_EQ(schedule.rate(1.5), -2);
  EXPECT_EQ(schedule.rate(3), 0.5);
  EXPECT_EQ(kinks(schedule), (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(schedule.rests_after(), 4);
  EXPECT_FALSE(schedule.is_constant());
}

TEST(Schedule, OfStagesHoldsAValueUntilItJumps) {
  const auto schedule = Schedule::points(ScheduleKind::stages, {0, 1, 2, 3}, {5, 3, 3, 4});
  EXPECT_EQ(schedule.value(-1), 5);
  EXPECT_EQ(schedule.value(0.5), 5);
  EXPECT_EQ(schedule.value(1.5), 3);
  EXPECT_EQ(schedule.value(4), 4);
  EXPECT_EQ(schedule.rate(0.5), 0);
  EXPECT_TRUE(schedule.jumps_at(1));
  EXPECT_TRUE(schedule.jumps_at(3));
  EXPECT_FALSE(schedule.jumps_at(0));
  EXPECT_FALSE(schedule.jumps_at(2));
  EXPECT_FALSE(schedule.jumps_at(2.5));
  EXPECT_EQ(schedule.rests_after(), 3);
}

TEST(Schedule, BelongsAtAKinkToThePieceThatEndsThere) {
  const auto stages = Schedule::points(ScheduleKind::stages, {0, 1}, {5, 3});
  EXPECT_EQ(stages.value(1), 5);
  EXPECT_EQ(stages.value(after(1)), 3);
  const auto ramp = Schedule::ramp(5, 3, 0, 1);
  EXPECT_EQ(ramp.rate(0), 0);
  EXPECT_EQ(ramp.rate(after(0)), -2);
  EXPECT_EQ(ramp.rate(1), -2);
  EXPECT_EQ(ramp.rate(after(1)), 0);
  EXPECT_EQ(ramp.value(1), 3);
  EXPECT_FALSE(ramp.jumps_at(1));
}

TEST(Schedule, RefusesPointsThatAreNoFunctionOfTime) {
  EXPECT_EQ(refusal({0, 1}, {1, 2, 3}),
            "{ times = [0, 1], values = [1, 2, 3], kind = \"linear\" }: must have as many times as "
            "values");
  EXPECT_EQ(refusal({0}, {1}),
            "{ times = [0], values = [1], kind = \"linear\" }: must have at least two times");
  EXPECT_EQ(refusal({0, 0}, {1, 2}),
            "{ times = [0, 0], values = [1, 2], kind = \"linear\" }: must have ascending times");
  EXPECT_NE(refusal({1, 0}, {1, 2}), "accepted");
  EXPECT_NE(refusal({0, infinity}, {1, 2}), "accepted");
  EXPECT_NE(refusal({0, 1}, {1, std::nan("")}), "accepted");
  EXPECT_THROW((void)Schedule::ramp(1, 2, 3, 3), ConfigError);
}

TEST(Schedule, IsWrittenAsInACaseFile) {
  EXPECT_EQ(text_of(Schedule(2.5)), "2.5");
  EXPECT_EQ(text_of(Schedule::ramp(5, 3, 0, 1)), "[5, 3, 0, 1]");
  EXPECT_EQ(text_of(Schedule::points(ScheduleKind::stages, {0, 1}, {5, 3})),
            "{ times = [0, 1], values = [5, 3], kind = \"stages\" }");
}

TEST(Model, ChangesWhereverAScheduleDoes) {
  Model model;
  EXPECT_EQ(model.next_kink(-1), infinity);
  EXPECT_EQ(model.rests_after(), -infinity);
  model.targets.of<model::Volume>() = Schedule::ramp(4, 3, 1, 5);
  model.material.spontaneous_curvature.phase_2 =
      Schedule::points(ScheduleKind::stages, {2, 3}, {0, -1});
  EXPECT_EQ(model.next_kink(0), 1);
  EXPECT_EQ(model.next_kink(2), 3);
  EXPECT_EQ(model.next_kink(3), 5);
  EXPECT_TRUE(model.jumps_at(3));
  EXPECT_FALSE(model.jumps_at(5));
  EXPECT_EQ(model.rests_after(), 5);
  EXPECT_EQ(model.at(3).material.spontaneous_curvature, (PhasePair{0, 0}));
  EXPECT_EQ(model.at(4).material.spontaneous_curvature, (PhasePair{0, -1}));
}

}  // namespace
}  // namespace vesica::model
