#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vesica/core/fields.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::phase {

enum class PhaseKind { uniform, ramp, caps, bands, spots, noise, file };
/// Coordinate of ramp, caps and bands; radial: distance from the line along z through the centroid.
enum class Axis { x, y, z, radial };
enum class CapEnds { high, low, both };
enum class BandDirection { along, around };

/// Initial order parameter by name. Interfaces of caps, bands and spots have the equilibrium
/// profile tanh(s / epsilon).
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
  bool match_target = true;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"kind", "-", "ramp (4.1), caps, bands, spots, noise, uniform or file"}, self.kind);
    visit(Field{"axis", "-",
                "x, y, z or radial (distance from the line along z through the centroid): "
                "coordinate of ramp, caps and bands"},
          self.axis);
    visit(Field{"from", "length", "ramp: coordinate where c = -1"}, self.from);
    visit(Field{"to", "length", "ramp: coordinate where c = +1"}, self.to);
    visit(Field{"ends", "-", "caps: phase 1 at the high, the low or both ends of the axis"},
          self.ends);
    visit(Field{"fraction", "-", "caps, bands: part of the extent (of a period) in phase 1",
                Rule::fraction},
          self.fraction);
    visit(Field{"count", "-", "bands: number of domains of phase 1", Rule::at_least_one},
          self.count);
    visit(Field{"direction", "-", "bands: along the axis or around it (tori; x, y or z)"},
          self.direction);
    visit(Field{"directions", "-", "spots: list of directions [[x, y, z], ...] from the centre"},
          self.directions);
    visit(Field{"angle", "degree", "spots: half opening angle", Rule::positive}, self.angle);
    visit(Field{"mean", "-", "noise, uniform: mean of c"}, self.mean);
    visit(Field{"amplitude", "-", "noise: c = mean + amplitude * uniform(-1, 1) at each node",
                Rule::non_negative},
          self.amplitude);
    visit(Field{"seed", "-", "noise: seed of the random numbers"}, self.seed);
    visit(Field{"path", "-", "file: one value a node, in node order; # starts a comment"},
          self.path);
    visit(Field{"match_target", "-",
                "shift the level so that int h(c) meets its target at the start"},
          self.match_target);
  }
};

/// Order parameter at the nodes, shape (N). With a `target` [length^2] and `match_target`, the
/// level is shifted so that int h(c) = target to round-off. Throws ConfigError when no shift
/// reaches the target, IoError for an unreadable file.
[[nodiscard]] Eigen::VectorXd initial_phase(const PhaseOptions& options,
                                            const mesh::Surface& surface, double interface_width,
                                            std::optional<double> target);

}  // namespace vesica::phase

namespace vesica {
template <>
struct EnumNames<phase::PhaseKind> {
  static constexpr std::array<std::pair<phase::PhaseKind, std::string_view>, 7> names{
      {{phase::PhaseKind::uniform, "uniform"},
       {phase::PhaseKind::ramp, "ramp"},
       {phase::PhaseKind::caps, "caps"},
       {phase::PhaseKind::bands, "bands"},
       {phase::PhaseKind::spots, "spots"},
       {phase::PhaseKind::noise, "noise"},
       {phase::PhaseKind::file, "file"}}};
};
template <>
struct EnumNames<phase::Axis> {
  static constexpr std::array<std::pair<phase::Axis, std::string_view>, 4> names{
      {{phase::Axis::x, "x"},
       {phase::Axis::y, "y"},
       {phase::Axis::z, "z"},
       {phase::Axis::radial, "radial"}}};
};
template <>
struct EnumNames<phase::CapEnds> {
  static constexpr std::array<std::pair<phase::CapEnds, std::string_view>, 3> names{
      {{phase::CapEnds::high, "high"},
       {phase::CapEnds::low, "low"},
       {phase::CapEnds::both, "both"}}};
};
template <>
struct EnumNames<phase::BandDirection> {
  static constexpr std::array<std::pair<phase::BandDirection, std::string_view>, 2> names{
      {{phase::BandDirection::along, "along"}, {phase::BandDirection::around, "around"}}};
};
}  // namespace vesica
