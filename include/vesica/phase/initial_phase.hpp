#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/mesh/point_field.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::phase {

/// Kind of the initial order parameter; PhaseOptions::fields describes each.
enum class PhaseKind { uniform, ramp, caps, bands, spots, noise, file };
/// Coordinate of ramp, caps and bands; radial: distance from the line along z through the centroid.
enum class Axis { x, y, z, radial };
/// Ends of the axis at which phase 1 lies.
enum class CapEnds { high, low, both };
/// Direction in which bands follow each other.
enum class BandDirection { along, around };

}  // namespace vesica::phase

namespace vesica {
template <>
struct EnumNames<phase::PhaseKind> {
  using enum phase::PhaseKind;
  static constexpr std::array<std::pair<phase::PhaseKind, std::string_view>, 7> names{
      {{uniform, "uniform"},
       {ramp, "ramp"},
       {caps, "caps"},
       {bands, "bands"},
       {spots, "spots"},
       {noise, "noise"},
       {file, "file"}}};
};
template <>
struct EnumNames<phase::Axis> {
  using enum phase::Axis;
  static constexpr std::array<std::pair<phase::Axis, std::string_view>, 4> names{
      {{x, "x"}, {y, "y"}, {z, "z"}, {radial, "radial"}}};
};
template <>
struct EnumNames<phase::CapEnds> {
  using enum phase::CapEnds;
  static constexpr std::array<std::pair<phase::CapEnds, std::string_view>, 3> names{
      {{high, "high"}, {low, "low"}, {both, "both"}}};
};
template <>
struct EnumNames<phase::BandDirection> {
  using enum phase::BandDirection;
  static constexpr std::array<std::pair<phase::BandDirection, std::string_view>, 2> names{
      {{along, "along"}, {around, "around"}}};
};
}  // namespace vesica

namespace vesica::phase {

/// Options of the initial order parameter, which is chosen by name. Interfaces of caps, bands and
/// spots have the equilibrium profile tanh(s / epsilon).
struct PhaseOptions {
  PhaseKind kind = PhaseKind::ramp;
  Axis axis = Axis::x;
  double from = 0.25;
  double to = 2.25;
  CapEnds ends = CapEnds::high;
  double fraction = 0.5;
  int count = 4;
  BandDirection direction = BandDirection::along;
  std::vector<Eigen::Vector3d> directions;
  double angle = 30;
  double mean = 0;
  double amplitude = 0.1;
  int seed = 1;
  std::string path;
  std::string field;
  bool match_target = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    using enum PhaseKind;
    visit(Field{"kind", "-", "ramp (4.1), caps, bands, spots, noise, uniform or file"}, self.kind);
    visit(
        Field{"axis", "-",
              "coordinate: x, y, z or radial (distance from the line along z through the centroid)",
              Rule::any, Users(ramp, caps, bands)},
        self.axis);
    visit(Field{"from", "length", "coordinate where c = -1", Rule::any, Users(ramp)}, self.from);
    visit(Field{"to", "length", "coordinate where c = +1", Rule::any, Users(ramp)}, self.to);
    visit(Field{"ends", "-", "phase 1 at the high, the low or both ends of the axis", Rule::any,
                Users(caps)},
          self.ends);
    visit(Field{"fraction", "-", "part of the extent (of a period) in phase 1", Rule::fraction,
                Users(caps, bands)},
          self.fraction);
    visit(Field{"count", "-", "number of domains of phase 1", Rule::at_least_one, Users(bands)},
          self.count);
    visit(Field{"direction", "-", "along the axis or around it (tori; x, y or z)", Rule::any,
                Users(bands)},
          self.direction);
    visit(Field{"directions", "-", "list of directions [[x, y, z], ...] from the centre", Rule::any,
                Users(spots)},
          self.directions);
    visit(Field{"angle", "degree", "half opening angle", Rule::positive, Users(spots)}, self.angle);
    visit(Field{"mean", "-", "mean of c", Rule::any, Users(noise, uniform)}, self.mean);
    visit(Field{"amplitude", "-", "c = mean + amplitude * uniform(-1, 1) at each node",
                Rule::non_negative, Users(noise)},
          self.amplitude);
    visit(Field{"seed", "-", "seed of the random numbers", Rule::any, Users(noise)}, self.seed);
    visit(Field{"path", "-",
                "one value a vertex, or one a node (vertices and edges), in that order; # starts a "
                "comment; relative to the case file",
                Rule::any, Users(file)},
          self.path);
    visit(Field{"field", "-",
                "in place of path: name of the point field with the values in the shape's file",
                Rule::any, Users(file)},
          self.field);
    visit(Field{"match_target", "-",
                "shift the level so that int h(c) meets its target at the start"},
          self.match_target);
  }
  /// Throws ConfigError when a file and a point field are given.
  void check_together() const;
};

/// An order parameter at the nodes, shape (N), and what had to be decided about it, one sentence
/// each.
struct PhaseStart {
  Eigen::VectorXd order_parameter;
  std::vector<std::string> notes;
};

/// Computes the initial order parameter as initial_phase does. `fields` are the point fields of the
/// shape's file, for `field`. The notes tell how labels were mapped.
[[nodiscard]] PhaseStart start_phase(const PhaseOptions& options, const mesh::Surface& surface,
                                     double interface_width, std::optional<double> target,
                                     std::span<const mesh::PointField> fields);

/// Computes the initial order parameter at the nodes, shape (N). With a `target` [length^2] and
/// `match_target`, the level is shifted so that int h(c) = target to round-off. Throws ConfigError
/// when no shift reaches the target, IoError for an unreadable file.
///
/// Values of a file are taken as they stand; they must be in [-1, 1], with an overshoot of 0.05.
/// Labels, that is values that are all 0 or 1, or all 1 or 2, and not all the same, are mapped: 1
/// is phase 1 (c = 1), the other one phase 2 (c = -1). With one value a vertex, the middle of an
/// edge gets the mean of its ends. Vertices are counted in the order of their nodes, which for a
/// shape from a file is that of the file.
[[nodiscard]] Eigen::VectorXd initial_phase(const PhaseOptions& options,
                                            const mesh::Surface& surface, double interface_width,
                                            std::optional<double> target);

}  // namespace vesica::phase
