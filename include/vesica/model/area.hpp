#pragma once

#include <string_view>

#include "vesica/model/surface_functional.hpp"

namespace vesica::model {

/// Surface area |Gamma| of (2.2); its variation is (2.6e).
struct Area {
  static constexpr std::string_view name = "area";
  static constexpr std::string_view key = "area";
  static constexpr std::string_view unit = "length^2";
  static constexpr std::string_view meaning = "as volume";
  static constexpr int length_power = 2;
  static constexpr bool needs_phase_field = false;

  template <class T, class Factor>
  static void add_to(const Material&, const LocalPoint<T>&, const Factor& factor,
                     LocalDensity<T>& sum) {
    sum.value += factor;
  }
};

}  // namespace vesica::model
