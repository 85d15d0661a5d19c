#pragma once

#include <cmath>

namespace vesica::test {

/// Exponent p of an error that falls like h^p, from two meshes whose mesh sizes have the ratio
/// `refinement` (coarse over fine, > 1).
inline double observed_order(double coarse_error, double fine_error, double refinement) {
  return std::log(std::abs(coarse_error) / std::abs(fine_error)) / std::log(refinement);
}

}  // namespace vesica::test
