#include "vesica/fem/recovery.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "nodal_shape_operators.hpp"
#include "relaxation_cases.hpp"
#include "vesica/core/error.hpp"
#include "vesica/fem/mass_matrix.hpp"
#include "vesica/fem/quadrature.hpp"

namespace vesica::fem {
namespace {

mesh::Surface torus(int resolution) {
  shapes::ShapeOptions shape;
  shape.kind = shapes::ShapeKind::torus;
  shape.major_radius = 2;
  shape.minor_radius = 0.5;
  shape.resolution = resolution;
  return shapes::make_shape(shape);
}

TEST(RecoveredShapeOperator, IsTheTangentProjectionOverTheRadiusOnASphere) {
  const double coarse =
      test::shape_operator_error(test::make_sphere(2, 2.0), test::sphere_shape_operator);
  const double fine =
      test::shape_operator_error(test::make_sphere(6, 2.0), test::sphere_shape_operator);
  EXPECT_LT(fine, 0.02 * std::sqrt(2.0) / 2);  // two per cent of |P / R|
  EXPECT_LT(fine, coarse / 3);
}

TEST(RecoveredShapeOperator, HasBothCurvaturesOfATorus) {
  const auto exact = [](const Eigen::Vector3d& x) { return test::torus_shape_operator(x, 2); };
  const double coarse = test::shape_operator_error(torus(6), exact);
  const double fine = test::shape_operator_error(torus(12), exact);
  EXPECT_LT(fine, 0.04 * 2);  // four per cent of 1 / minor_radius
  EXPECT_LT(fine, coarse / 2);
}

TEST(RecoveredShapeOperator, ScalesLikeOneOverLength) {
  const auto small = test::make_ellipsoid({1, 1.3, 0.8}, 2);
  auto large = small;
  large.positions *= 10;
  const auto q = test::recovered(small);
  EXPECT_LT((test::recovered(large) * 10 - q).norm(), 1e-9 * q.norm());
}

TEST(RecoveredShapeOperator, TurnsWithTheSurfaceAndIgnoresWhereItIs) {
  const auto surface = test::make_ellipsoid({1, 1.3, 0.8}, 2);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  auto moved = surface;
  moved.positions = (surface.positions * turn.transpose()).rowwise() + Eigen::RowVector3d(3, -1, 2);
  const auto q = test::recovered(surface);
  const auto q_moved = test::recovered(moved);
  ASSERT_GT(test::tensor(q, 0).norm(), 0.1);
  for (Eigen::Index i = 0; i < q.rows(); ++i) {
    const Eigen::Matrix3d expected = turn * test::tensor(q, i) * turn.transpose();
    EXPECT_LT((test::tensor(q_moved, i) - expected).norm(), 1e-9);
  }
}

TEST(RecoveredShapeOperator, IsTheSameToTheLastBitOnAnyNumberOfThreads) {
  const auto surface = test::make_ellipsoid({1, 1.3, 0.8}, 3);
  const auto q = test::recovered(surface, 1);
  EXPECT_EQ(test::recovered(surface, 2), q);
  EXPECT_EQ(test::recovered(surface, 5), q);
}

TEST(RecoveredShapeOperator, AsksForASmallerStepWhenAPositionIsNotANumber) {
  auto surface = test::make_sphere(1);
  surface.positions(5, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)test::recovered(surface), RecoverableError);
}

TEST(MassMatrix, IsInvertedToTheToleranceOfTheConjugateGradients) {
  const auto sphere = test::make_sphere(2);
  const NodeGraph graph(*sphere.triangulation);
  const auto count = static_cast<std::size_t>(sphere.triangulation->num_triangles());
  std::vector<double> elements(count * 36);
  for (std::size_t t = 0; t < count; ++t) {
    const double area = 1 + 0.5 * static_cast<double>(t % 3);  // flat triangles, unequal
    for (const auto& point : triangle_rule()) {
      for (std::size_t k = 0; k < 36; ++k)
        elements[t * 36 + k] +=
            area * point.weight * point.shape.value[k / 6] * point.shape.value[k % 6];
    }
  }
  const auto mass = gather_mass_matrix(graph, elements, 1);
  NodalTriple expected(graph.num_nodes(), 3);
  for (Eigen::Index i = 0; i < expected.rows(); ++i)
    expected.row(i) << std::sin(static_cast<double>(i)), 1, 0;
  const NodalTriple rhs = mass * expected;
  EXPECT_LT((solve_mass_matrix(mass, rhs, 1) - expected).norm(), 1e-9 * expected.norm());
}

}  // namespace
}  // namespace vesica::fem
