#include "vesica/io/verdict.hpp"

#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>
#include <vector>

#include "io/verdict_fields.hpp"
#include "vesica/io/run_folder.hpp"
#include "vesica/mesh/quality.hpp"

namespace vesica::io {
namespace {

void add_constraints(JsonWriter& json, std::string_view key, const problem::PerConstraint& values) {
  json.begin_object(key);
  json.add("volume", values.volume);
  json.add("area", values.area);
  json.add("phase", values.phase);
  json.end_object();
}

void add_energy(JsonWriter& json, const problem::EnergyParts& energy) {
  json.begin_object("energy");
  json.add("total", energy.total());
  json.add("bending", energy.bending);
  json.add("gaussian", energy.gaussian);
  json.add("line", energy.line);
  json.end_object();
}

void add_velocities(JsonWriter& json, const Verdict& verdict) {
  const problem::VelocityNorms& velocity = verdict.outcome.diagnostics.velocity;
  const double radius = verdict.shape.characteristic_radius;
  const double rigid_squared =
      velocity.normal * velocity.normal - velocity.normal_rigid_free * velocity.normal_rigid_free;
  json.add("normal_velocity", velocity.normal_rigid_free / radius);
  json.add("normal_velocity_plain", velocity.normal / radius);
  json.add("drift", rigid_squared < 0 ? 0 : std::sqrt(rigid_squared) / radius);
  json.add("tangential_velocity", velocity.tangential / radius);
}

void add_mesh(JsonWriter& json, const Verdict& verdict) {
  json.begin_object("mesh");
  json.add("nodes", verdict.num_nodes);
  json.add("triangles", verdict.num_triangles);
  json.add("quality", verdict.outcome.diagnostics.quality);
  json.add("quality_initial", verdict.outcome.initial_quality);
  json.add("quality_smallest", verdict.outcome.smallest_quality);
  json.add("area_ratio", verdict.area_ratio);
  json.add("smallest_normal_cosine", verdict.smallest_normal_cosine);
  json.add("adaptions", 0);
  json.add("remeshings", static_cast<int>(verdict.outcome.mesh_changes.size()));
  json.end_object();
}

/// One number a domain, an array for each phase.
void add_domains(JsonWriter& json, std::string_view key,
                 const std::vector<problem::PhaseDomain>& domains, const auto& number) {
  std::array<std::vector<double>, 2> numbers;
  for (const auto& domain : domains)
    numbers[static_cast<std::size_t>(domain.phase) - 1].push_back(number(domain));
  json.begin_object(key);
  json.add("phase_1", numbers[0]);
  json.add("phase_2", numbers[1]);
  json.end_object();
}

void add_events(JsonWriter& json, const std::vector<relax::Event>& events) {
  json.begin_array("events");
  for (const auto& event : events) {
    json.begin_element();
    json.add("step", event.step);
    json.add("time", event.time);
    json.add("what", event.what);
    json.end_object();
  }
  json.end_array();
}

void add_shape(JsonWriter& json, const Verdict& verdict) {
  const problem::ShapeNumbers& shape = verdict.shape;
  json.begin_object("shape");
  json.add("volume", verdict.outcome.diagnostics.volume);
  json.add("area", verdict.outcome.diagnostics.area);
  json.add("phase_difference", verdict.outcome.diagnostics.phase_difference);
  json.add("characteristic_radius", shape.characteristic_radius);
  json.add("reduced_volume", shape.reduced_volume);
  json.add("phase_fraction", shape.phase_fraction);
  json.add("reduced_line_tension", shape.reduced_line_tension);
  json.add("rigidity_ratio", shape.rigidity_ratio);
  json.add("saddle_splay_difference", shape.saddle_splay_difference);
  json.add("neck_radius", shape.neck_radius);
  json.add("length", shape.length);
  json.end_object();
  json.begin_object("domains");
  json.add("phase_1", shape.domains_1);
  json.add("phase_2", shape.domains_2);
  const auto& domains = verdict.outcome.diagnostics.domains;
  add_domains(json, "areas", domains, [](const auto& domain) { return domain.area; });
  add_domains(json, "boundary_lengths", domains,
              [](const auto& domain) { return domain.boundary_length; });
  json.end_object();
}

void add_equilibrium(JsonWriter& json, const solve::StepReport& report) {
  json.add("gradient", report.gradient);
  json.begin_object("polish");
  const auto value = [&](auto member) -> std::optional<double> {
    if (!report.polish) return std::nullopt;
    return member(*report.polish);
  };
  json.add("iterations", report.polish ? std::optional(report.polish->iterations) : std::nullopt);
  json.add("gradient", value([](const auto& polish) { return polish.gradient; }));
  json.add("lowest_curvature", value([](const auto& polish) { return polish.curvature.value; }));
  json.end_object();
}

void add_work(JsonWriter& json, const solve::StepReport& report) {
  json.begin_object("counts");
  json.add("steps", report.counts.steps);
  json.add("newton", report.counts.newton);
  json.add("krylov", report.counts.krylov);
  json.add("residuals", report.counts.residuals);
  json.add("jacobians", report.counts.jacobians);
  json.add("factorisations", report.counts.factorisations);
  json.add("failures", report.counts.failures);
  json.end_object();
  json.begin_object("seconds");
  json.add("total", report.seconds.total);
  json.add("processor", report.seconds.processor);
  json.add("residual", report.seconds.residual);
  json.add("jacobian", report.seconds.jacobian);
  json.add("factorisation", report.seconds.factorisation);
  json.add("solve", report.seconds.solve);
  json.end_object();
}

}  // namespace

Verdict make_verdict(relax::Outcome outcome, const solve::SolverOptions& solver,
                     const model::Model& model, const problem::State& state) {
  Verdict verdict;
  verdict.outcome = std::move(outcome);
  verdict.method = name_of(solver.method);
  const bool minimises = solver.method == solve::Method::minimize;
  verdict.scheme = name_of(minimises ? solve::Scheme::variational : solver.scheme);
  verdict.time = state.time;
  verdict.multipliers = state.values.multipliers;
  verdict.shape = problem::shape_numbers(model, state);
  const auto& positions = state.values.positions;
  verdict.area_ratio = mesh::area_ratio(*state.triangulation, positions);
  verdict.smallest_normal_cosine = mesh::smallest_normal_cosine(*state.triangulation, positions);
  verdict.num_nodes = state.triangulation->num_nodes();
  verdict.num_triangles = state.triangulation->num_triangles();
  return verdict;
}

void add_verdict(JsonWriter& json, const Verdict& verdict) {
  json.add("status", status_name(verdict.outcome.status));
  json.add("reason", verdict.outcome.reason);
  json.add("time", verdict.time);
  json.add("method", verdict.method);
  json.add("scheme", verdict.scheme);
  add_energy(json, verdict.outcome.diagnostics.energy);
  add_constraints(json, "multipliers", verdict.multipliers);
  add_constraints(json, "constraints", verdict.outcome.diagnostics.constraint_errors);
  add_velocities(json, verdict);
  add_equilibrium(json, verdict.outcome.report);
  add_mesh(json, verdict);
  add_shape(json, verdict);
  add_events(json, verdict.outcome.events);
  add_work(json, verdict.outcome.report);
}

std::string to_json(const Verdict& verdict) {
  JsonWriter json;
  add_verdict(json, verdict);
  return json.text();
}

void write_verdict(const RunConfig& config, const Verdict& verdict) {
  const std::filesystem::path folder = config.output.directory;
  write_text_file(folder / "case.toml", to_toml(config));
  write_text_file(folder / "verdict.json", to_json(verdict));
}

std::string_view status_name(relax::RunStatus status) {
  switch (status) {
    case relax::RunStatus::converged:
      return "converged";
    case relax::RunStatus::end_time:
    case relax::RunStatus::time_limit:
      return "time limit";
    case relax::RunStatus::step_limit:
      return "step limit";
    case relax::RunStatus::stopped:
      return "stopped";
    case relax::RunStatus::neck_closes:
      return "neck closes";
    case relax::RunStatus::budding:
      return "budding";
    case relax::RunStatus::self_intersection:
      return "self-intersection";
    case relax::RunStatus::interrupted:
      return "interrupted";
    case relax::RunStatus::numerical_failure:
      break;
  }
  return "numerical failure";
}

int exit_status(const relax::Outcome& outcome) {
  switch (outcome.status) {
    case relax::RunStatus::converged:
      return 0;
    case relax::RunStatus::end_time:
    case relax::RunStatus::time_limit:
    case relax::RunStatus::step_limit:
    case relax::RunStatus::stopped:
    case relax::RunStatus::neck_closes:
    case relax::RunStatus::budding:
    case relax::RunStatus::self_intersection:
      return 1;
    case relax::RunStatus::interrupted:
      return 128 + (outcome.signal == 0 ? SIGINT : outcome.signal);
    case relax::RunStatus::numerical_failure:
      break;
  }
  return 3;
}

}  // namespace vesica::io
