#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "expect_message.hpp"
#include "sample_surfaces.hpp"
#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/surface_file.hpp"

namespace vesica::shapes {
namespace {

/// The tetrahedron 0, e_x, e_y, e_z: points, triangles.
const std::string points = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const std::string triangles = "0 2 1\n0 1 3\n1 2 3\n0 3 2\n";

/// Each line of `lines` behind `prefix`.
std::string with_prefix(const std::string& prefix, const std::string& lines) {
  std::string text;
  for (std::size_t begin = 0; begin < lines.size();) {
    const std::size_t end = lines.find('\n', begin) + 1;
    text += prefix + lines.substr(begin, end - begin);
    begin = end;
  }
  return text;
}

std::string with_numbers(const std::string& lines, int first) {
  std::string text;
  for (std::size_t begin = 0; begin < lines.size(); ++first) {
    const std::size_t end = lines.find('\n', begin) + 1;
    text += std::to_string(first) + " " + lines.substr(begin, end - begin);
    begin = end;
  }
  return text;
}

class SurfaceFormat : public testing::Test {
 protected:
  [[nodiscard]] std::string write(const std::string& name, const std::string& bytes) const {
    const std::string path = (temporary_.path() / name).string();
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  /// `message` follows the path.
  void refuses(const std::string& name, const std::string& bytes,
               const std::string& message) const {
    const std::string path = write(name, bytes);
    test::expect_message<ConfigError>([&] { (void)read_shape(path); }, path + message);
  }
  [[nodiscard]] Shape read(const std::string& name, const std::string& bytes) const {
    return read_shape(write(name, bytes));
  }

  test::TemporaryFolder temporary_;
};

const std::string ply_header =
    "ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\n";
const std::string ply_faces = "element face 4\nproperty list uchar int vertex_index\nend_header\n";

TEST_F(SurfaceFormat, PlyNamesLineObjectAndRule) {
  EXPECT_EQ(read("a.ply", ply_header + ply_faces + points + with_prefix("3 ", triangles))
                .surface.triangulation->num_nodes(),
            10);
  refuses("b.ply", "plx\n", ":1: header: the first line must be 'ply'");
  refuses("c.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty real x\n",
          ":4: header: type 'real': must be a number type of PLY");
  refuses("d.ply", ply_header + ply_faces + "0 0 0\n1 x 0\n",
          ":12: vertex 2 of 4: 'x': must be a number");
  refuses("e.ply", ply_header + ply_faces + points + "4 0 1 2 3\n",
          ":15: face 1 of 4: 4 corners: must be a triangle");
  refuses("f.ply", ply_header + ply_faces + points + "3 0 1 4\n",
          ":15: face 1 of 4: point 4: must be one of the 4 points, counted from 0");
  refuses("g.ply", ply_header + ply_faces + points + "3 0 2 1\n",
          ":16: face 2 of 4: the file ends here");
  refuses("h.ply", "ply\nformat ascii 1.0\nelement vertex 4000\nend_header\n",
          ":3: header: 4000 of element vertex: is more than a file of 52 bytes can hold");
  std::string binary = ply_header + ply_faces;
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  refuses("i.ply", binary + std::string(15, '\0'),
          ": byte 195: vertex 2 of 4: the file ends here, at 198 bytes");
}

TEST_F(SurfaceFormat, StlNamesLineObjectAndRule) {
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  refuses("a.stl", "solid s\n" + facet + "vertex 0 nan 0\n",
          ":6: facet 1: coordinate nan: must be finite");
  refuses("b.stl", "solid s\n" + facet + "vertex 0 1 0\nendfacet\n",
          ":7: facet 1: 'endfacet': must be 'endloop'");
  refuses("c.stl", "solid s\nendsolid s\n", ":1: no facets: must be a text or binary STL file");
  std::string binary(84 + 50, '\0');
  binary[80] = 2;
  refuses("d.stl", binary, ": byte 84: 2 facets: the file must have 184 bytes, but has 134");
}

TEST_F(SurfaceFormat, LegacyVtkNamesLineObjectAndRule) {
  const std::string header =
      "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n";
  const std::string cells = "CELLS 4 16\n" + with_prefix("3 ", triangles);
  EXPECT_EQ(read("a.vtk", header + points + cells + "CELL_TYPES 4\n5 5 5 5\n")
                .surface.triangulation->num_nodes(),
            10);
  refuses("b.vtk", "# VTK\n", ":1: header: the first line must be '# vtk DataFile Version '");
  refuses("c.vtk", header + points + cells + "CELL_TYPES 4\n5 5 9 5\n",
          ":16: cells: cell 2 of type 9 with 3 points: must be a triangle (5)");
  refuses("d.vtk", header + points + "CELLS 4 15\n" + with_prefix("3 ", triangles),
          ":14: CELLS: a cell of 3 points: must fit the 15 numbers");
  refuses("e.vtk", header + "0 0 0 1 0 zero\n", ":6: point 2 of 4: 'zero': must be a number");
  refuses("f.vtk",
          header + points + cells +
              "CELL_TYPES 4\n5 5 5 5\nPOINT_DATA 3\n"
              "SCALARS c float 1\nLOOKUP_TABLE default\n1 2 3\n",
          ":20: array 'c': 3 values: must be one for each of the 4 points");
}

/// `cells` in a grid of the four points.
std::string vtu(const std::string& connectivity, const std::string& offsets,
                const std::string& types, const std::string& more = "") {
  return "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"" + more +
         ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"4\" NumberOfCells=\"4\">\n<Points>\n"
         "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
         points +
         "</DataArray>\n</Points>\n<Cells>\n<DataArray type=\"Int32\" "
         "Name=\"connectivity\">" +
         connectivity + "</DataArray>\n<DataArray type=\"Int32\" Name=\"offsets\">" + offsets +
         "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\">" + types +
         "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

TEST_F(SurfaceFormat, VtkXmlNamesLineObjectAndRule) {
  EXPECT_EQ(read("a.vtu", vtu(triangles, "3 6 9 12", "5 5 5 5")).surface.triangulation->num_nodes(),
            10);
  refuses("b.vtu", "<VTKFile", ":1: XML: ");
  refuses("c.vtu", vtu(triangles, "3 6 9 13", "5 5 5 5"),
          ":11: Cells: cell 3: points 9 to 13: must be among the 12 of the connectivity");
  refuses("d.vtu", vtu(triangles, "3 6 9 12", "5 5 5 10"),
          ":11: Cells: cell 3 of type 10 with 3 points: must be a triangle (5)");
  refuses("e.vtu", vtu("0 1 x", "3", "5"),
          ":12: DataArray 'connectivity': value number 3: 'x': must be a number");
  refuses("f.vtu", vtu("", "", "", " compressor=\"vtkLZ4DataCompressor\""),
          ":1: VTKFile: compressor 'vtkLZ4DataCompressor': must be vtkZLibDataCompressor or none");
  std::string binary = vtu(triangles, "3 6 9 12", "5 5 5 5");
  const std::string name = "Name=\"offsets\">3 6 9 12";
  binary.replace(binary.find(name), name.size(),
                 "Name=\"offsets\" format=\"binary\">EAAAAAMAAAAGAAAA");
  refuses("g.vtu", binary, ":17: DataArray 'offsets': ends after 12 bytes: must have 20");
}

TEST_F(SurfaceFormat, GmshNamesLineObjectAndRule) {
  const std::string format = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  const std::string nodes = "$Nodes\n4\n" + with_numbers(points, 11) + "$EndNodes\n";
  // a point, then the triangles
  const std::string elements =
      "$Elements\n5\n1 15 2 0 1 11\n2 2 2 0 1 11 13 12\n3 2 2 0 1 11 12 14\n4 2 2 0 1 12 13 14\n"
      "5 2 2 0 1 11 14 13\n$EndElements\n";
  EXPECT_EQ(read("a.msh", format + nodes + elements).surface.triangulation->num_nodes(), 10);
  refuses("b.msh", "$MeshFormat\n4.0 0 8\n", ":2: $MeshFormat: version 4.0: must be 2.2 or 4.1");
  refuses("c.msh", nodes, ":1: $Nodes: must come after $MeshFormat");
  refuses("d.msh", format + nodes + "$Elements\n1\n1 4 2 0 1 11 12 13 14\n",
          ":13: element 1 of 1: type 4: must be a triangle (2) or a quadratic triangle (9)");
  refuses("e.msh", format + nodes + "$Elements\n1\n1 2 2 0 1 11 12 15\n",
          ":13: element 1 of 1: node 15: must be one of $Nodes");
  refuses("f.msh", format + nodes + "$Elements\n1\n1 15 2 0 1 11\n$EndElements\n",
          ":14: $Elements: no element is a triangle");
}

TEST_F(SurfaceFormat, MembraneFilesNameLineObjectAndRule) {
  const std::string vertices = "vertex 4\n" + with_numbers(points, 0);
  const std::string faces = "triangle 4\n" + with_numbers(triangles, 0);
  const Shape shape =
      read("a.tsi", "version 1.1\nbox 9 9 9\n" + vertices + faces + "inclusion 1\n0 2 3 0 1\n");
  ASSERT_EQ(shape.fields.size(), 2U);
  EXPECT_EQ(shape.fields[1].name, "inclusion");
  EXPECT_EQ(shape.fields[1].values, Eigen::Vector4d(0, 0, 0, 2));
  refuses("b.tsi", vertices + "triangles 4\n", ":6: keyword 'triangles': must be version, box");
  refuses("c.tsi", vertices + "triangle 1\n0 0 1 4\n", ":7: vertex 4: must be in [0, 4)");
  refuses("d.tsi", vertices, ":5: the file ends without triangles");
  refuses("e.q", "9 9 9\n4\n" + with_numbers(points, 0) + "5\n" + with_numbers(triangles, 0),
          ":11: the file ends after 4 of 5 triangles");
  refuses("f.q", "9 9\n", ":1: 2 words: must be the three sizes of the box");
}

/// Octahedron with quadratic triangles: point 0 in the middle of side (1, 3), the last in no order.
TEST_F(SurfaceFormat, QuadraticTrianglesAreTakenAsTheyStandWithCornersFirst) {
  const mesh::Surface flat = test::octahedron();
  std::string positions;
  std::string cells;
  const auto num_nodes = flat.triangulation->num_nodes();
  for (mesh::NodeIndex i = num_nodes; i-- > 0;) {  // backwards: mid-edge nodes come first
    const Eigen::Vector3d x = 1.25 * flat.positions.row(i).transpose();
    positions += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  }
  std::string offsets;
  std::string types;
  int end = 0;
  for (const mesh::QuadraticTriangle& nodes : flat.triangulation->triangles()) {
    for (const mesh::NodeIndex node : nodes) cells += fmt::format("{} ", num_nodes - 1 - node);
    offsets += fmt::format("{} ", end += 6);
    types += "22 ";
  }
  std::string text = vtu(cells, offsets, types);
  text.replace(text.find(points), points.size(), positions);
  text.replace(text.find("NumberOfPoints=\"4\""), 18, "NumberOfPoints=\"18\"");
  const Shape shape = read("a.vtu", text);
  ASSERT_EQ(shape.surface.positions.rows(), 18);
  for (int i = 0; i < 6; ++i)
    EXPECT_EQ(shape.surface.positions.row(i), 1.25 * flat.positions.row(5 - i)) << i;
  for (int i = 6; i < 18; ++i)
    EXPECT_EQ(shape.surface.positions.row(i), 1.25 * flat.positions.row(23 - i)) << i;
  text.replace(text.rfind("22 "), 3, "5 ");
  refuses("b.vtu", text, ":25: Cells: cell 7 of type 5 with 6 points: must be a triangle (5)");
}

}  // namespace
}  // namespace vesica::shapes
