#include <gtest/gtest.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <numbers>

#include "nodal_shape_operators.hpp"
#include "observed_order.hpp"
#include "relaxation_cases.hpp"
#include "vesica/measure/diagnostics.hpp"
#include "vesica/problem/relaxation_problem.hpp"

namespace vesica {
namespace {

constexpr double pi = std::numbers::pi;
const Eigen::Vector3d semi_axes(1.5, 1, 0.8);

/// Error of a quantity on two meshes, the second with half the mesh size.
struct Errors {
  double coarse;
  double fine;
  [[nodiscard]] double order() const { return test::observed_order(coarse, fine, 2); }
};

template <class Measure>
Errors errors(const Measure& measure, int resolution = 4) {
  return {measure(resolution), measure(2 * resolution)};
}

problem::ConstraintValues constraints_of(const mesh::Surface& surface) {
  const auto c = test::single_phase_case(surface, 1, 1);
  const problem::RelaxationProblem problem(surface.triangulation, c.model, 1);
  const auto y = problem.layout().pack(c.start.values);
  return problem.constraints(y, Eigen::VectorXd::Zero(y.size()));
}

TEST(SphereGeometry, HasVolumeAndAreaOfFourthOrder) {
  const auto volume = errors([](int resolution) {
    return constraints_of(test::make_sphere(resolution)).value[0] - 4 * pi / 3;
  });
  const auto area = errors([](int resolution) {
    return constraints_of(test::make_sphere(resolution)).value[1] - 4 * pi;
  });
  EXPECT_GT(volume.order(), 3.8);
  EXPECT_GT(area.order(), 3.8);
  EXPECT_LT(std::abs(area.fine), 1e-4);
}

TEST(EllipsoidGeometry, HasVolumeOfFourthOrder) {
  const auto volume = errors([](int resolution) {
    return constraints_of(test::make_ellipsoid(semi_axes, resolution)).value[0] -
           4 * pi / 3 * semi_axes.prod();
  });
  EXPECT_GT(volume.order(), 3.8);
}

TEST(RecoveredShapeOperator, ConvergesOnSphereEllipsoidAndTorus) {
  const auto sphere = errors([](int resolution) {
    return test::shape_operator_error(test::make_sphere(resolution), test::sphere_shape_operator);
  });
  const auto ellipsoid = errors([](int resolution) {
    return test::shape_operator_error(
        test::make_ellipsoid(semi_axes, resolution),
        [](const Eigen::Vector3d& x) { return test::ellipsoid_shape_operator(x, semi_axes); });
  });
  const auto torus = errors(
      [](int resolution) {
        shapes::ShapeOptions shape;
        shape.kind = shapes::ShapeKind::torus;
        shape.minor_radius = 0.4;
        shape.resolution = resolution;
        return test::shape_operator_error(shapes::make_shape(shape), [](const Eigen::Vector3d& x) {
          return test::torus_shape_operator(x, 1);
        });
      },
      8);
  EXPECT_GT(sphere.order(), 1.7);  // measured 1.91, 1.90, 1.65
  EXPECT_GT(ellipsoid.order(), 1.7);
  EXPECT_GT(torus.order(), 1.5);
}

/// kappa of equation (b), solved with the rates at the start of a run without constraints.
problem::State consistent_start(const mesh::Surface& surface) {
  auto c = test::single_phase_case(surface, 1, 1);
  c.model.targets = {};
  return run::make_stepper({}, c.model, c.start)->state();
}

/// Root mean square over the nodes of kappa + tr Q.
template <class Exact>
double curvature_error(const mesh::Surface& surface, const Exact& shape_operator) {
  const auto state = consistent_start(surface);
  double sum = 0;
  for (Eigen::Index i = 0; i < surface.positions.rows(); ++i) {
    const Eigen::Vector3d x = surface.positions.row(i);
    sum += std::pow(state.values.mean_curvature[i] + shape_operator(x).trace(), 2);
  }
  return std::sqrt(sum / static_cast<double>(surface.positions.rows()));
}

TEST(MeanCurvature, OfEquationBConvergesOnSphereAndEllipsoid) {
  const auto sphere = errors([](int resolution) {
    return curvature_error(test::make_sphere(resolution), test::sphere_shape_operator);
  });
  const auto ellipsoid = errors([](int resolution) {
    return curvature_error(
        test::make_ellipsoid(semi_axes, resolution),
        [](const Eigen::Vector3d& x) { return test::ellipsoid_shape_operator(x, semi_axes); });
  });
  EXPECT_GT(sphere.order(), 1.9);  // measured 2.07, 2.49
  EXPECT_GT(ellipsoid.order(), 2);
}

TEST(BendingEnergy, OfTheSphereTendsToEightPiTimesTheRigidity) {
  const auto energy = errors([](int resolution) {
    const auto state = consistent_start(test::make_sphere(resolution));
    const auto c = test::single_phase_case({state.triangulation, state.values.positions}, 1, 1);
    return *measure::measure(c.model, state).energy.of<model::BendingEnergy>() - 8 * pi;
  });
  EXPECT_GT(energy.order(), 3.7);  // measured 3.94
}

/// Dual norms of the residuals of (a) and (b) at the exact sphere, sqrt(sum r_i^2 / m_i) with the
/// weights m_i = A / N.
std::array<double, 2> sphere_residuals(int resolution) {
  const auto surface = test::make_sphere(resolution);
  auto c = test::single_phase_case(surface, 4 * pi / 3, 4 * pi);
  c.start.values.mean_curvature.setConstant(-2);
  c.start.values.multipliers = {-6.0, 3.0, {}};  // lambda_V + 2 lambda_A / R = 0
  const problem::RelaxationProblem problem(surface.triangulation, c.model, 1);
  const auto y = problem.layout().pack(c.start.values);
  const auto residual = problem.residual({}, 0, y, Eigen::VectorXd::Zero(y.size()));
  std::array<double, 2> sums{};
  for (Eigen::Index k = 0; k < problem.layout().num_nodal(); ++k)
    sums[k % 4 == 3 ? 0 : 1] += residual[k] * residual[k];
  const double weight = 4 * pi / static_cast<double>(problem.layout().num_nodes());
  return {std::sqrt(sums[0] / weight), std::sqrt(sums[1] / weight)};
}

TEST(ResidualOfTheExactSphere, FallsWithTheMeshSize) {
  const auto velocity = errors([](int resolution) { return sphere_residuals(resolution)[0]; });
  const auto curvature = errors([](int resolution) { return sphere_residuals(resolution)[1]; });
  EXPECT_GT(velocity.order(), 1.6);  // measured 1.85, 1.96
  EXPECT_GT(curvature.order(), 1.7);
}

}  // namespace
}  // namespace vesica
