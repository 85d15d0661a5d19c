#include "vesica/io/surface_writer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "expect_message.hpp"
#include "fake_run.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/surface_file.hpp"

namespace vesica::io {
namespace {

class SurfaceWriter : public testing::Test {
 protected:
  SurfaceWriter() {
    state_.values.positions *= 1 / 3.0;  // no number ends after a few digits
    state_.values.order_parameter = state_.values.positions.col(0);
    state_.values.mean_curvature = state_.values.positions.col(1);
  }
  [[nodiscard]] shapes::Shape written(const std::string& name) const {
    const std::string path = (temporary_.path() / name).string();
    write_surface(path, state_.surface(), fields_of(state_));
    return shapes::read_shape(path);
  }

  test::TemporaryFolder temporary_;
  problem::State state_ = fake_state();
};

TEST_F(SurfaceWriter, VtuKeepsAllNodesAndFieldsToTheLastDigit) {
  const shapes::Shape read = written("s.vtu");
  EXPECT_EQ(read.surface.positions, state_.values.positions);
  EXPECT_TRUE(std::ranges::equal(read.surface.triangulation->triangles(),
                                 state_.triangulation->triangles()));
  ASSERT_EQ(read.fields.size(), 2U);
  EXPECT_EQ(read.fields[0].name, "c");
  EXPECT_EQ(read.fields[0].values, state_.values.order_parameter);
  EXPECT_EQ(read.fields[1].name, "kappa");
  EXPECT_EQ(read.fields[1].values, state_.values.mean_curvature);
}

TEST_F(SurfaceWriter, PlyAndObjKeepTheVertices) {
  for (const std::string name : {"s.ply", "s.obj"}) {
    const shapes::Shape read = written(name);
    EXPECT_EQ(read.surface.positions.topRows(6), state_.values.positions.topRows(6));
    const auto triangles = state_.triangulation->triangles();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      EXPECT_TRUE(std::equal(triangles[t].begin(), triangles[t].begin() + 3,
                             read.surface.triangulation->triangles()[t].begin()));
    }
    ASSERT_EQ(read.fields.size(), name == "s.ply" ? 2U : 0U);
    if (!read.fields.empty()) {
      EXPECT_EQ(read.fields[0].values, state_.values.order_parameter.head(6));
    }
  }
}

TEST_F(SurfaceWriter, AStartOfOnePhaseHasNoFields) {
  state_.values.order_parameter.resize(0);
  state_.values.mean_curvature.setZero();
  EXPECT_TRUE(written("s.vtu").fields.empty());
}

TEST_F(SurfaceWriter, RefusesOtherEndingsAndFoldersThatAreNotThere) {
  test::expect_message<ConfigError>([&] { write_surface("s.stl", state_.surface(), {}); },
                                    "s.stl: extension '.stl': must be .vtu, .ply or .obj");
  const std::string path = (temporary_.path() / "none" / "s.vtu").string();
  test::expect_message<IoError>([&] { write_surface(path, state_.surface(), {}); },
                                path + ".tmp: cannot be written");
}

}  // namespace
}  // namespace vesica::io
