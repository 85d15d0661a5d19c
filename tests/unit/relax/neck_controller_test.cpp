#include "vesica/relax/neck_controller.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "controller_test.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::relax {
namespace {

/// A peanut of R_c about 1 whose waist shrinks from step to step, interface width 0.4; phase 1 on
/// its high side.
class NeckControllerTest : public ControllerTest {
 protected:
  NeckControllerTest() {
    model_.material.interface_width = 0.4;
    diagnostics_.velocity.normal_rigid_free = 1;
  }

  void set_waist(double radius) {
    shapes::ShapeOptions options;
    options.kind = shapes::ShapeKind::peanut;
    options.resolution = 4;
    options.waist = 2 * radius;
    const mesh::Surface surface = shapes::make_shape(options);
    state_.triangulation = surface.triangulation;
    state_.values.positions = surface.positions;
    state_.values.order_parameter = (surface.positions.col(axis_).array() - interface_).sign();
    if (!model_.is_two_phase) state_.values.order_parameter.resize(0);
  }

  /// What the controller answers to necks of these radii in turn; the last answer.
  std::vector<Request> answer(NeckController& controller, const std::vector<double>& radii) {
    std::vector<Request> requests;
    for (const double radius : radii) {
      set_waist(radius);
      requests = controller.respond(view());
    }
    return requests;
  }
  std::vector<Request> answer(const std::vector<double>& radii) {
    NeckController controller(model_, {});
    return answer(controller, radii);
  }

  static std::string reason_of(const std::vector<Request>& requests,
                               RunStatus status = RunStatus::neck_closes) {
    if (requests.size() != 1) return "no single request";
    const Stop* stop = std::get_if<Stop>(&requests.front());
    if (stop == nullptr || stop->status != status) return "no request to stop with this status";
    return stop->reason;
  }

  double interface_ = 2;  // where c changes its sign: at the waist
  Eigen::Index axis_ = 0;
};

TEST_F(NeckControllerTest, EndsARunWhoseNeckIsBelow15HundredthsOfTheInterfaceWidth) {
  EXPECT_TRUE(answer({0.08, 0.07}).empty());
  const std::string reason = reason_of(answer({0.07, 0.055}));
  EXPECT_NE(reason.find("(radius 0.05"), std::string::npos) << reason;
  EXPECT_NE(reason.find("of the interface width) at ("), std::string::npos) << reason;
  EXPECT_NE(reason.find(", 0.5, 0.5), areas "), std::string::npos) << reason;
}

TEST_F(NeckControllerTest, LeavesAVesicleAtRestAlone) {
  diagnostics_.velocity.normal_rigid_free = 0.029;
  EXPECT_TRUE(answer({0.055, 0.05}).empty());
  diagnostics_.velocity.normal_rigid_free = 0.031;
  EXPECT_FALSE(answer({0.055, 0.05}).empty());
}

TEST_F(NeckControllerTest, LeavesANeckThatWidensAlone) {
  EXPECT_TRUE(answer({0.045, 0.05, 0.055}).empty());
}

TEST_F(NeckControllerTest, ExplainsAFailureOrALimitByAThinNeck) {
  NeckController controller(model_, {});
  EXPECT_TRUE(answer(controller, {0.11, 0.105}).empty());
  EXPECT_TRUE(controller.respond_to_failure(view()).empty());
  EXPECT_TRUE(answer(controller, {0.09}).empty());
  for (const std::string& reason : {reason_of(controller.respond_to_failure(view())),
                                    reason_of(controller.respond_to_limit(view()))})
    EXPECT_NE(reason.find("the neck between the phases closes: length 0.5"), std::string::npos)
        << reason;
}

TEST_F(NeckControllerTest, DoesNotFollowAThinNeckForMoreThanAHundredSteps) {
  NeckController controller(model_, {});
  std::vector<double> radii;
  for (int step = 0; step < 100; ++step) radii.push_back(0.09 - 1e-4 * step);
  EXPECT_TRUE(answer(controller, radii).empty());
  EXPECT_FALSE(answer(controller, {0.0799}).empty());
}

TEST_F(NeckControllerTest, CallsItBuddingWhenAPhaseGetsANewDomain) {
  for (const int phase : {1, 2}) {
    interface_ = phase == 1 ? -1 : 5;
    const std::string reason = reason_of(answer({0.055, 0.05}), RunStatus::budding);
    const std::string start = fmt::format("a domain of phase {} buds, its neck closes: ", phase);
    EXPECT_TRUE(reason.starts_with(start)) << reason;
  }
}

TEST_F(NeckControllerTest, DoesNotCallItBuddingWhenThePhasesPart) {
  const std::string reason = reason_of(answer({0.055, 0.05}));
  EXPECT_TRUE(reason.starts_with("the neck between the phases closes: length ")) << reason;
}

TEST_F(NeckControllerTest, DoesNotCallItBuddingWhenBothPhasesAreOnBothSides) {
  axis_ = 1;
  interface_ = 0.5;
  const std::string reason = reason_of(answer({0.055, 0.05}));
  EXPECT_TRUE(reason.starts_with("a neck closes: length ")) << reason;
}

TEST_F(NeckControllerTest, MeasuresTheNeckOfASinglePhaseByTheRadiusOfTheVesicle) {
  model_.is_two_phase = false;
  EXPECT_TRUE(answer({0.045, 0.04}).empty());
  const std::string reason = reason_of(answer({0.03, 0.025}));
  EXPECT_TRUE(reason.starts_with("a neck closes: ")) << reason;
  EXPECT_NE(reason.find("of the length 0.2 R_c"), std::string::npos) << reason;
}

}  // namespace
}  // namespace vesica::relax
