#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <utility>

#include "vesica/compare/comparison.hpp"

namespace vesica::io {
namespace {

constexpr int label_width = 26;
constexpr int column_width = 18;

/// A table with a column for each run.
class SideBySide {
 public:
  explicit SideBySide(const compare::Comparison& comparison) : comparison_(comparison) {
    text_ = fmt::format("{:{}}", "", label_width);
    for (const compare::ComparedRun& run : comparison.runs) text_ += cell(run.name);
    text_ += '\n';
  }

  using Number = std::function<std::optional<double>(const compare::ComparedRun&)>;

  /// A row, unless no run has such a number.
  SideBySide& add(std::string_view label, std::string_view format, const Number& number) {
    return add_text(label, [&](const compare::ComparedRun& run) {
      const std::optional<double> value = number(run);
      return value && !std::isnan(*value) ? fmt::format(fmt::runtime(format), *value) : "";
    });
  }
  SideBySide& add_text(std::string_view label,
                       const std::function<std::string(const compare::ComparedRun&)>& text) {
    std::string line = fmt::format("  {:<{}}", label, label_width - 2);
    bool is_empty = true;
    for (const compare::ComparedRun& run : comparison_.runs) {
      const std::string value = text(run);
      is_empty = is_empty && value.empty();
      line += cell(value.empty() ? "-" : value);
    }
    if (!is_empty) text_ += line + '\n';
    return *this;
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static std::string cell(std::string_view value) {
    return fmt::format("{:>{}}", value, column_width);
  }

  const compare::Comparison& comparison_;
  std::string text_;
};

void add_energies(SideBySide& table) {
  const auto energy = [](const compare::ComparedRun& run) -> const model::EnergyParts& {
    return run.verdict.outcome.diagnostics.energy;
  };
  table.add("energy", "{:.10g}", [=](const auto& run) { return energy(run).total(); })
      .add("  bending", "{:.10g}",
           [=](const auto& run) {
             return energy(run)[model::place_of<model::Energies, model::BendingEnergy>];
           })
      .add("  gaussian", "{:.10g}",
           [=](const auto& run) {
             return energy(run)[model::place_of<model::Energies, model::GaussianEnergy>];
           })
      .add("  line", "{:.10g}", [=](const auto& run) {
        return energy(run)[model::place_of<model::Energies, model::LineEnergy>];
      });
}

void add_constraints(SideBySide& table) {
  const auto lambda = [](const compare::ComparedRun& run) { return run.verdict.multipliers; };
  const auto error = [](const compare::ComparedRun& run) {
    return run.verdict.outcome.diagnostics.constraint_errors;
  };
  table
      .add("multiplier volume", "{:.9g}",
           [=](const auto& run) {
             return lambda(run)[model::place_of<model::Constraints, model::Volume>];
           })
      .add("  area", "{:.9g}",
           [=](const auto& run) {
             return lambda(run)[model::place_of<model::Constraints, model::Area>];
           })
      .add("  phase", "{:.9g}",
           [=](const auto& run) {
             return lambda(run)[model::place_of<model::Constraints, model::PhaseDifference>];
           })
      .add("constraint error volume", "{:.1e}",
           [=](const auto& run) {
             return error(run)[model::place_of<model::Constraints, model::Volume>];
           })
      .add("  area", "{:.1e}",
           [=](const auto& run) {
             return error(run)[model::place_of<model::Constraints, model::Area>];
           })
      .add("  phase", "{:.1e}", [=](const auto& run) {
        return error(run)[model::place_of<model::Constraints, model::PhaseDifference>];
      });
}

void add_shapes(SideBySide& table) {
  const auto shape = [](const compare::ComparedRun& run) -> const measure::ShapeNumbers& {
    return run.verdict.shape;
  };
  table.add("reduced volume", "{:.6g}", [=](const auto& run) { return shape(run).reduced_volume; })
      .add("phase fraction", "{:.6g}", [=](const auto& run) { return shape(run).phase_fraction; })
      .add("reduced line tension", "{:.6g}",
           [=](const auto& run) { return shape(run).reduced_line_tension; })
      .add("rigidity ratio", "{:.6g}", [=](const auto& run) { return shape(run).rigidity_ratio; })
      .add("saddle-splay difference", "{:.6g}",
           [=](const auto& run) { return shape(run).saddle_splay_difference; })
      .add("neck radius", "{:.6g}", [=](const auto& run) { return shape(run).neck_radius; })
      .add("length", "{:.6g}", [=](const auto& run) { return shape(run).length; })
      .add_text("domains, phase 1 + 2", [=](const compare::ComparedRun& run) {
        const measure::ShapeNumbers& numbers = shape(run);
        return numbers.domains_1
                   ? fmt::format("{} + {}", *numbers.domains_1, numbers.domains_2.value_or(0))
                   : "";
      });
}

void add_work(SideBySide& table) {
  const auto report = [](const compare::ComparedRun& run) -> const solve::StepReport& {
    return run.verdict.outcome.report;
  };
  const auto count = [&](std::string_view label, long solve::SolverCounts::*member) {
    table.add_text(label, [=](const compare::ComparedRun& run) {
      return fmt::format("{}", report(run).counts.*member);
    });
  };
  table.add_text("nodes", [](const compare::ComparedRun& run) {
    return fmt::format("{}", run.verdict.num_nodes);
  });
  table.add("mesh quality", "{:.3f}",
            [](const auto& run) { return run.verdict.outcome.diagnostics.quality; });
  table.add("seconds", "{:.2f}", [=](const auto& run) { return report(run).seconds.total; });
  table.add("  processor", "{:.2f}",
            [=](const auto& run) { return report(run).seconds.processor; });
  count("steps", &solve::SolverCounts::steps);
  count("evaluations", &solve::SolverCounts::residuals);
  count("factorisations", &solve::SolverCounts::factorisations);
}

std::string optional_text(std::string_view name, const std::optional<double>& value) {
  return value ? fmt::format(", {} {:.2e}", name, *value) : "";
}

std::string difference_text(const compare::Difference& difference) {
  const model::PerConstraint& lambda = difference.multipliers;
  return fmt::format(
             "{} - {}{}: energy {:.3e} (relative {:.2e})", difference.second, difference.first,
             difference.is_on_common_mesh ? ", both polished on the nodes of the first" : "",
             difference.energy, difference.relative_energy) +
         optional_text("lambda_V", lambda.of<model::Volume>()) +
         optional_text("lambda_A", lambda.of<model::Area>()) +
         optional_text("lambda_c", lambda.of<model::PhaseDifference>()) +
         fmt::format("\n  shapes {:.2e} R_c in L2, {:.2e} R_c Hausdorff", difference.shape.l2,
                     difference.shape.hausdorff) +
         optional_text("phase fields", difference.shape.phase_l2) +
         fmt::format("\n{}\n", difference.conclusion);
}

}  // namespace

void print_comparison(std::ostream& out, const compare::Comparison& comparison) {
  SideBySide table(comparison);
  table.add_text("status", [](const compare::ComparedRun& run) {
    return std::string(relax::status_name(run.verdict.outcome.status));
  });
  table.add_text("method", [](const compare::ComparedRun& run) { return run.verdict.method; });
  add_energies(table);
  add_constraints(table);
  add_shapes(table);
  add_work(table);
  out << table.text();
  for (const compare::Difference& difference : comparison.differences)
    out << '\n' << difference_text(difference);
  out << std::flush;
}

}  // namespace vesica::io
