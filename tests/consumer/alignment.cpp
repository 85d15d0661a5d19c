// Eigen arrays cross the boundary to a library that was compiled for another instruction set:
// arrays that the library allocated are resized and freed here. Does not compile, or aborts, when
// the two sides align, and so allocate, differently.

// Before Eigen, which defines both itself where the exported target does not.
#if !defined(EIGEN_MAX_ALIGN_BYTES) || !defined(EIGEN_MAX_STATIC_ALIGN_BYTES)
#error "vesica::vesica does not carry the alignment that the library was compiled with"
#endif

#include <Eigen/Core>
#include <utility>

#include "vesica/shapes/shapes.hpp"

#ifdef __AVX__
#error "the consumer is to be compiled for the base instruction set"
#endif

static_assert(EIGEN_DEFAULT_ALIGN_BYTES == 64 && EIGEN_MAX_STATIC_ALIGN_BYTES == 16);

int main() {
  for (int resolution = 1; resolution <= 8; ++resolution) {
    vesica::shapes::ShapeOptions options;
    options.kind = vesica::shapes::ShapeKind::sphere;
    options.resolution = resolution;
    vesica::mesh::Surface surface = vesica::shapes::make_shape(options);
    const Eigen::Index num_nodes = surface.positions.rows();
    surface.positions.conservativeResize(3 * num_nodes + 1, 3);
    surface.positions.conservativeResize(num_nodes, 3);
    const vesica::mesh::Positions taken = std::exchange(surface.positions, {});
    const double radius = taken.rowwise().norm().maxCoeff();
    if (radius < 0.99 || radius > 1.01) return 1;
  }
}
