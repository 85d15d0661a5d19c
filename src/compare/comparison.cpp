#include "vesica/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "compare/common_mesh.hpp"

namespace vesica::compare {
namespace {

/// Over the larger modulus; 0 for two zeros.
double relative_difference(double first, double second) {
  const double scale = std::max(std::abs(first), std::abs(second));
  return scale == 0 ? 0 : (second - first) / scale;
}

std::optional<double> relative_difference(const std::optional<double>& first,
                                          const std::optional<double>& second) {
  if (!first || !second) return std::nullopt;
  return relative_difference(*first, *second);
}

model::PerConstraint relative_difference(model::PerConstraint first,
                                         const model::PerConstraint& second) {
  combine_fields(first, second, [](auto& a, const auto& b) { a = relative_difference(a, b); });
  return first;
}

bool has_converged(const ComparedRun& run) {
  return run.verdict.outcome.status == relax::RunStatus::converged;
}

/// "shapes differ by 0.21 R_c" for everything that is beyond its tolerance.
std::string contradictions(const Difference& difference, const relax::Verdict& first,
                           const relax::Verdict& second, const EquilibriumTolerances& tolerances) {
  std::string found;
  const auto add = [&found](const std::string& text) {
    found += fmt::format("{}{}", found.empty() ? "" : ", ", text);
  };
  // written so that a value that is no number is a contradiction
  if (!(std::abs(difference.relative_energy) <= tolerances.energy)) {
    add(fmt::format("energies differ by {:.1e} (relative, tolerance {:g})",
                    std::abs(difference.relative_energy), tolerances.energy));
  }
  if (!(difference.shape.l2 <= tolerances.shape_l2)) {
    add(fmt::format("shapes by {:.1e} R_c (tolerance {:g})", difference.shape.l2,
                    tolerances.shape_l2));
  }
  const double phase_l2 = difference.shape.phase_l2.value_or(0);
  if (!(phase_l2 <= tolerances.phase_l2)) {
    add(fmt::format("phase fields by {:.1e} (tolerance {:g})", phase_l2, tolerances.phase_l2));
  }
  if (first.shape.domains_1 != second.shape.domains_1 ||
      first.shape.domains_2 != second.shape.domains_2) {
    add(fmt::format("numbers of domains: {} + {} and {} + {}", first.shape.domains_1.value_or(0),
                    first.shape.domains_2.value_or(0), second.shape.domains_1.value_or(0),
                    second.shape.domains_2.value_or(0)));
  }
  return found;
}

std::string agreement(const Difference& difference) {
  std::string text = fmt::format(
      "{} and {} found the same equilibrium: energies agree to {:.1e} (relative), shapes to {:.1e} "
      "R_c",
      difference.first, difference.second, std::abs(difference.relative_energy),
      difference.shape.l2);
  if (difference.shape.phase_l2)
    text += fmt::format(", phase fields to {:.1e}", *difference.shape.phase_l2);
  return text;
}

/// What the polish of the two runs tells about their equilibria. A flow may come to rest on a
/// saddle.
std::string kind_of_equilibria(const ComparedRun& first, const ComparedRun& second) {
  std::string saddles;
  bool are_known = true;
  for (const ComparedRun* run : {&first, &second}) {
    const auto& polish = run->verdict.outcome.report.polish;
    are_known = are_known && polish;
    if (polish && polish->curvature.value < 0) {
      saddles += fmt::format("{}that of {} is a saddle, lowest curvature {:.3g}",
                             saddles.empty() ? "" : "; ", run->name, polish->curvature.value);
    }
  }
  if (!saddles.empty()) return saddles;
  return are_known ? "two local minima" : "two local minima, unless one is a saddle";
}

std::string disagreement(const Difference& difference, const std::string& kind,
                         const std::string& found) {
  return fmt::format("{} and {} found different equilibria ({}), {} the lower one: {}",
                     difference.first, difference.second, kind,
                     difference.energy < 0 ? difference.second : difference.first, found);
}

void conclude(const ComparedRun& first, const ComparedRun& second,
              const EquilibriumTolerances& tolerances, Difference& difference) {
  for (const ComparedRun* run : {&first, &second}) {
    if (has_converged(*run)) continue;
    difference.conclusion = fmt::format(
        "whether {} and {} find the same equilibrium is open: {} has not converged ({})",
        first.name, second.name, run->name, name_of(run->verdict.outcome.status));
    return;
  }
  const auto found = contradictions(difference, first.verdict, second.verdict, tolerances);
  difference.same_equilibrium = found.empty();
  difference.conclusion = found.empty()
                              ? agreement(difference)
                              : disagreement(difference, kind_of_equilibria(first, second), found);
}

Difference difference_of(const ComparedRun& first, const ComparedRun& second,
                         const EquilibriumTolerances& tolerances) {
  const auto [a, b, is_on_common_mesh] = on_common_mesh(first, second);
  Difference difference;
  difference.is_on_common_mesh = is_on_common_mesh;
  difference.first = first.name;
  difference.second = second.name;
  difference.energy = b.energy - a.energy;
  difference.relative_energy = relative_difference(a.energy, b.energy);
  difference.multipliers =
      relative_difference(a.state.values.multipliers, b.state.values.multipliers);
  difference.shape = shape_distance(a.state, b.state);
  conclude(first, second, tolerances, difference);
  return difference;
}

}  // namespace

Comparison compare(std::vector<ComparedRun> runs, const EquilibriumTolerances& tolerances) {
  Comparison comparison;
  for (std::size_t i = 1; i < runs.size(); ++i)
    comparison.differences.push_back(difference_of(runs.front(), runs[i], tolerances));
  comparison.runs = std::move(runs);
  return comparison;
}

int exit_status(const Comparison& comparison) {
  int worst = 0;
  for (const ComparedRun& run : comparison.runs)
    worst = std::max(worst, exit_status(run.verdict.outcome));
  return worst;
}

}  // namespace vesica::compare
