#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/mesh/point_field.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::shapes {

/// Kind of a starting shape; make_shape describes each.
enum class ShapeKind {
  capsule,
  sphere,
  ellipsoid,
  torus,
  peanut,
  discocyte,
  stomatocyte,
  tips,
  file
};

/// Polyhedron that the sphere's triangulation is made from.
enum class SphereBase { cube, icosahedron };

}  // namespace vesica::shapes

namespace vesica {

template <>
struct EnumNames<shapes::ShapeKind> {
  using enum shapes::ShapeKind;
  static constexpr std::array<std::pair<shapes::ShapeKind, std::string_view>, 9> names = {
      {{capsule, "capsule"},
       {sphere, "sphere"},
       {ellipsoid, "ellipsoid"},
       {torus, "torus"},
       {peanut, "peanut"},
       {discocyte, "discocyte"},
       {stomatocyte, "stomatocyte"},
       {tips, "tips"},
       {file, "file"}}};
};

template <>
struct EnumNames<shapes::SphereBase> {
  using enum shapes::SphereBase;
  static constexpr std::array<std::pair<shapes::SphereBase, std::string_view>, 2> names = {
      {{cube, "cube"}, {icosahedron, "icosahedron"}}};
};

}  // namespace vesica

namespace vesica::shapes {

/// Options of a starting shape. Each kind reads its own keys; the others are ignored.
struct ShapeOptions {
  ShapeKind kind = ShapeKind::capsule;
  int resolution = 6;
  double length = 4.0;
  double diameter = 1.0;
  double waist = 0.5;
  SphereBase base = SphereBase::icosahedron;
  double radius = 1.0;
  double reduced_volume = 0.6;
  Eigen::Vector3d semi_axes{2.0, 1.0, 1.0};
  double major_radius = 1.0;
  double minor_radius = 0.15;
  int number_of_tips = 3;
  double tip_height = 0.5;
  double tip_width = 0.5;
  std::string path;
  bool flip = false;
  bool repair = false;
  int smoothing = 0;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum ShapeKind;
    visit(Field{"kind", "-",
                "capsule, sphere, ellipsoid, torus, peanut, discocyte, stomatocyte, tips, file"},
          self.kind);
    visit(
        Field{"resolution", "-",
              "squares along an edge of a glued cube face of a capsule or peanut (capsule of "
              "length 4: N = 72 m^2 + 2), elements around the tube of a torus, otherwise pieces "
              "of an icosahedron edge (N = 40 m^2 + 2) or bisections of the cube (N = 24 2^m + 2)",
              Rule::at_least_one,
              Users(capsule, peanut, torus, sphere, ellipsoid, discocyte, stomatocyte, tips)},
        self.resolution);
    visit(Field{"length", "length", "total length along x", Rule::positive, Users(capsule, peanut)},
          self.length);
    visit(Field{"diameter", "length", "largest diameter", Rule::positive, Users(capsule, peanut)},
          self.diameter);
    visit(Field{"waist", "length", "diameter in the middle, below diameter", Rule::positive,
                Users(peanut)},
          self.waist);
    visit(Field{"base", "-", "made from a cube or icosahedron", Rule::any,
                Users(sphere, ellipsoid, discocyte, stomatocyte, tips)},
          self.base);
    visit(Field{"radius", "length",
                "radius; of a discocyte or stomatocyte that of the sphere with the same area",
                Rule::positive, Users(sphere, discocyte, stomatocyte, tips)},
          self.radius);
    visit(Field{"semi_axes", "length", "semi-axes along x, y, z", Rule::positive, Users(ellipsoid)},
          self.semi_axes);
    other_fields(self, visit);
  }
  /// Throws ConfigError for values that make no shape together, and shapes of more than 20 million
  /// nodes.
  void check_together() const;

