#include "io/time_series.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace vesica::io {
namespace {

using View = relax::StepView;

struct Quantity {
  std::string_view name;
  double (*value)(const View&);
};

double number(const std::optional<double>& value) {
  return value.value_or(std::numeric_limits<double>::quiet_NaN());
}

double radius(const View& view) {
  return std::sqrt(view.diagnostics.measures.area() / (4 * std::numbers::pi));
}

double count(long value) { return static_cast<double>(value); }

constexpr std::array quantities{
    Quantity{"time", [](const View& v) { return v.state.time; }},
    Quantity{"step", [](const View& v) { return count(v.report.counts.steps); }},
    Quantity{"step_size", [](const View& v) { return v.report.step_size; }},
    Quantity{"order", [](const View& v) { return count(v.report.order); }},
    Quantity{"energy_total", [](const View& v) { return v.diagnostics.energy.total(); }},
    Quantity{"energy_bending",
             [](const View& v) { return number(v.diagnostics.energy.of<model::BendingEnergy>()); }},
    Quantity{
        "energy_gaussian",
        [](const View& v) { return number(v.diagnostics.energy.of<model::GaussianEnergy>()); }},
    Quantity{
        "energy_surface_tension",
        [](const View& v) { return number(v.diagnostics.energy.of<model::SurfaceTension>()); }},
    Quantity{"energy_line",
             [](const View& v) { return number(v.diagnostics.energy.of<model::LineEnergy>()); }},
    Quantity{"multiplier_volume",
             [](const View& v) { return number(v.state.values.multipliers.of<model::Volume>()); }},
    Quantity{"multiplier_area",
             [](const View& v) { return number(v.state.values.multipliers.of<model::Area>()); }},
    Quantity{"multiplier_phase",
             [](const View& v) {
               return number(v.state.values.multipliers.of<model::PhaseDifference>());
             }},
    Quantity{"volume", [](const View& v) { return v.diagnostics.measures.volume(); }},
    Quantity{"area", [](const View& v) { return v.diagnostics.measures.area(); }},
    Quantity{"phase_difference",
             [](const View& v) { return number(v.diagnostics.measures.phase_difference()); }},
    Quantity{
        "constraint_error_volume",
        [](const View& v) { return number(v.diagnostics.constraint_errors.of<model::Volume>()); }},
    Quantity{
        "constraint_error_area",
        [](const View& v) { return number(v.diagnostics.constraint_errors.of<model::Area>()); }},
    Quantity{"constraint_error_phase",
             [](const View& v) {
               return number(v.diagnostics.constraint_errors.of<model::PhaseDifference>());
             }},
    Quantity{"normal_velocity",
             [](const View& v) { return v.diagnostics.velocity.normal_rigid_free / radius(v); }},
    Quantity{"normal_velocity_plain",
             [](const View& v) { return v.diagnostics.velocity.normal / radius(v); }},
    Quantity{"tangential_velocity",
             [](const View& v) { return v.diagnostics.velocity.tangential / radius(v); }},
    Quantity{"quality", [](const View& v) { return v.diagnostics.quality; }},
    Quantity{"damping", [](const View& v) { return v.state.damping; }},
    Quantity{"newton", [](const View& v) { return count(v.report.counts.newton); }},
    Quantity{"krylov", [](const View& v) { return count(v.report.counts.krylov); }},
    Quantity{"residuals", [](const View& v) { return count(v.report.counts.residuals); }},
    Quantity{"jacobians", [](const View& v) { return count(v.report.counts.jacobians); }},
    Quantity{"factorisations", [](const View& v) { return count(v.report.counts.factorisations); }},
    Quantity{"failures", [](const View& v) { return count(v.report.counts.failures); }},
    Quantity{"seconds_total", [](const View& v) { return v.report.seconds.total; }},
    Quantity{"seconds_processor", [](const View& v) { return v.report.seconds.processor; }},
    Quantity{"seconds_residual", [](const View& v) { return v.report.seconds.residual; }},
    Quantity{"seconds_jacobian", [](const View& v) { return v.report.seconds.jacobian; }},
    Quantity{"seconds_factorisation", [](const View& v) { return v.report.seconds.factorisation; }},
    Quantity{"seconds_solve", [](const View& v) { return v.report.seconds.solve; }},
};

}  // namespace

std::vector<std::string_view> series_names() {
  std::vector<std::string_view> names;
  for (const Quantity& quantity : quantities) names.push_back(quantity.name);
  return names;
}

std::vector<double> series_row(const relax::StepView& view) {
  std::vector<double> row;
  for (const Quantity& quantity : quantities) row.push_back(quantity.value(view));
  return row;
}

}  // namespace vesica::io
