#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "temporary_folder.hpp"
#include "vesica/core/error.hpp"
#include "vesica/shapes/shapes.hpp"
#include "vesica/shapes/surface_file.hpp"

namespace vesica::shapes {
namespace {

namespace fs = std::filesystem;

/// Writes one surface, an ellipsoid with a field c at its vertices, in many formats: what meshio
/// has, and by hand what it has not. Vertices are numbers of 32 bits, for STL, and stand in the
/// order in which the triangles use them.
constexpr const char* script = R"(
import base64, struct, meshio, numpy as np

v = np.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], float)
f = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
v = list(v)
for _ in range(2):
    middle, finer = {}, []
    for t in f:
        m = []
        for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0])):
            e = (min(a, b), max(a, b))
            if e not in middle:
                p = v[a] + v[b]
                middle[e] = len(v)
                v.append(p / np.linalg.norm(p))
            m.append(middle[e])
        finer += [(t[0], m[0], m[2]), (t[1], m[1], m[0]), (t[2], m[2], m[1]), tuple(m)]
    f = finer
f = np.array(f)
order = list(dict.fromkeys(f.ravel()))
number = np.empty(len(order), int)
number[order] = np.arange(len(order))
x = (np.array(v)[order] * [1.3, 1, 0.9]).astype(np.float32).astype(float)
f = number[f]
c = np.where(x[:, 0] > 0.3, 1.0, -0.5)
mesh = meshio.Mesh(x, [("triangle", f)], point_data={"c": c})
bare = meshio.Mesh(x, [("triangle", f)])

mesh.write("a.off"); mesh.write("a.obj")
for binary in False, True:
    kind = "binary" if binary else "text"
    mesh.write(f"{kind}.ply", binary=binary)
    meshio.write(f"{kind}.stl", bare, binary=binary)
    meshio.write(f"{kind}42.vtk", mesh, file_format="vtk42", binary=binary)
    meshio.write(f"{kind}51.vtk", mesh, file_format="vtk51", binary=binary)
    meshio.write(f"{kind}22.msh", mesh, file_format="gmsh22", binary=binary)
    meshio.write(f"{kind}41.msh", mesh, file_format="gmsh", binary=binary)
meshio.write("text.vtu", mesh, binary=False)
meshio.write("zlib.vtu", mesh, binary=True, compression="zlib")
meshio.write("plain.vtu", mesh, binary=True, compression=None)

with open("big.ply", "wb") as file:
    file.write(b"ply\nformat binary_big_endian 1.0\nelement vertex %d\nproperty double x\n"
               b"property double y\nproperty double z\nproperty float c\nelement face %d\n"
               b"property uchar flags\nproperty list uchar int vertex_indices\nend_header\n"
               % (len(x), len(f)))
    for p, value in zip(x, c):
        file.write(struct.pack(">dddf", *p, value))
    for t in f:
        file.write(struct.pack(">BBiii", 7, 3, *t))

def vtk_xml(name, kind, arrays, raw):
    """An appended file: raw with headers of 64 bits, base64 with 32."""
    data, offsets = b"", []
    for a in arrays:
        offsets.append(len(data))
        b = struct.pack("<Q" if raw else "<I", a.nbytes) + a.tobytes()
        data += b if raw else base64.b64encode(b)
    points, connectivity, offset, types, field = offsets
    cells = "Cells" if kind == "UnstructuredGrid" else "Polys"
    count = "NumberOfCells" if kind == "UnstructuredGrid" else "NumberOfPolys"
    typed = f'<DataArray type="UInt8" Name="types" format="appended" offset="{types}"/>'
    with open(name, "wb") as file:
        file.write(f'''<?xml version="1.0"?>
<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian"
         header_type="{'UInt64' if raw else 'UInt32'}">
  <{kind}><Piece NumberOfPoints="{len(x)}" {count}="{len(f)}">
    <PointData><DataArray type="Float64" Name="c" format="appended" offset="{field}"/></PointData>
    <Points>
      <DataArray type="Float64" NumberOfComponents="3" format="appended" offset="{points}"/>
    </Points>
    <{cells}>
      <DataArray type="Int64" Name="connectivity" format="appended" offset="{connectivity}"/>
      <DataArray type="Int64" Name="offsets" format="appended" offset="{offset}"/>
      {typed if kind == "UnstructuredGrid" else ""}
    </{cells}>
  </Piece></{kind}>
  <AppendedData encoding="{'raw' if raw else 'base64'}">_'''.encode())
        file.write(data + b"\n  </AppendedData>\n</VTKFile>\n")

arrays = [x, f.astype(np.int64), 3 * np.arange(1, len(f) + 1), np.full(len(f), 5, np.uint8), c]
vtk_xml("raw.vtu", "UnstructuredGrid", arrays, True)
vtk_xml("base64.vtu", "UnstructuredGrid", arrays, False)
vtk_xml("raw.vtp", "PolyData", arrays, True)

