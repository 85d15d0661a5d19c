#include "vesica/model/constraints.hpp"

namespace vesica::model {

double Ramp::value(double time) const {
  if (time >= end) return to;
  if (time <= start) return from;
  return from + (to - from) * (time - start) / (end - start);
}

double Ramp::rate(double time) const {
  return time >= start && time < end ? (to - from) / (end - start) : 0.0;
}

}  // namespace vesica::model
