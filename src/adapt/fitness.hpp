#pragma once

#include <Eigen/Core>

#include "vesica/mesh/surface_locator.hpp"

namespace vesica::adapt {

/// A vertex of the new mesh on the old surface.
struct SurfaceVertex {
  mesh::SurfaceLocation place;
  Eigen::Vector3d normal;  ///< of the old surface
  double size = 0;         ///< wanted length of edges [length]
};

/// Lowest values over the triangles of a patch.
struct Fitness {
  double quality = 1;      ///< sine of an angle
  double uprightness = 1;  ///< cosine between the flat normal and the surface's at a corner

  void include(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c);

  /// No triangle is worse than the worst of `before`, but quality may fall to `enough`, and flat
  /// triangles may turn to 60 degrees from the surface.
  [[nodiscard]] bool is_as_good_as(const Fitness& before, double enough) const;
};

}  // namespace vesica::adapt
