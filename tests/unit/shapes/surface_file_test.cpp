#include "vesica/shapes/surface_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "vesica/core/error.hpp"
#include "vesica/mesh/quality.hpp"
#include "vesica/shapes/shapes.hpp"

namespace vesica::shapes {
namespace {

/// Vertices and triangles of the octahedron as OFF and OBJ text.
const std::string off_vertices = "1 0 0\n-1 0 0\n0 1 0\n0 -1 0\n0 0 1\n0 0 -1\n";
const std::string off_faces =
    "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n";
const std::string obj_vertices = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n";

class SurfaceFile : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("vesica-{}-{}", info->name(), ::getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = (folder_ / name).string();
    std::ofstream(path) << text;
    return path;
  }

  std::string write_corners(const std::string& name, const mesh::Surface& surface) const {
    const mesh::Triangulation& triangulation = *surface.triangulation;
    std::string text =
        fmt::format("OFF\n{} {} 0\n", triangulation.num_vertices(), triangulation.num_triangles());
    for (mesh::NodeIndex v = 0; v < triangulation.num_vertices(); ++v) {
      text += fmt::format("{} {} {}\n", surface.positions(v, 0), surface.positions(v, 1),
                          surface.positions(v, 2));
    }
    for (const mesh::QuadraticTriangle& n : triangulation.triangles()) {
      text += fmt::format("3 {} {} {}\n", n[0], n[1], n[2]);
    }
    return write(name, text);
  }

  template <class E>
  void refuses(const std::string& name, const std::string& text, const std::string& message) const {
    const std::string path = write(name, text);
    test::expect_message<E>([&] { (void)read_surface(path, false); }, message);
  }

  std::filesystem::path folder_;
};

void expect_octahedron(const mesh::Surface& surface) {
  EXPECT_EQ(surface.triangulation->num_vertices(), 6);
  EXPECT_EQ(surface.triangulation->num_nodes(), 18);
  EXPECT_EQ(surface.positions.topRows(6), test::octahedron_vertices());
  const auto corners = test::octahedron_triangles();
  for (std::size_t t = 0; t < corners.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(surface.triangulation->triangles()[t][i], corners[t][i]);
    }
  }
}

TEST_F(SurfaceFile, ReadsOffWithCommentsColoursAndWithoutEdgeCount) {
  expect_octahedron(
      read_surface(write("a.off", "OFF\n6 8 12\n" + off_vertices + off_faces), false));
  expect_octahedron(read_surface(
      write("b.OFF", "# made by hand\nOFF 6 8\n\n" + off_vertices + "# faces\r\n" + off_faces),
      false));
  std::string coloured = off_faces;
  coloured.replace(coloured.find('\n'), 1, " 255 0 0 # red\n");
  expect_octahedron(read_surface(write("c.off", "6 8 0\n" + off_vertices + coloured), false));
}

TEST_F(SurfaceFile, ReadsAllFormsOfObjCorners) {
  const std::string text = "mtllib none.mtl\no octahedron\n" + obj_vertices +
                           "vn 0 0 1\nvt 0 0\ng all\ns off\n"
                           "f 1 3 5\nf 3/1 2/1 5/1\nf 2/1/1 4/1/1 5/1/1\nf 4//1 1//1 5//1\n"
                           "f -4 -6 -1 # negative\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
  expect_octahedron(read_surface(write("a.obj", text), false));
}

TEST_F(SurfaceFile, KeepsPositionsAndConnectivityInARoundTrip) {
  ShapeOptions options;
  options.resolution = 4;
  const mesh::Surface surface = make_shape(options);
  ShapeOptions from_file;
  from_file.kind = ShapeKind::file;
  from_file.path = write_corners("capsule.off", surface);
  const mesh::Surface read = make_shape(from_file);
  const auto num_vertices = surface.triangulation->num_vertices();
  EXPECT_EQ(read.positions.topRows(num_vertices), surface.positions.topRows(num_vertices));
  ASSERT_EQ(read.triangulation->num_triangles(), surface.triangulation->num_triangles());
  for (std::size_t t = 0; t < read.triangulation->triangles().size(); ++t) {
    EXPECT_EQ(read.triangulation->triangles()[t], surface.triangulation->triangles()[t]);
  }
}

