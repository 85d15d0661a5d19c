#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <vector>

#include "functional_lists.hpp"
#include "revolution_surface.hpp"

namespace vesica::model {
namespace {

using Eigen::ArrayXd;

/// A surface with a displacement w along the normal and a change eta of c.
struct Example {
  ProfileKind kind;
  Revolution shape;
  ArrayXd w;
  ArrayXd eta;
};

/// No symmetry between its two halves.
Example dented_torus(const PeriodicGrid& grid) {
  const auto& t = grid.t;
  Example example{ProfileKind::torus, {}, {}, {}};
  example.shape.r = 1.7 + 0.6 * t.cos() + 0.08 * (2 * t).cos() - 0.05 * (3 * t).sin();
  example.shape.z = 0.7 * t.sin() + 0.06 * (2 * t).sin() + 0.04 * (3 * t).cos();
  example.shape.c = 0.2 + 0.5 * t.sin() + 0.2 * (2 * t).cos();
  example.w = 0.3 + 0.5 * t.cos() - 0.4 * (2 * t).sin() + 0.2 * (3 * t).cos();
  example.eta = 0.6 * t.cos() + 0.3 * (2 * t).sin() - 0.1;
  return example;
}

/// Dumbbell with lobes of different size; r odd, the rest even in t.
Example dumbbell(const PeriodicGrid& grid) {
  const auto& t = grid.t;
  Example example{ProfileKind::sphere, {}, {}, {}};
  example.shape.r = 0.8 * t.sin() + 0.2 * (3 * t).sin() + 0.04 * (2 * t).sin();
  example.shape.z = -1.6 * t.cos() + 0.05 * (2 * t).cos();
  example.shape.c = 0.1 - 0.6 * t.cos() + 0.2 * (2 * t).cos();
  example.w = 0.2 + 0.5 * t.cos() - 0.3 * (2 * t).cos() + 0.2 * (3 * t).cos();
  example.eta = 0.7 * t.cos() + 0.3 * (2 * t).cos() - 0.2;
  return example;
}

template <class Functional>
double integral(const Material& material, const PeriodicGrid& grid, ProfileKind kind,
                const Revolution& shape) {
  const SampledRevolution sampled(grid, kind, shape);
  const auto points = sampled.points();
  double sum = 0;
  for (Eigen::Index j = 0; j < points.size(); ++j) {
    sum += sampled.area_weights()[j] * density_of<Functional>(material, points[j]);
  }
  return sum;
}

/// int a w + b . grad w + s eta + q . grad eta.
template <class Functional>
double first_variation(const Material& material, const PeriodicGrid& grid, const Example& example) {
  const SampledRevolution sampled(grid, example.kind, example.shape);
  const auto points = sampled.points();
  const ArrayXd w_t = grid.differentiate(example.w);
  const ArrayXd eta_t = grid.differentiate(example.eta);
  double sum = 0;
  for (Eigen::Index j = 0; j < points.size(); ++j) {
    const auto v = variation_of_term<Functional>(material, points[j]);
    sum += sampled.area_weights()[j] *
           (v.a * example.w[j] + dot(v.b, sampled.gradient(w_t[j], j)) + v.s * example.eta[j] +
            dot(v.q, sampled.gradient(eta_t[j], j)));
  }
  return sum;
}

/// d/dtau at 0 of the functional along x + tau w nu, c + tau eta, c carried by the points: central
/// differences of two steps, extrapolated, so the error is O(step^4).
template <class Functional>
double difference_quotient(const Material& material, const PeriodicGrid& grid,
                           const Example& example) {
  const SampledRevolution sampled(grid, example.kind, example.shape);
  const auto at = [&](double tau) {
    Revolution moved = example.shape;
    moved.r += tau * example.w * sampled.normal_r();
    moved.z += tau * example.w * sampled.normal_z();
    moved.c += tau * example.eta;
    return integral<Functional>(material, grid, example.kind, moved);
  };
  const auto central = [&](double step) { return (at(step) - at(-step)) / (2 * step); };
  constexpr double step = 1e-3;
  return (4 * central(step) - central(2 * step)) / 3;
}

std::vector<Material> materials() {
  std::vector<Material> list(4, generic_material());
  list[1].spontaneous_curvature = {0, 0};
  list[2].bending_rigidity = {1, 1};
  list[2].spontaneous_curvature = {2, -2};
  list[2].gaussian_rigidity = {-2, 2};
  list[3].bending_rigidity = {0.5, 4};
  list[3].gaussian_rigidity = {3, 0};
  list[3].interface_width = 0.1;
  list[3].line_tension = 24;
  return list;
}

template <class Functional>
class EveryVariation : public testing::Test {
 protected:
  static void check(const PeriodicGrid& grid, const Example& example) {
    Example only_shape = example;
    only_shape.eta.setZero();
    Example only_phase = example;
    only_phase.w.setZero();
    for (const auto& material : materials()) {
      const double scale = std::abs(difference_quotient<Functional>(material, grid, only_shape)) +
                           std::abs(difference_quotient<Functional>(material, grid, only_phase));
      EXPECT_GT(scale, 1e-2);
      for (const auto& direction : {only_shape, only_phase, example}) {
        EXPECT_NEAR(first_variation<Functional>(material, grid, direction),
                    difference_quotient<Functional>(material, grid, direction), 1e-8 * scale);
      }
    }
  }
};
TYPED_TEST_SUITE(EveryVariation, AllFunctionals, FunctionalName);

TYPED_TEST(EveryVariation, IsTheDifferenceQuotientOnADentedTorus) {
  const PeriodicGrid grid(128);
  this->check(grid, dented_torus(grid));
}

TYPED_TEST(EveryVariation, IsTheDifferenceQuotientOnADumbbell) {
  const PeriodicGrid grid(192);
  this->check(grid, dumbbell(grid));
}

/// Guards the sampling that the tests above trust.
TEST(SampledRevolutionTest, GivesAreaVolumeAndEnergyOfSphereAndTorus) {
  const PeriodicGrid grid(64);
  const ArrayXd one = ArrayXd::Ones(64);
  const Material material;
  const double pi = std::numbers::pi;
  const Revolution sphere{2 * grid.t.sin(), -2 * grid.t.cos(), one};
  EXPECT_NEAR(integral<Area>(material, grid, ProfileKind::sphere, sphere), 16 * pi, 1e-11);
  EXPECT_NEAR(integral<Volume>(material, grid, ProfileKind::sphere, sphere), 32 * pi / 3, 1e-11);
  EXPECT_NEAR(integral<BendingEnergy>(material, grid, ProfileKind::sphere, sphere), 8 * pi, 1e-10);
  const Revolution clifford{std::sqrt(2.0) + grid.t.cos(), grid.t.sin(), one};
  EXPECT_NEAR(integral<Area>(material, grid, ProfileKind::torus, clifford),
              4 * std::sqrt(2.0) * pi * pi, 1e-11);
  EXPECT_NEAR(integral<Volume>(material, grid, ProfileKind::torus, clifford),
              2 * std::sqrt(2.0) * pi * pi, 1e-11);
  EXPECT_NEAR(integral<BendingEnergy>(material, grid, ProfileKind::torus, clifford), 4 * pi * pi,
              1e-10);
}

/// Gauss-Bonnet: constant k_g gives 2 pi chi.
TEST(SampledRevolutionTest, GivesTheTopologicalGaussianEnergy) {
  const PeriodicGrid grid(192);
  Material material;
  material.gaussian_rigidity = {1, 1};
  const auto torus = dented_torus(grid);
  const auto sphere = dumbbell(grid);
  EXPECT_NEAR(integral<GaussianEnergy>(material, grid, torus.kind, torus.shape), 0, 1e-9);
  EXPECT_NEAR(integral<GaussianEnergy>(material, grid, sphere.kind, sphere.shape),
              4 * std::numbers::pi, 1e-9);
}

}  // namespace
}  // namespace vesica::model