with open("polygons.vtk", "w") as file:
    file.write("# vtk DataFile Version 3.0\nsurface\nASCII\nDATASET POLYDATA\n")
    file.write(f"POINTS {len(x)} double\n")
    file.write("\n".join("%.17g %.17g %.17g" % tuple(p) for p in x))
    file.write(f"\nPOLYGONS {len(f)} {4 * len(f)}\n")
    file.write("\n".join("3 %d %d %d" % tuple(t) for t in f))
    file.write(f"\nPOINT_DATA {len(x)}\nSCALARS c double 1\nLOOKUP_TABLE default\n")
    file.write("\n".join("%.17g" % value for value in c) + "\n")
vertices = "\n".join("%d %.17g %.17g %.17g 0" % (i, *p) for i, p in enumerate(x))
triangles = "\n".join("%d %d %d %d" % (i, *t) for i, t in enumerate(f))
with open("a.tsi", "w") as file:
    file.write(f"version 1.1\nbox 9 9 9\nvertex {len(x)}\n{vertices}\n"
               f"triangle {len(f)}\n{triangles}\ninclusion 1\n0 2 5 0 1\n")
with open("a.q", "w") as file:
    file.write(f"9 9 9\n{len(x)}\n{vertices}\n{len(f)}\n{triangles}\n")
)";

/// The files that the script writes, once for all tests here.
class SurfaceRoundTrip : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = std::make_unique<test::TemporaryFolder>();
    std::ofstream(folder()->path() / "write.py") << script;
    const std::string command =
        "cd '" + folder()->path().string() + "' && /usr/bin/python3 write.py";
    ASSERT_EQ(std::system(command.c_str()), 0) << "python3-meshio is needed";
  }
  static void TearDownTestSuite() { folder().reset(); }
  static std::unique_ptr<test::TemporaryFolder>& folder() {
    static std::unique_ptr<test::TemporaryFolder> folder;
    return folder;
  }
  static std::vector<fs::path> files() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder()->path())) {
      if (entry.path().extension() != ".py") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
  }
};

TEST_F(SurfaceRoundTrip, GivesTheSameNodesInAllFormats) {
  const Shape reference = read_shape((folder()->path() / "big.ply").string());
  ASSERT_EQ(reference.surface.triangulation->num_nodes(), 258);
  EXPECT_EQ(files().size(), 24U);
  for (const fs::path& file : files()) {
    SCOPED_TRACE(file.filename());
    const Shape shape = read_shape(file.string());
    // meshio writes twelve digits to this one
    const double digits = file.filename() == "text.vtu" ? 1e-11 : 0;
    EXPECT_LE((shape.surface.positions - reference.surface.positions).cwiseAbs().maxCoeff(),
              digits);
    EXPECT_TRUE(std::ranges::equal(shape.surface.triangulation->triangles(),
                                   reference.surface.triangulation->triangles()));
  }
}

TEST_F(SurfaceRoundTrip, GivesTheSamePointFieldInAllFormatsThatHaveSome) {
  const Shape reference = read_shape((folder()->path() / "big.ply").string());
  int num_fields = 0;
  for (const fs::path& file : files()) {
    SCOPED_TRACE(file.filename());
    for (const mesh::PointField& field : read_shape(file.string()).fields) {
      if (field.name != "c") continue;
      EXPECT_TRUE(field.values == reference.fields.at(0).values);
      ++num_fields;
    }
  }
  EXPECT_EQ(num_fields, 18);
}

/// Cut short at many places and with bytes changed, a file is read or refused by its path; nothing
/// else happens.
TEST_F(SurfaceRoundTrip, RefusesBrokenFilesByTheirPath) {
  std::map<std::string, int> refusals;
  const auto read = [&](const fs::path& original, const std::string& bytes) {
    const std::string broken = (folder()->path() / ("broken" + original.extension().string()));
    std::ofstream(broken, std::ios::binary) << bytes;
    try {
      (void)read_shape(broken, {.repairs = true});
    } catch (const ConfigError& error) {
      EXPECT_EQ(std::string(error.what()).find(broken + ":"), 0U) << error.what();
      ++refusals[original.filename()];
    } catch (const std::exception& error) {
      ADD_FAILURE() << original << ": " << error.what();
    }
    fs::remove(broken);
  };
  for (const fs::path& file : files()) {
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t i = 0; i < 40; ++i) {
      read(file, bytes.substr(0, bytes.size() * i / 40));
      std::string changed = bytes;
      changed[(bytes.size() - 1) * i / 40] = static_cast<char>(i % 2 == 0 ? '~' : 0xff);
      read(file, changed);
      changed = bytes;
      for (std::size_t k = 0; k < 8 && k + 16 * i < bytes.size(); ++k) changed[16 * i + k] = '9';
      read(file, changed);
    }
    EXPECT_GT(refusals[file.filename()], 40) << file.filename();
  }
}

}  // namespace
}  // namespace vesica::shapes
