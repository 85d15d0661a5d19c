#include "vesica/measure/phase_domains.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface_samples.hpp"
#include "vesica/measure/diagnostics.hpp"

namespace vesica::measure {
namespace {

constexpr double pi = std::numbers::pi;

problem::State with_phase(const mesh::Surface& surface, const auto& function) {
  Eigen::VectorXd c(surface.positions.rows());
  for (Eigen::Index i = 0; i < c.size(); ++i)
    c[i] = function(Eigen::Vector3d(surface.positions.row(i)));
  return problem::state_of(surface, c);
}

/// A direction along which no element lies.
const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -0.7).normalized();

/// Unit sphere, phase 1 above `height` along the axis, across an interface of width 0.2.
problem::State cap(int resolution, double height) {
  return with_phase(problem::unit_sphere(resolution), [=](const Eigen::Vector3d& x) {
    return std::tanh((x.dot(axis) - height) / 0.2);
  });
}

TEST(PhaseDomains, OfACapHaveItsAreaBoundaryAndCentroid) {
  const double height = 0.3;
  const auto domains = phase_domains(cap(10, height));
  ASSERT_EQ(domains.size(), 2U);
  EXPECT_EQ(domains[0].phase, 1);
  EXPECT_EQ(domains[1].phase, 2);
  EXPECT_NEAR(domains[0].area, 2 * pi * (1 - height), 5e-5);
  EXPECT_NEAR(domains[1].area, 2 * pi * (1 + height), 5e-5);
  const double circle = 2 * pi * std::sqrt(1 - height * height);
  EXPECT_NEAR(domains[0].boundary_length, circle, 3e-4);
  EXPECT_NEAR(domains[1].boundary_length, circle, 3e-4);
  EXPECT_LT((domains[0].centroid - 0.5 * (1 + height) * axis).norm(), 1e-4);
  EXPECT_LT((domains[1].centroid + 0.5 * (1 - height) * axis).norm(), 1e-4);
}

TEST(PhaseDomains, ConvergeWithTheMeshAtLeastWithThirdOrder) {
  const double height = 0.3;
  const auto error = [&](int resolution) {
    const auto domain = phase_domains(cap(resolution, height)).front();
    return Eigen::Vector2d(
        std::abs(domain.area - 2 * pi * (1 - height)),
        std::abs(domain.boundary_length - 2 * pi * std::sqrt(1 - height * height)));
  };
  const Eigen::Vector2d coarse = error(8);
  const Eigen::Vector2d fine = error(24);
  for (int i = 0; i < 2; ++i) EXPECT_LT(fine[i], coarse[i] / 27) << i;
  EXPECT_GT(fine.minCoeff(), 0);
}

TEST(PhaseDomains, OfBandsAroundATorusHaveTheirPartsOfItsArea) {
  const double major = 1;
  const double minor = 0.3;
  const auto state = with_phase(problem::torus(major, minor, 16), [](const Eigen::Vector3d& x) {
    return std::cos(2 * std::atan2(x.y(), x.x()) + 0.1) - 0.5;  // a third, in two bands
  });
  const auto domains = phase_domains(state);
  ASSERT_EQ(num_domains(domains, 1), 2);
  ASSERT_EQ(num_domains(domains, 2), 2);
  const double area = 4 * pi * pi * major * minor;
  for (const auto& domain : domains) {
    EXPECT_NEAR(domain.area, area * (domain.phase == 1 ? 1.0 / 6 : 1.0 / 3), 1e-4 * area);
    EXPECT_NEAR(domain.boundary_length, 2 * 2 * pi * minor, 1e-3);
    EXPECT_NEAR(domain.centroid.z(), 0, 1e-4);
  }
  EXPECT_LT((domains[0].centroid + domains[1].centroid).norm(), 1e-3);
}

TEST(PhaseDomains, AreTheWholeSurfaceWithoutBoundaryWhenThereIsOnePhase) {
  const auto domains = phase_domains(
      with_phase(problem::unit_sphere(8), [](const Eigen::Vector3d&) { return -0.2; }));
  ASSERT_EQ(domains.size(), 1U);
  EXPECT_EQ(domains[0].phase, 2);
  EXPECT_NEAR(domains[0].area, 4 * pi, 1e-4);
  EXPECT_EQ(domains[0].boundary_length, 0);
  EXPECT_TRUE(phase_domains(problem::state_of(problem::unit_sphere(2))).empty());
}

TEST(PhaseDomains, ComeLargestFirst) {
  const auto domains =
      phase_domains(with_phase(problem::unit_sphere(8), [](const Eigen::Vector3d& x) {
        return std::max({x.x() - 0.8, -x.x() - 0.6, x.z() - 0.9});
      }));
  ASSERT_EQ(num_domains(domains, 1), 3);
  EXPECT_NEAR(domains[0].area, 2 * pi * 0.4, 2e-3);
  EXPECT_NEAR(domains[1].area, 2 * pi * 0.2, 2e-3);
  EXPECT_NEAR(domains[2].area, 2 * pi * 0.1, 2e-3);
}

TEST(PhaseDomains, MayHaveTheirBoundaryOnNodesWithOrderParameterZero) {
  // The octants of an icosahedron's mesh are no elements; those of a cube's are.
  shapes::ShapeOptions options;
  options.kind = shapes::ShapeKind::sphere;
  options.base = shapes::SphereBase::cube;
  options.resolution = 5;
  const auto state = with_phase(shapes::make_shape(options), [](const Eigen::Vector3d& x) {
    return std::abs(x.x()) < 1e-12 ? 0 : x.x();
  });
  EXPECT_GT((state.values.order_parameter.array() == 0).count(), 10);
  for (const auto& domain : phase_domains(state)) {
    EXPECT_NEAR(domain.area, 2 * pi, 1e-3);  // area error of 770 nodes
    EXPECT_NEAR(domain.boundary_length, 2 * pi, 1e-3);
  }
}

TEST(PhaseDomains, AreMeasuredAfterEveryStep) {
  const auto state = cap(6, 0);
  const auto measured = measure({}, state);
  ASSERT_EQ(measured.domains.size(), 2U);
  EXPECT_EQ(measured.domains[0].area, phase_domains(state)[0].area);
}

}  // namespace
}  // namespace vesica::measure
