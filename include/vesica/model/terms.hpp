#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>

#include "vesica/model/area.hpp"
#include "vesica/model/bending_energy.hpp"
#include "vesica/model/gaussian_energy.hpp"
#include "vesica/model/line_energy.hpp"
#include "vesica/model/phase_difference.hpp"
#include "vesica/model/surface_tension.hpp"
#include "vesica/model/total_mean_curvature.hpp"
#include "vesica/model/volume.hpp"

namespace vesica::model {

/// The list of the energies: (1.6) and the surface tension. A new term is a type like these, named
/// here.
using Energies = std::tuple<BendingEnergy, GaussianEnergy, LineEnergy, SurfaceTension>;

/// The list of the constrained functionals: those of (2.2), (2.3) and the total mean curvature, in
/// the order of the multipliers. A new constraint is a type like these, named here.
using Constraints = std::tuple<Volume, Area, PhaseDifference, TotalMeanCurvature>;

inline constexpr std::size_t num_energies = std::tuple_size_v<Energies>;
inline constexpr int num_constraints = static_cast<int>(std::tuple_size_v<Constraints>);

/// Calls visit.operator()<Term>(place) for every type of a list, in its order.
template <class List, class Visit>
constexpr void for_each_term(Visit&& visit) {
  [&]<class... Term>(std::tuple<Term...>*) {
    std::size_t place = 0;
    (visit.template operator()<Term>(place++), ...);
  }(static_cast<List*>(nullptr));
}

/// The place of a term in its list; does not compile for a type that is not in it.
template <class List, class Term>
inline constexpr std::size_t place_of = [] {
  std::size_t found = std::tuple_size_v<List>;
  for_each_term<List>([&]<class Candidate>(std::size_t place) {
    if (std::is_same_v<Candidate, Term>) found = place;
  });
  return found;
}();

}  // namespace vesica::model
