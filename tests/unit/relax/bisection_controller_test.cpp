#include "vesica/relax/bisection_controller.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <optional>
#include <variant>

#include "controller_test.hpp"
#include "relaxation_cases.hpp"
#include "vesica/core/error.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/relax/make_mesh_controller.hpp"
#include "vesica/relax/remesh.hpp"

namespace vesica::relax {
namespace {

/// A single-phase unit sphere with elements of diameter 0.33 to 0.4; what else a controller looks
/// at is made up.
class BisectionControllerTest : public ControllerTest {
 protected:
  BisectionControllerTest() {
    model_.is_two_phase = false;
    state_ = test::start_on(test::make_sphere(3));
    diagnostics_.quality = 0.5;
    options_.method = MeshMethod::bisection;
    options_.n_kappa = 100;
    options_.max_size = 0.5;
  }

  static const MeshPlan& plan_of(const std::vector<Request>& requests) {
    return std::get<Remesh>(requests.at(0)).plan;
  }

  AdaptionOptions options_;
};

TEST_F(BisectionControllerTest, AsksEverySoManySteps) {
  options_.every = 4;
  BisectionController controller(options_, model_, scales_);
  for (long step = 0; step <= 20; ++step)
    EXPECT_EQ(controller.respond(view_at(step)).empty(), step == 0 || step % 4 != 0) << step;
}

TEST_F(BisectionControllerTest, AsksWithTheOptionsInUnitsOfTheCase) {
  scales_.length = 2;
  options_.n_in = 3;
  BisectionController controller(options_, model_, scales_);
  (void)controller.respond(view_at(0));
  const auto requests = controller.respond(view_at(5));
  const auto& plan = std::get<BisectionPlan>(plan_of(requests));
  EXPECT_EQ(plan.marking.n_in, 3);
  EXPECT_EQ(plan.marking.n_kappa, 100);
  EXPECT_EQ(plan.marking.max_size, 1);
  EXPECT_EQ(std::get<Remesh>(requests.front()).max_nodes, options_.max_nodes);
}

TEST_F(BisectionControllerTest, TurnsTrianglesOnlyOnTheMeshOfTheStart) {
  BisectionController controller(options_, model_, scales_);
  (void)controller.respond(view_at(0));
  EXPECT_TRUE(std::get<BisectionPlan>(plan_of(controller.respond(view_at(5)))).is_first);
  state_ = test::start_on(test::make_sphere(3));
  EXPECT_FALSE(std::get<BisectionPlan>(plan_of(controller.respond(view_at(10)))).is_first);
}

TEST_F(BisectionControllerTest, DoesNotEndOnLargeElementsUnlessTheyStay) {
  BisectionController controller(options_, model_, scales_);
  EXPECT_TRUE(controller.respond_to_rest(view_at(3)).empty());
  options_.max_size = 0.2;
  BisectionController finer(options_, model_, scales_);
  for (int change = 0; change < 10; ++change)
    EXPECT_EQ(finer.respond_to_rest(view_at(3)).size(), 1U);
  EXPECT_TRUE(finer.respond_to_rest(view_at(3)).empty());
}

TEST_F(BisectionControllerTest, AsksForAConformalImageWhereTheQualityIsLow) {
  options_.method = MeshMethod::conformal;
  BisectionController controller(options_, model_, scales_);
  (void)controller.respond(view_at(0));
  diagnostics_.quality = 0.31;
  EXPECT_TRUE(std::holds_alternative<BisectionPlan>(plan_of(controller.respond(view_at(5)))));
  diagnostics_.quality = 0.29;
  EXPECT_TRUE(std::holds_alternative<ConformalPlan>(plan_of(controller.respond(view_at(10)))));
  // An image that is little better is not made again before the quality has fallen further.
  diagnostics_.quality = 0.35;
  (void)controller.respond(view_at(11));
  diagnostics_.quality = 0.27;
  EXPECT_TRUE(std::holds_alternative<BisectionPlan>(plan_of(controller.respond(view_at(15)))));
  diagnostics_.quality = 0.25;
  EXPECT_TRUE(std::holds_alternative<ConformalPlan>(plan_of(controller.respond(view_at(20)))));
}

TEST_F(BisectionControllerTest, GivesUpAfterFiveFailures) {
  BisectionController controller(options_, model_, scales_);
  for (int failure = 0; failure < 5; ++failure)
    EXPECT_EQ(controller.respond_to_failure(view_at(3)).size(), 1U);
  EXPECT_TRUE(controller.respond_to_failure(view_at(3)).empty());
}

TEST_F(BisectionControllerTest, RefusesConformalImagesOfATorusAtTheStart) {
  shapes::ShapeOptions torus;
  torus.kind = shapes::ShapeKind::torus;
  state_ = test::start_on(shapes::make_shape(torus));
  options_.method = MeshMethod::conformal;
  BisectionController controller(options_, model_, scales_);
  EXPECT_THROW((void)controller.respond(view_at(0)), ConfigError);
}

/// The state on a new mesh of the sphere; absent when nothing is to be done.
class BisectionPlanTest : public BisectionControllerTest {
 protected:
  BisectionPlanTest() {
    marking_.n_in = marking_.n_off = 1e-9;
    marking_.n_kappa = 1e9;
    marking_.max_size = 0.25;
    set_fields();
  }

