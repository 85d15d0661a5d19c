#include "vesica/model/make_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "vesica/core/error.hpp"

namespace vesica::model {
namespace {

constexpr double unit_sphere_area = 4 * std::numbers::pi;
constexpr double unit_ball = 4 * std::numbers::pi / 3;
constexpr Measures start{3.0, unit_sphere_area, 1.0};

Target number(double value) { return {TargetKind::prescribed, Schedule(value)}; }
Target ramp(double from, double to, double t0, double t1) {
  return {TargetKind::prescribed, Schedule::ramp(from, to, t0, t1)};
}
const Target free_target{TargetKind::free, {}};

/// Options by the keys of a case file.
struct Given {
  Target volume{};
  Target area{};
  Target phase_difference{};
  std::optional<double> reduced_volume{};
  std::optional<double> phase_fraction{};

  operator ConstraintOptions() const {
    return {{volume, area, phase_difference}, reduced_volume, phase_fraction};
  }
};

std::string refusal(const Given& options, bool is_two_phase = true) {
  try {
    (void)make_targets(options, start, is_two_phase);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string refusal(const MaterialOptions& options, double area = unit_sphere_area) {
  try {
    (void)resolved_material(options, area);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Targets, TakeWhatTheStartHasByDefault) {
  const auto targets = make_targets({}, start, true);
  EXPECT_EQ(targets.of<Volume>()->first(), 3.0);
  EXPECT_EQ(targets.of<Area>()->last(), unit_sphere_area);
  EXPECT_EQ(targets.of<PhaseDifference>()->value(7), 1.0);
}

TEST(Targets, OfFreeQuantitiesAreAbsent) {
  const auto targets = make_targets(
      Given{.volume = free_target, .area = free_target, .phase_difference = free_target}, start,
      true);
  EXPECT_FALSE(targets.of<Volume>() || targets.of<Area>() || targets.of<PhaseDifference>());
}

TEST(Targets, OfASinglePhaseVesicleHaveNoPhaseDifference) {
  EXPECT_FALSE(make_targets({}, start, false).of<PhaseDifference>());
  EXPECT_FALSE(
      make_targets(Given{.phase_difference = free_target}, start, false).of<PhaseDifference>());
}

TEST(Targets, WaitForAPhaseFieldThatIsNotMadeYet) {
  const Measures before{3.0, unit_sphere_area, std::nullopt};
  EXPECT_FALSE(make_targets({}, before, true).of<PhaseDifference>());
  EXPECT_TRUE(
      make_targets(Given{.phase_difference = number(1)}, before, true).of<PhaseDifference>());
}

TEST(Targets, KeepRampsAsTheyAreGiven) {
  const auto targets = make_targets(Given{.volume = ramp(3, 2, 0.5, 1.5)}, start, true);
  EXPECT_EQ(targets.of<Volume>()->value(0), 3);
  EXPECT_EQ(targets.of<Volume>()->value(1), 2.5);
  EXPECT_EQ(targets.of<Volume>()->value(2), 2);
}

TEST(Targets, FromReducedNumbersReferToTheAreaTarget) {
  const auto targets = make_targets(
      Given{.area = number(4 * unit_sphere_area), .reduced_volume = 0.5, .phase_fraction = 0.25},
      start, true);
  EXPECT_NEAR(targets.of<Volume>()->first(), 0.5 * 8 * unit_ball, 1e-13);
  EXPECT_NEAR(targets.of<PhaseDifference>()->first(), 2 * unit_sphere_area, 1e-13);
}

TEST(Targets, FromReducedNumbersFollowARampOfTheArea) {
  const auto targets =
      make_targets(Given{.area = ramp(unit_sphere_area, 4 * unit_sphere_area, 1, 2),
                         .reduced_volume = 0.5,
                         .phase_fraction = 0.25},
                   start, true);
  EXPECT_NEAR(targets.of<Volume>()->value(1), 0.5 * unit_ball, 1e-13);
  EXPECT_NEAR(targets.of<Volume>()->value(2), 4 * unit_ball, 1e-13);
  EXPECT_NEAR(targets.of<PhaseDifference>()->value(1.5), 0.5 * 2.5 * unit_sphere_area, 1e-13);
}

TEST(Targets, RefuseAReducedVolumeAboveOne) {
  EXPECT_EQ(
      refusal({.reduced_volume = 1.2}),
      "constraints.reduced_volume = 1.2: must be <= 1: no surface of this area encloses more");
  EXPECT_EQ(refusal({.reduced_volume = 1.0}), "accepted");
  EXPECT_EQ(refusal({.reduced_volume = 0.0}), "constraints.reduced_volume = 0: must be > 0");
}

TEST(Targets, RefuseAVolumeThatTheAreaCannotEnclose) {
  EXPECT_EQ(refusal({.volume = number(1.5 * unit_ball)}),
            "constraints.volume = 6.283185307179586: the reduced volume reaches 1.5 with area = "
            "initial (12.5664): must be <= 1: no surface of this area encloses more");
  EXPECT_EQ(refusal({.volume = number(unit_ball)}), "accepted");
  EXPECT_NE(refusal({.area = number(0.5 * unit_sphere_area)}), "accepted");
  EXPECT_EQ(refusal({.volume = number(1.5 * unit_ball), .area = free_target}), "accepted");
}

TEST(Targets, RefuseAnImpossibleVolumeAtEitherEndOfARamp) {
  EXPECT_NE(refusal({.volume = ramp(5, 3, 0, 1)}), "accepted");
  EXPECT_NE(refusal({.volume = ramp(3, 5, 0, 1)}), "accepted");
  EXPECT_NE(refusal({.area = ramp(unit_sphere_area, 0.5 * unit_sphere_area, 0, 1)}), "accepted");
  EXPECT_EQ(refusal({.volume = ramp(3, 1, 0, 1),
                     .area = ramp(unit_sphere_area, 0.5 * unit_sphere_area, 0, 1)}),
            "accepted");
}

TEST(Targets, RefuseAVolumeThatBecomesImpossibleWithinARamp) {
  // v = 0.99 at both ends of a ramp of the area by 4: volume and area are linear in time, v is not.
  const auto area = ramp(unit_sphere_area, 4 * unit_sphere_area, 0, 1);
  EXPECT_NE(refusal({.volume = ramp(0.99 * unit_ball, 0.99 * 8 * unit_ball, 0, 1), .area = area}),
            "accepted");
  EXPECT_NE(refusal({.area = area, .reduced_volume = 0.99}), "accepted");
  EXPECT_EQ(refusal({.area = area, .reduced_volume = 0.8}), "accepted");
}

TEST(Targets, RefuseAPhaseDifferenceBeyondTheArea) {
  EXPECT_EQ(refusal({.phase_difference = number(14)}),
            "constraints.phase_difference = 14: must lie between -area and area (12.566)");
  EXPECT_NE(refusal({.phase_difference = number(-14)}), "accepted");
  EXPECT_NE(refusal({.phase_difference = ramp(0, 14, 0, 1)}), "accepted");
  EXPECT_NE(refusal({.phase_difference = ramp(14, 0, 0, 1)}), "accepted");
  EXPECT_EQ(refusal({.phase_difference = number(12)}), "accepted");
  EXPECT_NE(refusal({.area = ramp(20, 11, 0, 1), .phase_difference = number(12)}), "accepted");
}

TEST(Targets, RefuseAnEmptyPhase) {
  EXPECT_NE(refusal({.phase_difference = number(unit_sphere_area)}), "accepted");
  EXPECT_NE(refusal({.phase_fraction = 0.0}), "accepted");
  EXPECT_NE(refusal({.phase_fraction = 1.0}), "accepted");
  EXPECT_EQ(refusal({.phase_fraction = 1.5}),
            "constraints.phase_fraction = 1.5: must be between 0 and 1");
}

TEST(Targets, RefuseAQuantityGivenTwice) {
  EXPECT_EQ(refusal({.volume = number(3), .reduced_volume = 0.9}),
            "constraints.reduced_volume = 0.9: constraints.volume is given too; give one of them");
  EXPECT_NE(refusal({.volume = free_target, .reduced_volume = 0.9}), "accepted");
  EXPECT_NE(refusal({.phase_difference = number(3), .phase_fraction = 0.3}), "accepted");
}

TEST(Targets, RefuseReducedNumbersWithoutAnArea) {
  EXPECT_EQ(
      refusal({.area = free_target, .reduced_volume = 0.9}),
      "constraints.reduced_volume = 0.9: needs an area to refer to, but constraints.area is free");
  EXPECT_NE(refusal({.area = free_target, .phase_fraction = 0.3}), "accepted");
}

TEST(Targets, RefuseAPhaseTargetForASinglePhaseVesicle) {
  EXPECT_EQ(refusal({.phase_difference = number(1)}, false),
            "constraints.phase_difference = 1: must be left out: the vesicle has a single phase");
  EXPECT_NE(refusal({.phase_fraction = 0.3}, false), "accepted");
}

TEST(Targets, MayBeginWithWhatTheStartHas) {
  Target deflation = ramp(0, 2, 1, 3);
  deflation.begins_at_start = true;
  const auto targets = make_targets(Given{.volume = deflation}, start, true);
  EXPECT_EQ(targets.of<Volume>()->value(0), start.volume());
  EXPECT_EQ(targets.of<Volume>()->value(2), 2.5);
  EXPECT_EQ(targets.of<Volume>()->value(3), 2);
  const Measures before{3.0, unit_sphere_area, std::nullopt};
  EXPECT_FALSE(
      make_targets(Given{.phase_difference = deflation}, before, true).of<PhaseDifference>());
}

TEST(Targets, RefuseAnImpossibleVolumeInAnyStage) {
  const auto staged = [](double middle) {
    return Target{TargetKind::prescribed,
                  Schedule::points(ScheduleKind::stages, {0, 1, 2}, {3, middle, 2})};
  };
  EXPECT_EQ(refusal({.volume = staged(4)}), "accepted");
  EXPECT_NE(refusal({.volume = staged(4.3)}), "accepted");
  EXPECT_NE(refusal({.volume = staged(-1)}), "accepted");
  EXPECT_NE(refusal({.phase_difference = staged(13)}), "accepted");
}

TEST(Targets, RefuseNumbersThatAreNotPositiveOrNotFinite) {
  EXPECT_EQ(refusal({.volume = number(-1)}), "constraints.volume = -1: must be > 0");
  EXPECT_EQ(refusal({.volume = ramp(3, 0, 0, 1)}),
            "constraints.volume = [3, 0, 0, 1]: must be > 0");
  EXPECT_EQ(refusal({.area = number(0)}), "constraints.area = 0: must be > 0");
  EXPECT_NE(refusal({.phase_difference = number(std::numeric_limits<double>::quiet_NaN())}),
            "accepted");
}

TEST(Material, InReducedNumbersIsResolvedWithTheCharacteristicRadius) {
  MaterialOptions options;
  options.bending_rigidity = {2, 2};
  options.reduced_line_tension = 12;
  options.rigidity_ratio = 0.5;
  options.saddle_splay_difference = -4;
  const auto material = resolved_material(options, 9 * unit_sphere_area);
  EXPECT_NEAR(material.line_tension.value(0), 12.0 * 2 / 3 * 3 / 4, 1e-14);
  EXPECT_EQ(material.bending_rigidity, (PhaseSchedules{2, 1}));
  EXPECT_EQ(material.gaussian_rigidity, (PhaseSchedules{-8, 0}));
}

TEST(Material, InReducedNumbersFollowsTheRigidityOfPhase1) {
  MaterialOptions options;
  const auto rigidity = Schedule::ramp(1, 3, 0, 2);
  options.bending_rigidity = {rigidity, rigidity};
  options.reduced_line_tension = 4;
  options.rigidity_ratio = 0.5;
  const auto material = resolved_material(options, unit_sphere_area).at(1);
  EXPECT_NEAR(material.line_tension, 4.0 * 2 * 3 / 4, 1e-14);
  EXPECT_EQ(material.bending_rigidity, (PhasePair{2, 1}));
}

TEST(Material, ThatIsResolvedStaysAsItIs) {
  MaterialOptions options;
  options.reduced_line_tension = 12;
  options.rigidity_ratio = 0.5;
  options.saddle_splay_difference = -4;
  const auto once = resolved_material(options, unit_sphere_area);
  const auto twice = resolved_material(once, 9 * unit_sphere_area);
  EXPECT_EQ(twice.line_tension, once.line_tension);
  EXPECT_EQ(twice.bending_rigidity, once.bending_rigidity);
  EXPECT_EQ(twice.gaussian_rigidity, once.gaussian_rigidity);
}

TEST(Material, RefusesAQuantityGivenTwice) {
  EXPECT_EQ(refusal(MaterialOptions{.line_tension = 2, .reduced_line_tension = 12}),
            "material.reduced_line_tension = 12: material.line_tension = 2 is given too; give one "
            "of them");
  EXPECT_NE(refusal(MaterialOptions{.bending_rigidity = {2, 1}, .rigidity_ratio = 0.5}),
            "accepted");
  EXPECT_NE(refusal(MaterialOptions{.gaussian_rigidity = {1, 1}, .saddle_splay_difference = 1}),
            "accepted");
}

TEST(Material, RefusesValuesOutOfRange) {
  EXPECT_EQ(refusal(MaterialOptions{.bending_rigidity = {1, -1}}),
            "material.bending_rigidity = -1: must be > 0");
  EXPECT_EQ(refusal(MaterialOptions{.rigidity_ratio = 0.0}),
            "material.rigidity_ratio = 0: must be > 0");
  EXPECT_EQ(refusal(MaterialOptions{.reduced_line_tension = -1.0}),
            "material.reduced_line_tension = -1: must be >= 0");
  EXPECT_EQ(refusal(MaterialOptions{.interface_width = 0}),
            "material.interface_width = 0: must be > 0");
  EXPECT_NE(refusal(MaterialOptions{.line_tension = Schedule::ramp(1, -1, 0, 1)}), "accepted");
  EXPECT_NE(refusal(MaterialOptions{.reduced_line_tension = 1.0}, 0.0), "accepted");
  EXPECT_EQ(refusal(MaterialOptions{}), "accepted");
}

/// Section 4.2: A = 12.5664, V = 3.1835, A_1 - A_2 = 1.5080, sigma = 24, k = 1.
TEST(ReducedNumbers, OfSection42ComeOutAsInThePaperAndBackAgain) {
  const double area = 12.5664;
  const double volume = 3.1835;
  const double difference = 1.508;
  const double radius = std::sqrt(area / unit_sphere_area);
  const double reduced_volume = volume / (unit_ball * std::pow(radius, 3));
  const double phase_fraction = (area - difference) / (2 * area);
  const double reduced_line_tension = radius * 4.0 / 3 * 24;
  EXPECT_NEAR(reduced_volume, 0.76, 5e-3);
  EXPECT_NEAR(phase_fraction, 0.44, 5e-3);
  EXPECT_NEAR(reduced_line_tension, 32, 1e-3);

  const auto targets =
      make_targets(Given{.reduced_volume = reduced_volume, .phase_fraction = phase_fraction},
                   {4.0, area, 0.0}, true);
  EXPECT_NEAR(targets.of<Volume>()->first(), volume, 1e-14 * volume);
  EXPECT_NEAR(targets.of<PhaseDifference>()->first(), difference, 1e-14 * area);
  EXPECT_TRUE(targets.of<Volume>()->is_constant() && targets.of<PhaseDifference>()->is_constant());

  const auto material = resolved_material({.reduced_line_tension = reduced_line_tension,
                                           .rigidity_ratio = 1.0,
                                           .saddle_splay_difference = 0.0},
                                          area);
  EXPECT_NEAR(material.line_tension.value(0), 24, 1e-13);
  EXPECT_EQ(material.bending_rigidity, (PhaseSchedules{1, 1}));
  EXPECT_EQ(material.gaussian_rigidity, (PhaseSchedules{0, 0}));
}

}  // namespace
}  // namespace vesica::model
