#include "vesica/phase/initial_phase.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "core/refuse.hpp"
#include "phase_file.hpp"
#include "phase_levels.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"
#include "vesica/fem/surface_integral.hpp"
#include "vesica/model/two_phase.hpp"

namespace vesica::phase {
namespace {

Eigen::VectorXd shifted(const PhaseLevels& levels, double shift) {
  const Eigen::ArrayXd level = levels.values.array() + shift;
  if (levels.profile == PhaseProfile::tanh)
    return level.unaryExpr([](double l) { return std::tanh(l); });
  return level.max(-1.0).min(1.0);
}

/// Shift beyond which all levels are saturated: c = -1 or +1 in double precision.
double saturation(PhaseProfile profile) { return profile == PhaseProfile::tanh ? 20.0 : 1.0; }

/// The quadrature points of a surface, whose geometry is the same for every c.
std::vector<fem::SurfaceSample> samples_of(const mesh::Surface& surface) {
  std::vector<fem::SurfaceSample> samples;
  fem::for_each_point(*surface.triangulation, surface.positions,
                      [&](const fem::SurfaceSample& sample) { samples.push_back(sample); });
  return samples;
}

/// int h(c), the sum that the constraint takes.
double phase_integral(const std::vector<fem::SurfaceSample>& samples, const Eigen::VectorXd& c) {
  double sum = 0;
  for (const fem::SurfaceSample& sample : samples)
    sum += sample.weight * model::phase_indicator(fem::scalar_at(c, sample));
  return sum;
}

/// Levels shifted so that int h(c) = target. Bisection to the last bit: the integral is continuous
/// in the shift, but with quadratic shape functions not strictly monotone.
Eigen::VectorXd match(const PhaseLevels& levels, const mesh::Surface& surface, double target) {
  const auto samples = samples_of(surface);
  const auto error = [&](double shift) {
    return phase_integral(samples, shifted(levels, shift)) - target;
  };
  double low = -levels.values.maxCoeff() - saturation(levels.profile);
  double high = -levels.values.minCoeff() + saturation(levels.profile);
  double error_low = error(low);
  double error_high = error(high);
  if (!(error_low <= 0 && error_high >= 0)) {
    throw ConfigError(
        fmt::format("phase.match_target: int h(c) = {:.8g} is out of reach: shifting the level "
                    "gives {:.8g} to {:.8g}; "
                    "change the target of the phase or set match_target = false",
                    target, error_low + target, error_high + target));
  }
  constexpr int halvings = 100;  // more than the bits of a double
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    const double error_middle = error(middle);
    if (error_middle <= 0) {
      low = middle;
      error_low = error_middle;
    } else {
      high = middle;
      error_high = error_middle;
    }
  }
  return shifted(levels, -error_low < error_high ? low : high);
}

/// The numbers of the file, or of the point field, that the options name.
GivenNumbers given_numbers(const PhaseOptions& options, std::span<const mesh::PointField> fields) {
  if (options.field.empty()) return read_phase_file(options.path);
  std::string names;
  for (const mesh::PointField& field : fields) {
    if (field.name == options.field) return numbers_of(field);
    names += fmt::format("{}{}", names.empty() ? "" : ", ", field.name);
  }
  refuse("phase.field", fmt::format("\"{}\"", options.field),
         names.empty() ? "the file of the shape has no point fields"
                       : fmt::format("must be a point field of the shape's file: {}", names));
}

}  // namespace

void PhaseOptions::check_together() const {
  if (kind == PhaseKind::file && !field.empty() && !path.empty())
    refuse("phase.field", fmt::format("\"{}\"", field), "leaves no use for phase.path");
}

PhaseStart start_phase(const PhaseOptions& options, const mesh::Surface& surface,
                       double interface_width, std::optional<double> target,
                       std::span<const mesh::PointField> fields) {
  check("phase", options);
  if (!(interface_width > 0) || !std::isfinite(interface_width))
    refuse("material.interface_width", interface_width, "must be > 0");
  const bool is_matched = target && options.match_target;
  if (options.kind == PhaseKind::file) {
    PhaseStart start = order_parameter_of(given_numbers(options, fields), *surface.triangulation);
    if (is_matched) {
      start.order_parameter =
          match({std::move(start.order_parameter), PhaseProfile::clip}, surface, *target);
    }
    return start;
  }
  const auto levels = phase_levels(options, surface, interface_width);
  return {is_matched ? match(levels, surface, *target) : shifted(levels, 0), {}};
}

Eigen::VectorXd initial_phase(const PhaseOptions& options, const mesh::Surface& surface,
                              double interface_width, std::optional<double> target) {
  return start_phase(options, surface, interface_width, target, {}).order_parameter;
}

}  // namespace vesica::phase
