#include "vesica/problem/dof_layout.hpp"

#include <gtest/gtest.h>

#include "equation_case.hpp"

namespace vesica::problem {
namespace {

TEST(DofLayout, ReturnsTheFieldsThatWerePackedForEveryModel) {
  for (const auto& c : equation_cases()) {
    SCOPED_TRACE(c.name);
    const DofLayout layout(c.surface.triangulation->num_nodes(), c.model);
    const auto fields = layout.unpack(c.y);
    EXPECT_EQ(fields.positions, c.surface.positions);
    EXPECT_EQ(layout.pack(fields), c.y);
    EXPECT_EQ(fields.multipliers.of<model::Volume>().has_value(),
              c.model.targets.of<model::Volume>().has_value());
    EXPECT_EQ(fields.multipliers.of<model::Area>().has_value(),
              c.model.targets.of<model::Area>().has_value());
    EXPECT_EQ(fields.multipliers.of<model::PhaseDifference>().has_value(),
              c.model.targets.of<model::PhaseDifference>().has_value());
  }
}

TEST(DofLayout, CarriesNoPhaseFieldForOnePhase) {
  auto model = two_phase_model();
  const DofLayout two(42, model);
  EXPECT_EQ(two.block_size(), 5);
  EXPECT_EQ(two.size(), 42 * 5 + 4);
  model.is_two_phase = false;
  const DofLayout one(42, model);
  EXPECT_EQ(one.block_size(), 4);
  EXPECT_EQ(one.size(), 42 * 4 + 3);
  EXPECT_EQ(one.multiplier(2), -1);
}

TEST(DofLayout, MarksPositionsAndOrderParameterAsDifferential) {
  const DofLayout layout(42, two_phase_model());
  const auto mask = layout.differential_mask();
  EXPECT_EQ(mask.sum(), 42 * 4);
  EXPECT_EQ(mask[3], 0);
  EXPECT_EQ(mask[4], 1);
  EXPECT_EQ(mask.tail<3>().sum(), 0);
}

}  // namespace
}  // namespace vesica::problem