TEST_F(SurfaceFile, LiftsATriangulatedSphereExactlyOntoTheSphere) {
  for (const auto base : {SphereBase::icosahedron, SphereBase::cube}) {
    ShapeOptions options;
    options.kind = ShapeKind::sphere;
    options.base = base;
    options.resolution = 3;
    const mesh::Surface read =
        read_surface(write_corners("sphere.off", make_shape(options)), false);
    EXPECT_LT((read.positions.rowwise().norm().array() - 1).abs().maxCoeff(), 1e-14);
  }
}

TEST_F(SurfaceFile, LiftsATriangulatedTorusWithThirdOrder) {
  std::vector<double> errors;
  for (const int resolution : {16, 32}) {
    ShapeOptions options;
    options.kind = ShapeKind::torus;
    options.minor_radius = 0.5;
    options.resolution = resolution;
    const mesh::Surface read = read_surface(write_corners("torus.off", make_shape(options)), false);
    double largest = 0;
    for (Eigen::Index node = 0; node < read.positions.rows(); ++node) {
      const Eigen::Vector3d x = read.positions.row(node);
      const double distance = std::hypot(x.head<2>().norm() - 1, x.z()) - 0.5;
      largest = std::max(largest, std::abs(distance));
    }
    errors.push_back(largest);
  }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 2.9) << errors[0] << " " << errors[1];
}

TEST(EdgeMidpoint, IsFourthOrderForExactNormals) {
  // Two points of the ellipsoid with semi-axes 2, 1, 0.7, closer and closer.
  const Eigen::Vector3d axes(2, 1, 0.7);
  const auto point = [&](double u, double v) -> Eigen::Vector3d {
    return axes.cwiseProduct(
        Eigen::Vector3d(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)));
  };
  const auto normal = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d {
    return x.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
  };
  const auto error = [&](double h) {
    const Eigen::Vector3d a = point(0.4, 0.3);
    const Eigen::Vector3d b = point(0.4 + h, 0.3 + 0.6 * h);
    const Eigen::Vector3d middle = edge_midpoint(a, normal(a), b, normal(b));
    return std::abs(middle.cwiseQuotient(axes).norm() - 1);
  };
  EXPECT_GT(error(0.1), 1e-12);
  EXPECT_GT(std::log2(error(0.2) / error(0.1)), 3.7);
}

TEST_F(SurfaceFile, NamesTheLineOfMalformedOff) {
  refuses<ConfigError>("a.off", "COFF\n6 8 12\n", "a.off:1: format COFF: must be OFF");
  refuses<ConfigError>("b.off", "OFF BINARY\n", "b.off:1: format OFF BINARY: must be text");
  refuses<ConfigError>("c.off", "OFF\n6 8\n1 0 0\n1 zero 0\n",
                       "c.off:4: 'zero': must be a finite number");
  refuses<ConfigError>("d.off", "OFF\n6 8\n1 0 0\n",
                       "d.off:3: the file ends after 1 of 6 vertices");
  refuses<ConfigError>("e.off", "OFF\n6 8\n" + off_vertices + "4 0 1 2 3\n",
                       "e.off:9: face with 4 corners: must be a triangle");
  refuses<ConfigError>("f.off", "OFF\n6 8\n" + off_vertices + "3 0 1 6\n",
                       "f.off:9: vertex 6: must be in [0, 6)");
  refuses<ConfigError>("g.off", "OFF\n6 8\n" + off_vertices + off_faces + "3 0 2 4\n",
                       "g.off:17: text after the last face");
  refuses<ConfigError>("h.off", "", "h.off:0: the file is empty");
  refuses<ConfigError>("i.off", "OFF\n6 8\n1 0 nan\n", "i.off:3: 'nan': must be a finite number");
  refuses<ConfigError>("j.off", "OFF\n-6 8\n", "j.off:2: -6 vertices and 8 faces: must be >= 0");
}

