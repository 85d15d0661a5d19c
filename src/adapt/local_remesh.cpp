#include "vesica/adapt/local_remesh.hpp"

#include <fmt/format.h>

#include <cmath>

#include "remesher.hpp"
#include "vesica/core/error.hpp"

namespace vesica::adapt {
namespace {

constexpr int max_sweeps = 8;
constexpr int min_sweeps = 4;
constexpr int max_split_passes = 8;
constexpr int num_angle_sweeps = 6;
/// Quality that smoothing may give up for sizes.
constexpr double fair_quality = 0.5;

void check_sizes(const Eigen::VectorXd& sizes, mesh::NodeIndex num_nodes) {
  if (sizes.size() != num_nodes) {
    throw ConfigError(fmt::format("remeshing: {} sizes: must be one for each of the {} nodes",
                                  sizes.size(), num_nodes));
  }
  for (Eigen::Index node = 0; node < sizes.size(); ++node) {
    if (!(sizes[node] > 0) || !std::isfinite(sizes[node])) {
      throw ConfigError(
          fmt::format("remeshing: size {} at node {}: must be > 0 and finite", sizes[node], node));
    }
  }
}

}  // namespace

Remeshed local_remesh(const mesh::Surface& old, const Eigen::VectorXd& sizes) {
  check_sizes(sizes, old.triangulation->num_nodes());
  const mesh::SurfaceLocator locator(old.triangulation, old.positions);
  Remesher remesher(locator, sizes);
  remesher.flip_towards_valence_six();
  for (int pass = 0; pass < max_split_passes && remesher.split_long_edges() > 0; ++pass) {
    remesher.flip_towards_valence_six();
  }
  for (int sweep = 0; sweep < max_sweeps; ++sweep) {
    const int num_changed = remesher.split_long_edges() + remesher.collapse_short_edges();
    remesher.flip_towards_valence_six();
    remesher.smooth(fair_quality);
    if (sweep + 1 >= min_sweeps && num_changed == 0) break;
  }
  for (int sweep = 0; sweep < num_angle_sweeps; ++sweep) {
    remesher.flip_for_angles();
    remesher.smooth(1);
  }
  return remesher.result();
}

}  // namespace vesica::adapt
