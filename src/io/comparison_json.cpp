#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "io/verdict_fields.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/io/run_reader.hpp"

namespace vesica::io {
namespace {

compare::ComparedRun named(std::string name, const std::filesystem::path& folder, FinishedRun run) {
  return {std::move(name),        folder,
          std::move(run.model),   std::move(run.state),
          std::move(run.verdict), std::move(run.history)};
}

void add_difference(JsonWriter& json, const compare::Difference& difference) {
  json.begin_object("energy");
  json.add("absolute", difference.energy);
  json.add("relative", difference.relative_energy);
  json.end_object();
  json.begin_object("multipliers");
  model::PerConstraint::fields(difference.multipliers, [&](const Field& field, const auto& value) {
    json.add(field.name, value);
  });
  json.end_object();
  json.add("shape_l2", difference.shape.l2);
  json.add("shape_hausdorff", difference.shape.hausdorff);
  json.add("phase_l2", difference.shape.phase_l2);
  json.add("on_common_mesh", std::optional<bool>(difference.is_on_common_mesh));
  json.add("same_equilibrium", difference.same_equilibrium);
  json.add("conclusion", difference.conclusion);
}

}  // namespace

std::vector<compare::ComparedRun> read_runs(const std::filesystem::path& first,
                                            const std::filesystem::path& second) {
  FinishedRun a = read_run(first);
  FinishedRun b = read_run(second);
  const auto is_minimizer = [](const FinishedRun& run) { return run.verdict.method == "minimize"; };
  const bool are_of_two_kinds = is_minimizer(a) != is_minimizer(b);
  const bool is_a_minimizer = is_minimizer(a);
  const auto name = [&](bool is_minimizer_run, const char* otherwise) {
    return are_of_two_kinds ? (is_minimizer_run ? "minimize" : "flow") : otherwise;
  };
  std::vector<compare::ComparedRun> runs;
  runs.push_back(named(name(is_a_minimizer, "first"), first, std::move(a)));
  runs.push_back(named(name(!is_a_minimizer, "second"), second, std::move(b)));
  return runs;
}

std::string to_json(const compare::Comparison& comparison) {
  JsonWriter json;
  for (const compare::ComparedRun& run : comparison.runs) {
    json.begin_object(run.name);
    json.add("folder", run.folder.string());
    add_verdict(json, run.verdict);
    json.end_object();
  }
  for (const compare::Difference& difference : comparison.differences) {
    const bool is_main = &difference == &comparison.differences.front();
    json.begin_object(is_main ? "difference" : "difference_" + difference.second);
    add_difference(json, difference);
    json.end_object();
  }
  return json.text();
}

}  // namespace vesica::io