  void set_fields() {
    const auto& x = state_.values.positions;
    state_.values.order_parameter = x.col(2);
    state_.values.mean_curvature = -2 - x.col(0).array();
    state_.rates = state_.values;
  }

  /// Turns the nodes around the z axis, the more the higher they are.
  void twist() {
    for (auto row : state_.values.positions.rowwise()) {
      const Eigen::Rotation2Dd turn(row[2]);
      row.head<2>() = (turn * row.head<2>().transpose()).transpose().eval();
    }
    set_fields();
  }

  [[nodiscard]] std::optional<problem::State> remeshed_with(const MeshPlan& plan) const {
    return remeshed(model_, state_, {plan, 1e5, "the test asks"});
  }

  void expect_to_keep_fields(const MeshPlan& plan, double error) const {
    const auto changed = remeshed_with(plan);
    ASSERT_TRUE(changed.has_value());
    const auto& x = changed->values.positions;
    EXPECT_GT(x.rows(), state_.values.positions.rows());
    EXPECT_LT((changed->values.order_parameter - x.col(2)).cwiseAbs().maxCoeff(), error);
    EXPECT_LT((changed->values.mean_curvature.array() + 2 + x.col(0).array()).abs().maxCoeff(),
              error);
    const auto before = measure::measure(model_, state_);
    const auto after = measure::measure(model_, *changed);
    EXPECT_NEAR(after.measures.volume(), before.measures.volume(),
                1e-4);  // nu and kappa nu are parallel on a sphere
    EXPECT_NEAR(after.measures.area(), before.measures.area(), 1e-4);
  }

  paper::BisectionOptions marking_;
};

TEST_F(BisectionPlanTest, KeepsFieldsAndIntegrals) {
  expect_to_keep_fields(BisectionPlan{marking_, true}, 5e-3);
  expect_to_keep_fields(BisectionPlan{marking_, false}, 5e-3);
}

TEST_F(BisectionPlanTest, TakesAConformalImageOnlyWhenItIsBetter) {
  const BisectionPlan bisection{marking_, true};
  const auto changed = remeshed_with(ConformalPlan{bisection});
  ASSERT_TRUE(changed.has_value());
  EXPECT_EQ(changed->values.positions, remeshed_with(bisection)->values.positions);
  twist();
  expect_to_keep_fields(ConformalPlan{bisection}, 2e-2);
  EXPECT_NE(remeshed_with(ConformalPlan{bisection})->values.positions.rows(),
            remeshed_with(bisection)->values.positions.rows());
}

TEST_F(BisectionPlanTest, LeavesAMeshThatFitsAlone) {
  marking_.max_size = 0.5;
  EXPECT_FALSE(remeshed_with(BisectionPlan{marking_, true}).has_value());
}

TEST(MakeMeshController, MakesTheControllerOfTheMethod) {
  AdaptionOptions options;
  EXPECT_NE(dynamic_cast<MeshController*>(make_mesh_controller(options, {}, {}).get()), nullptr);
  for (const auto method : {MeshMethod::bisection, MeshMethod::conformal}) {
    options.method = method;
    EXPECT_NE(dynamic_cast<BisectionController*>(make_mesh_controller(options, {}, {}).get()),
              nullptr);
  }
}

}  // namespace
}  // namespace vesica::relax
