#include "vesica/io/verdict_files.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "io/verdict_fields.hpp"
#include "vesica/io/run_folder.hpp"

namespace vesica::io {
namespace {

void add_constraints(JsonWriter& json, std::string_view key, const model::PerConstraint& values) {
  json.begin_object(key);
  model::PerConstraint::fields(
      values, [&](const Field& field, const auto& value) { json.add(field.name, value); });
  json.end_object();
}

void add_energy(JsonWriter& json, const model::EnergyParts& energy) {
  json.begin_object("energy");
  json.add("total", energy.total());
  model::EnergyParts::fields(
      energy, [&](const Field& field, const auto& value) { json.add(field.name, value); });
  json.end_object();
}

void add_velocities(JsonWriter& json, const relax::Verdict& verdict) {
  const measure::VelocityNorms& velocity = verdict.outcome.diagnostics.velocity;
  const double radius = verdict.shape.characteristic_radius;
  const double rigid_squared =
      velocity.normal * velocity.normal - velocity.normal_rigid_free * velocity.normal_rigid_free;
  json.add("normal_velocity", velocity.normal_rigid_free / radius);
  json.add("normal_velocity_plain", velocity.normal / radius);
  json.add("drift", rigid_squared < 0 ? 0 : std::sqrt(rigid_squared) / radius);
  json.add("tangential_velocity", velocity.tangential / radius);
}

void add_mesh(JsonWriter& json, const relax::Verdict& verdict) {
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
                 const std::vector<measure::PhaseDomain>& domains, const auto& number) {
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

void add_shape(JsonWriter& json, const relax::Verdict& verdict) {
  const measure::ShapeNumbers& shape = verdict.shape;
  json.begin_object("shape");
  model::Measures::fields(
      verdict.outcome.diagnostics.measures,
      [&](const Field& field, const auto& value) { json.add(field.name, value); });
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

void add_verdict(JsonWriter& json, const relax::Verdict& verdict) {
  json.add("status", relax::status_name(verdict.outcome.status));
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

std::string to_json(const relax::Verdict& verdict) {
  JsonWriter json;
  add_verdict(json, verdict);
  return json.text();
}

void write_verdict(const config::RunConfig& config, const relax::Verdict& verdict) {
  const std::filesystem::path folder = config.output.directory;
  write_text_file(folder / "case.toml", config::to_toml(config));
  write_text_file(folder / "verdict.json", to_json(verdict));
}

}  // namespace vesica::io
