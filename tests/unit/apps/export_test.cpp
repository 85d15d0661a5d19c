#include <string>

#include "program_test.hpp"
#include "programs.hpp"

namespace vesica {
namespace {

namespace fs = std::filesystem;

const std::string two_phases = std::string(test::prolate_case) +
                               "max_steps = 3\n[phase]\nkind = \"caps\"\n"
                               "[material]\ninterface_width = 0.6\n[output]\nevery_steps = 1\n";

class ExportTest : public test::ProgramTest {
 protected:
  void SetUp() override {
    write("case.toml", two_phases);
    ASSERT_EQ(run(program_relax, "case.toml --out out"), 1) << output_;
  }
  /// Runs a Python program whose output is kept.
  int python(const std::string& text) {
    write("read.py", text);
    return run("/usr/bin/python3", "read.py");
  }
};

TEST_F(ExportTest, MeshioReadsTheTrajectoryAsTheDocumentationSays) {
  ASSERT_EQ(python(R"(
import meshio, numpy as np
with meshio.xdmf.TimeSeriesReader("out/trajectory.xdmf") as run:
    points, cells = run.read_points_cells()
    assert run.num_steps == 4, run.num_steps
    assert points.shape == (162, 3)
    assert cells[0].type == "triangle6" and cells[0].data.shape == (80, 6)
    for k in range(run.num_steps):
        time, point_data, cell_data = run.read_data(k)
        assert set(point_data) == {"positions", "c", "kappa", "normal_velocity",
                                   "bending_energy_density"}
        assert (np.array_equal(point_data["positions"], points)) == (k == 0)
    assert time > 0
)"),
            0)
      << output_;
}

TEST_F(ExportTest, H5pyReadsTheTrajectoryAsTheDocumentationSays) {
  ASSERT_EQ(python(R"(
import h5py
with h5py.File("out/trajectory.h5") as run:
    frame = run["frames"][sorted(run["frames"])[-1]]
    x, c, triangles = frame["positions"][:], frame["order_parameter"][:], frame["mesh/triangles"][:]
    time, energy = run["series/time"][:], run["series/energy_total"][:]
    assert x.shape == (162, 3) and c.shape == (162,) and triangles.shape == (80, 6)
    assert len(time) == len(energy) >= 4
)"),
            0)
      << output_;
}

TEST_F(ExportTest, WritesAFrameThatMeshioAndAnotherCaseCanRead) {
  ASSERT_EQ(run(program_export, "out last.vtu"), 0) << output_;
  EXPECT_NE(output_.find("last.vtu: frame 3 (0 to 3), t = "), std::string::npos) << output_;
  ASSERT_EQ(run(program_export, "out first.ply --frame 0"), 0) << output_;
  ASSERT_EQ(run(program_export, "out first.obj --frame 0"), 0) << output_;
  ASSERT_EQ(python(R"(
import h5py, meshio, numpy as np
last, first, bare = (meshio.read(name) for name in ("last.vtu", "first.ply", "first.obj"))
with h5py.File("out/trajectory.h5") as run:
    frame = run["frames/000003"]
    assert np.array_equal(last.points, frame["positions"][:])
    assert np.array_equal(last.cells_dict["triangle6"], frame["mesh/triangles"][:])
    assert np.array_equal(last.point_data["c"], frame["order_parameter"][:])
    assert np.array_equal(last.point_data["kappa"], frame["mean_curvature"][:])
assert len(first.points) == len(bare.points) == 42 and len(first.point_data["c"]) == 42
)"),
            0)
      << output_;
  write("again.toml",
        "[shape]\nkind = \"file\"\npath = \"last.vtu\"\n[phase]\nkind = \"file\"\nfield = \"c\"\n"
        "match_target = false\n[material]\ninterface_width = 0.6\n");
  ASSERT_EQ(run(program_relax, "again.toml --write-start again.vtu"), 0) << output_;
  ASSERT_EQ(python(R"(
import meshio, numpy as np
a, b = meshio.read("last.vtu"), meshio.read("again.vtu")
assert np.array_equal(a.points, b.points) and np.array_equal(a.point_data["c"], b.point_data["c"])
)"),
            0)
      << output_;
}

TEST_F(ExportTest, AStartIsWrittenWithoutAFolderOfResults) {
  ASSERT_EQ(run(program_relax, "case.toml --out none --write-start start.ply"), 0) << output_;
  EXPECT_TRUE(fs::exists(folder_ / "start.ply"));
  EXPECT_FALSE(fs::exists(folder_ / "none"));
  EXPECT_EQ(output_.substr(output_.rfind("start.ply")), "start.ply: 162 nodes, 80 triangles\n");
  EXPECT_EQ(run(program_relax, "case.toml --write-start start.stl"), 2);
}

TEST_F(ExportTest, RefusesFramesAndRunsThatAreNotThere) {
  EXPECT_EQ(run(program_export, "out x.vtu --frame 4"), 2);
  EXPECT_NE(output_.find("out: frame 4: must be in [0, 4)"), std::string::npos) << output_;
  EXPECT_EQ(run(program_export, "nowhere x.vtu"), 4);
  EXPECT_EQ(run(program_export, "out"), 2);
  EXPECT_EQ(run(program_export, "out x.stl"), 2);
}

}  // namespace
}  // namespace vesica
