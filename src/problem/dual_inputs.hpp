#pragma once

#include "vesica/core/dual.hpp"
#include "vesica/core/small_tensor.hpp"

namespace vesica::problem {

/// Turns the fields of a point into dual numbers, numbered in the order of the calls.
template <class D>
class DualInputs {
 public:
  D scalar(double value) { return D::input(value, next_++); }
  Vec3<D> vector(const Vec3<double>& a) {
    Vec3<D> result;
    result.x = scalar(a.x);
    result.y = scalar(a.y);
    result.z = scalar(a.z);
    return result;
  }

 private:
  int next_ = 0;
};

}  // namespace vesica::problem
