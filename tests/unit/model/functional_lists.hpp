#pragma once

#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "vesica/model/model.hpp"

namespace vesica::model {

template <class Tuple>
struct TypesOf;
template <class... Functional>
struct TypesOf<std::tuple<Functional...>> {
  using type = testing::Types<Functional...>;
};

/// Every energy and every constraint of the model, for TYPED_TEST_SUITE.
using AllFunctionals = TypesOf<decltype(std::tuple_cat(Energies{}, Constraints{}))>::type;

/// Names the tests of AllFunctionals.
struct FunctionalName {
  template <class Functional>
  static std::string GetName(int) {
    return std::string(Functional::name);
  }
};

/// All constants different from each other and from zero.
inline Material generic_material() {
  Material material;
  material.bending_rigidity = {1.5, 1.0};
  material.spontaneous_curvature = {-0.7, 1.1};
  material.gaussian_rigidity = {2.0, -0.6};
  material.surface_tension = {0.8, -0.5};
  material.line_tension = 1.3;
  material.interface_width = 0.4;
  return material;
}

}  // namespace vesica::model