 private:
  template <class Self, class Visitor>
  static void other_fields(Self& self, Visitor&& visit) {
    using enum ShapeKind;
    visit(Field{"reduced_volume", "-",
                "volume over that of the sphere with the same area: 0.58 to 1 of a discocyte, 0.2 "
                "to 0.72 of a stomatocyte",
                Rule::fraction, Users(discocyte, stomatocyte)},
          self.reduced_volume);
    visit(Field{"major_radius", "length", "from the centre to the middle of the tube",
                Rule::positive, Users(torus)},
          self.major_radius);
    visit(Field{"minor_radius", "length", "of the tube, below major_radius", Rule::positive,
                Users(torus)},
          self.minor_radius);
    visit(Field{"number_of_tips", "-",
                "1 pole, 2 poles, 3 triangle, 4 tetrahedron, 6 octahedron, 12 icosahedron; others "
                "evenly spread",
                Rule::between(1, 60), Users(tips)},
          self.number_of_tips);
    visit(Field{"tip_height", "length", "height above the sphere", Rule::non_negative, Users(tips)},
          self.tip_height);
    visit(Field{"tip_width", "rad", "angular width of a tip", Rule::positive, Users(tips)},
          self.tip_width);
    visit(Field{"path", "-",
                "closed triangulated surface: .off, .obj, .ply, .stl, .vtk, .vtu, .vtp, .msh, .tsi "
                "or .q; relative to the case file",
                Rule::any, Users(file)},
          self.path);
    visit(Field{"flip", "-", "turn a surface that is inside out", Rule::any, Users(file)},
          self.flip);
    visit(Field{"repair", "-",
                "turn triangles outwards, merge vertices at one place, drop unused ones, keep the "
                "largest part; warnings tell what was done",
                Rule::any, Users(file)},
          self.repair);
    visit(Field{"smoothing", "-",
                "passes that smooth flat triangles (Taubin 1995) before their edges are bent, for "
                "surfaces from segmentation",
                Rule::between(0, 1000), Users(file)},
          self.smoothing);
  }
};

/// A starting shape: the surface, and what its file says besides.
struct Shape {
  mesh::Surface surface;
  std::vector<mesh::PointField> fields;  ///< of the file; otherwise empty
  std::vector<std::string> notes;        ///< what had to be decided, one sentence each
};

/// Builds a starting shape as make_shape does, with the point fields of its file.
[[nodiscard]] Shape start_shape(const ShapeOptions& options);

/// Builds a starting shape with outward orientation; all nodes, mid-edge nodes included, lie on:
///
///   capsule    the cylinder of the given diameter with hemispherical caps; x in [0, length], axis
///              through y = z = diameter / 2; made of n = round(length / diameter) glued unit cubes
///              with m x m squares a face: 4 (4 n + 2) m^2 + 2 nodes
///   sphere     |x| = radius
///   ellipsoid  (x / a)^2 + (y / b)^2 + (z / c)^2 = 1
///   torus      around z, centred at 0
///   peanut     x = length / 2 (1 - s), rho = sqrt(1 - s^2) (waist / 2 + b s^2), s in [-1, 1], with
///              b such that the largest 2 rho is the diameter; placed and triangulated like the
///              capsule
///   discocyte  rho = sin t, z = cos t (c_0 + c_1 sin^2 t + c_2 sin^4 t), scaled, around z: between
///              the sphere and the red cell of Evans and Fung (1972), and a little beyond
///   stomatocyte   a spherical shell of even thickness around z, open at an angle of 135 degrees
///              from its bottom, with a round rim; thin ones need resolution >= 8
///   tips       |x| = radius + tip_height sum_k exp((cos angle(x, t_k) - 1) / tip_width^2) with the
///              n directions t_k of Section 4.4
///   file       see read_shape
///
/// Throws ConfigError `shape.<key> = <value>: <rule>` for values that make no shape, and what
/// read_shape throws.
[[nodiscard]] mesh::Surface make_shape(const ShapeOptions& options);

}  // namespace vesica::shapes
