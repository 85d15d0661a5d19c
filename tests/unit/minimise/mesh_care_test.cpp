#include "minimise/mesh_care.hpp"

#include <gtest/gtest.h>

#include "relaxation_cases.hpp"

namespace vesica::minimise {
namespace {

mesh::Surface scaled(mesh::Surface surface, const Eigen::Vector3d& factors) {
  surface.positions = surface.positions * factors.asDiagonal();
  return surface;
}

TEST(MeshCare, AFreshMeshIsNeitherWornNorDegenerate) {
  const auto sphere = test::make_sphere(3);
  const MeshCare care(sphere);
  EXPECT_FALSE(care.is_worn(mesh_condition(sphere)));
  EXPECT_FALSE(care.is_degenerate(mesh_condition(sphere)));
}

TEST(MeshCare, AStretchedMeshIsWornAndAFlatOneIsDegenerate) {
  const auto sphere = test::make_sphere(3);
  const MeshCare care(sphere);
  EXPECT_TRUE(care.is_worn(mesh_condition(scaled(sphere, {1, 1, 3}))));
  EXPECT_FALSE(care.is_degenerate(mesh_condition(scaled(sphere, {1, 1, 3}))));
  EXPECT_TRUE(care.is_degenerate(mesh_condition(scaled(sphere, {1, 1, 0.02}))));
}

TEST(MeshCare, AFoldIsDegenerateThoughItsTrianglesAreGood) {
  EXPECT_TRUE(MeshCare(test::make_sphere(3)).is_degenerate({0.6, 2, -0.5}));
}

TEST(MeshCare, WhatTheStartHasIsNotHeldAgainstTheMesh) {
  const auto flat = scaled(test::make_sphere(3), {1, 1, 0.02});
  EXPECT_FALSE(MeshCare(flat).is_degenerate(mesh_condition(flat)));
}

TEST(MeshCare, RedistributionMendsAWornMeshAndCarriesThePhaseFieldOver) {
  const auto sphere = test::make_sphere(4);
  MeshCare care(sphere);
  const auto worn = scaled(sphere, {1, 1, 3});
  ASSERT_TRUE(care.is_worn(mesh_condition(worn)));
  const Eigen::VectorXd field = worn.positions.col(2).array().sin();
  const auto moved = care.redistribute(worn, field);
  const auto condition = mesh_condition({worn.triangulation, moved.positions});
  EXPECT_GT(condition.quality, mesh_condition(worn).quality);
  EXPECT_LT(condition.area_ratio, mesh_condition(worn).area_ratio);
  EXPECT_FALSE(care.is_worn(condition));
  EXPECT_GT((moved.positions - worn.positions).norm(), 0.1);
  // the interpolation error of quadratic elements of size .4
  EXPECT_LT((moved.order_parameter.array() - moved.positions.col(2).array().sin()).abs().maxCoeff(),
            0.01);
}

}  // namespace
}  // namespace vesica::minimise
