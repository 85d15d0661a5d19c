#include "fitness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "vesica/mesh/quality.hpp"

namespace vesica::adapt {

void Fitness::include(const SurfaceVertex& a, const SurfaceVertex& b, const SurfaceVertex& c) {
  const std::array<Eigen::Vector3d, 3> x = {a.place.point, b.place.point, c.place.point};
  quality = std::min(quality, mesh::smallest_sine(x));
  const Eigen::Vector3d flat = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
  const double cosine = std::min({flat.dot(a.normal), flat.dot(b.normal), flat.dot(c.normal)});
  uprightness = std::min(uprightness, cosine);
}

bool Fitness::is_as_good_as(const Fitness& before, double enough) const {
  constexpr double upright_enough = 0.5;
  return quality >= std::min(before.quality, enough) &&
         uprightness >= std::min(before.uprightness, upright_enough);
}

}  // namespace vesica::adapt
