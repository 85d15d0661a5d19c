#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <optional>
#include <ostream>
#include <string>

#include "vesica/io/verdict_files.hpp"

namespace vesica::io {
namespace {

/// "name value, name value, ..." of the values that exist.
class Row {
 public:
  explicit Row(std::string_view title) : text_(fmt::format("  {:<18}", title)) {}

  Row& add(std::string_view name, std::optional<double> value, std::string_view format = "{:.8g}") {
    if (value && !std::isnan(*value)) append(name, fmt::format(fmt::runtime(format), *value));
    return *this;
  }
  Row& count(std::string_view name, std::optional<long> value) {
    if (value) append(name, fmt::format("{}", *value));
    return *this;
  }
  [[nodiscard]] std::string text() const { return is_empty_ ? "" : text_ + "\n"; }

 private:
  void append(std::string_view name, const std::string& value) {
    text_ += fmt::format("{}{}{}{}", is_empty_ ? "" : ", ", name, name.empty() ? "" : " ", value);
    is_empty_ = false;
  }

  std::string text_;
  bool is_empty_ = true;
};

std::string physics_text(const relax::Verdict& verdict) {
  const measure::Diagnostics& measured = verdict.outcome.diagnostics;
  const model::PerConstraint& lambda = verdict.multipliers;
  const model::PerConstraint& errors = measured.constraint_errors;
  const measure::ShapeNumbers& shape = verdict.shape;
  Row energy("energy");
  energy.add("total", measured.energy.total())
      .add("bending", measured.energy.of<model::BendingEnergy>());
  energy.add("surface tension", measured.energy.of<model::SurfaceTension>());
  energy.add("gaussian", measured.energy.of<model::GaussianEnergy>())
      .add("line", measured.energy.of<model::LineEnergy>());
  Row multipliers("multipliers");
  multipliers.add("volume", lambda.of<model::Volume>())
      .add("area", lambda.of<model::Area>())
      .add("phase", lambda.of<model::PhaseDifference>());
  Row constraints("constraint errors");
  constraints.add("volume", errors.of<model::Volume>(), "{:.1e}")
      .add("area", errors.of<model::Area>(), "{:.1e}")
      .add("phase", errors.of<model::PhaseDifference>(), "{:.1e}");
  Row sizes("shape");
  sizes.add("volume", measured.measures.volume())
      .add("area", measured.measures.area())
      .add("length", shape.length, "{:.5g}");
  sizes.add("neck radius", shape.neck_radius, "{:.4g}");
  Row reduced("reduced numbers");
  reduced.add("v_r", shape.reduced_volume, "{:.5g}").add("x_r", shape.phase_fraction, "{:.5g}");
  reduced.add("line tension", shape.reduced_line_tension, "{:.5g}")
      .add("b_r", shape.rigidity_ratio, "{:.5g}");
  reduced.add("Delta_g", shape.saddle_splay_difference, "{:.5g}");
  Row domains("domains");
  domains.count("phase 1:", shape.domains_1).count("phase 2:", shape.domains_2);
  return energy.text() + multipliers.text() + constraints.text() + sizes.text() + reduced.text() +
         domains.text();
}

std::string numerics_text(const relax::Verdict& verdict) {
  const relax::Outcome& outcome = verdict.outcome;
  const solve::SolverCounts& counts = outcome.report.counts;
  const solve::SolverSeconds& spent = outcome.report.seconds;
  const measure::VelocityNorms& norms = outcome.diagnostics.velocity;
  const double radius = verdict.shape.characteristic_radius;
  Row velocity("normal velocity");
  velocity.add("", norms.normal_rigid_free / radius, "{:.2e}")
      .add("with rigid drift", norms.normal / radius, "{:.2e}");
  Row mesh("mesh");
  mesh.count("nodes", verdict.num_nodes).count("triangles", verdict.num_triangles);
  mesh.add("quality", outcome.diagnostics.quality, "{:.3f}")
      .add("at the start", outcome.initial_quality, "{:.3f}");
  mesh.add("smallest", outcome.smallest_quality, "{:.3f}");
  mesh.add("area ratio", verdict.area_ratio, "{:.3g}");
  if (verdict.smallest_normal_cosine < 0)
    mesh.add("FOLDED: normal cosine", verdict.smallest_normal_cosine, "{:.2f}");
  Row polish("polish");
  if (const auto& report = outcome.report.polish) {
    polish.count("iterations", report->iterations).add("gradient", report->gradient, "{:.1e}");
    polish.add(
        report->curvature.value < 0 ? "a SADDLE: lowest curvature" : "a minimum: lowest curvature",
        report->curvature.value, "{:.4g}");
  }
  Row work("work");
  work.count("steps", counts.steps).count("Newton", counts.newton).count("Krylov", counts.krylov);
  work.count("residuals", counts.residuals).count("Jacobians", counts.jacobians);
  work.count("factorisations", counts.factorisations).count("failures", counts.failures);
  Row seconds("seconds");
  seconds.add("", spent.total, "{:.2f}").add("processor", spent.processor, "{:.2f}");
  seconds.add("residual", spent.residual, "{:.2f}");
  seconds.add("Jacobian", spent.jacobian, "{:.2f}")
      .add("factorisation", spent.factorisation, "{:.2f}");
  seconds.add("solve", spent.solve, "{:.2f}");
  return velocity.text() + mesh.text() + polish.text() + work.text() + seconds.text();
}

}  // namespace

void print_verdict(std::ostream& out, const relax::Verdict& verdict) {
  out << fmt::format("{}: {}\n", relax::status_name(verdict.outcome.status), verdict.outcome.reason)
      << fmt::format("  {:<18}{:.6g}\n", "time", verdict.time) << physics_text(verdict)
      << numerics_text(verdict) << std::flush;
}

void print_files(std::ostream& out, const config::RunConfig& config) {
  const std::filesystem::path folder = config.output.directory;
  const auto print = [&out, &folder](const char* name, const char* meaning) {
    out << fmt::format("  {}  {}\n", (folder / name).string(), meaning);
  };
  out << "files:\n";
  print("verdict.json", "what is above, for programs");
  print("trajectory.h5", "frames and time series (docs/output.md)");
  if (config.output.paraview) print("trajectory.xdmf", "the frames for ParaView");
  print("case.toml", "the effective configuration");
  out << std::flush;
}

}  // namespace vesica::io
