#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "vesica/core/error.hpp"
#include "vesica/paper/bisection.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::paper {
namespace {

/// A sphere of radius 2 with exact curvature, |Q| = sqrt(2) / 2.
class MarkingTest : public ::testing::Test {
 protected:
  MarkingTest() {
    shapes::ShapeOptions shape;
    shape.kind = shapes::ShapeKind::sphere;
    shape.resolution = 4;
    shape.radius = 2;
    sphere_ = shapes::make_shape(shape);
    const mesh::Positions normals = sphere_.positions.rowwise().normalized();
    shape_operator_.resize(normals.rows(), 6);
    for (Eigen::Index i = 0; i < normals.rows(); ++i) {
      const Eigen::Matrix3d p =
          Eigen::Matrix3d::Identity() - normals.row(i).transpose() * normals.row(i);
      shape_operator_.row(i) << p(0, 0) / 2, p(1, 1) / 2, p(2, 2) / 2, p(0, 1) / 2, p(1, 2) / 2,
          p(2, 0) / 2;
    }
    phases_.order_parameter = sphere_.positions.col(0).array().tanh().matrix();
    phases_.width = 0.3;
  }

  [[nodiscard]] Eigen::VectorXd wanted(const BisectionOptions& options) const {
    return wanted_diameters(sphere_, shape_operator_, phases_, options);
  }

  [[nodiscard]] bool is_in_interface(Eigen::Index t) const {
    const auto& nodes = sphere_.triangulation->triangles()[static_cast<std::size_t>(t)];
    return std::any_of(nodes.begin(), nodes.end(), [&](mesh::NodeIndex node) {
      return std::abs(phases_.order_parameter[node]) < 0.95;
    });
  }

  mesh::Surface sphere_;
  fem::NodalShapeOperator shape_operator_;
  adapt::PhaseInterface phases_;
};

TEST_F(MarkingTest, WantsTheDiametersOfThePaper) {
  const Eigen::VectorXd found = wanted({1.5, 0.5, 1e9});
  int num_in_interface = 0;
  for (Eigen::Index t = 0; t < found.size(); ++t) {
    EXPECT_DOUBLE_EQ(found[t], is_in_interface(t) ? 0.2 : 0.6);
    num_in_interface += is_in_interface(t) ? 1 : 0;
  }
  EXPECT_GT(num_in_interface, 0);
  EXPECT_LT(num_in_interface, found.size());
}

TEST_F(MarkingTest, WantsSmallElementsWhereTheCurvatureIsStrong) {
  const Eigen::VectorXd found = wanted({1e-9, 1e-9, 0.1});
  EXPECT_NEAR(found.minCoeff(), 0.1 * std::sqrt(2.0), 1e-14);
  EXPECT_NEAR(found.maxCoeff(), 0.1 * std::sqrt(2.0), 1e-14);
}

TEST_F(MarkingTest, LimitsDiametersAndNeedsNoPhases) {
  phases_ = {};
  EXPECT_NEAR(wanted({1.6, 0.3, 0.1}).maxCoeff(), 0.1 * std::sqrt(2.0), 1e-14);
  EXPECT_EQ(wanted({1.6, 0.3, 10, 0.25}).minCoeff(), 0.25);
}

TEST_F(MarkingTest, MarksAboveTheWantedDiameterAndBelowHalfOfIt) {
  const Eigen::VectorXd present = diameters(sphere_);
  Eigen::VectorXd wanted = present;
  wanted[3] = 0.99 * present[3];
  wanted[4] = 1.99 * present[4];
  wanted[5] = 2.01 * present[5];
  const auto found = marks(sphere_, wanted, 1e9);
  EXPECT_EQ(found[0], Mark::keep);
  EXPECT_EQ(found[3], Mark::refine);
  EXPECT_EQ(found[4], Mark::keep);
  EXPECT_EQ(found[5], Mark::coarsen);
}

TEST_F(MarkingTest, MeetsTheRuleAfterEnoughRounds) {
  mesh::Surface surface = sphere_;
  const auto all = [](const mesh::Surface& on) {
    return Eigen::VectorXd::Constant(on.triangulation->num_triangles(), 0.3).eval();
  };
  for (int round = 0; round < 10; ++round)
    surface = bisect(surface, marks(surface, all(surface), 1e9)).mesh.surface;
  EXPECT_LE(diameters(surface).maxCoeff(), 0.3);
  EXPECT_GE(diameters(surface).minCoeff(), 0.1);  // triangles of the closure may be below half
}

TEST_F(MarkingTest, StaysBelowTheLargestNumberOfNodes) {
  Eigen::VectorXd tenth = 0.1 * diameters(sphere_);
  tenth.array() *= Eigen::ArrayXd::LinSpaced(tenth.size(), 1, 2);
  for (const double max_nodes : {1000.0, 1500.0}) {
    const auto found = bisect(sphere_, marks(sphere_, tenth, max_nodes));
    EXPECT_LE(found.mesh.surface.triangulation->num_nodes(), max_nodes);
    EXPECT_GT(found.mesh.surface.triangulation->num_nodes(), sphere_.triangulation->num_nodes());
  }
  const auto none = bisect(sphere_, marks(sphere_, tenth, 10));
  EXPECT_LE(none.mesh.surface.triangulation->num_nodes(), sphere_.triangulation->num_nodes());
}

TEST_F(MarkingTest, RefusesFieldsOfAnotherMesh) {
  phases_.order_parameter.resize(3);
  try {
    (void)wanted({});
    ADD_FAILURE() << "nothing thrown";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(),
                 "marking: order_parameter has 3 rows: must have one for each of the 642 nodes");
  }
}

}  // namespace
}  // namespace vesica::paper