TEST_F(SurfaceFile, NamesTheLineOfMalformedObj) {
  refuses<ConfigError>("a.obj", obj_vertices + "f 1 2 3 4\n",
                       "a.obj:7: face with 4 corners: must be a triangle");
  refuses<ConfigError>("b.obj", obj_vertices + "f 1 2 7\n",
                       "b.obj:7: vertex 7: must be one of the 6");
  refuses<ConfigError>("c.obj", obj_vertices + "f 1 2 0\n", "c.obj:7: vertex 0: must be");
  refuses<ConfigError>("d.obj", obj_vertices + "f 1 2 -7\n", "d.obj:7: vertex -7: must be");
  refuses<ConfigError>("e.obj", "v 1 0\n", "e.obj:1: vertex with 2 numbers");
  refuses<ConfigError>("f.obj", "v 1 0 0 2\n", "f.obj:1: vertex with weight 2: must be 1");
  refuses<ConfigError>("g.obj", "curv 1 2\n", "g.obj:1: keyword 'curv': must be v, f");
  refuses<ConfigError>("h.obj", obj_vertices + "f 1 x 2\n", "h.obj:7: 'x': must be an integer");
}

TEST_F(SurfaceFile, RefusesFilesThatCannotBeReadOrHaveAnotherFormat) {
  test::expect_message<IoError>(
      [&] { (void)read_surface((folder_ / "absent.off").string(), false); },
      "absent.off: cannot be opened");
  std::filesystem::create_directory(folder_ / "folder.obj");
  test::expect_message<IoError>(
      [&] { (void)read_surface((folder_ / "folder.obj").string(), false); }, "it is a folder");
  refuses<ConfigError>("a.dae", "",
                       "a.dae: extension '.dae': must be one of .off, .obj, .ply, .stl, .vtk, "
                       ".vtu, .vtp, .msh, .tsi, .q");
}

TEST_F(SurfaceFile, RefusesUnsoundSurfacesByFileAndEdgeOrFace) {
  const std::string open = off_faces.substr(0, off_faces.rfind("3 0"));
  refuses<ConfigError>("open.off", "OFF\n6 7\n" + off_vertices + open,
                       "open.off: triangulation: edge (0, 3) belongs to 1 triangle");
  refuses<ConfigError>("unused.off", "OFF\n7 8\n" + off_vertices + "5 5 5\n" + off_faces,
                       "unused.off: triangulation: node 6 is in no triangle");
  std::string flat = off_vertices;
  flat.replace(flat.find("0 1 0"), 5, "1 0 0");
  refuses<ConfigError>("flat.off", "OFF\n6 8\n" + flat + off_faces,
                       "triangle 0 (nodes 0, 2, 4) is degenerate");
}

TEST_F(SurfaceFile, FlipsAnInsideOutSurfaceOnlyWhenAsked) {
  std::string mirrored = off_vertices;  // z -> -z turns the octahedron inside out
  mirrored.replace(mirrored.find("0 0 1"), 5, "0 0 -1");
  mirrored.replace(mirrored.rfind("0 0 -1"), 6, "0 0 1");
  const std::string text = "OFF\n6 8\n" + mirrored + off_faces;
  refuses<ConfigError>("a.off", text, "inside out");
  const mesh::Surface flipped = read_surface(write("b.off", text), true);
  EXPECT_GT(mesh::enclosed_volume(*flipped.triangulation, flipped.positions), 4.0 / 3);
}

}  // namespace
}  // namespace vesica::shapes
