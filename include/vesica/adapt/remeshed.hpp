#pragma once

#include <vector>

#include "vesica/mesh/surface_locator.hpp"
#include "vesica/mesh/triangulation.hpp"

namespace vesica::adapt {

/// A new mesh of an old surface.
struct Remeshed {
  mesh::Surface surface;
  /// Where each new node lies on the old surface; see transfer.hpp.
  std::vector<mesh::SurfaceLocation> origins;
};

}  // namespace vesica::adapt
