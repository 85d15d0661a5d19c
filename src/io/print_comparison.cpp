#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "io/numbers.hpp"
#include "vesica/compare/comparison.hpp"

namespace vesica::io {
namespace {

constexpr int label_width = 26;
constexpr int column_width = 18;

/// A table with a column for each run; its rows are numbers of the verdicts.
class SideBySide {
 public:
  explicit SideBySide(const compare::Comparison& comparison) : comparison_(comparison) {
    text_ = fmt::format("{:{}}", "", label_width);
    for (const compare::ComparedRun& run : comparison.runs) {
      text_ += cell(run.name);
      numbers_.push_back(numbers_of(run.verdict));
    }
    text_ += '\n';
  }

  /// A row, unless no run has such a number.
  void add(std::string_view label, std::string_view path, std::string_view format) {
    for (std::size_t row = 0; row < numbers_.front().size(); ++row)
      if (numbers_.front()[row].path == path) add_row(label, row, format);
  }
  /// A row for each number of a group; `label` stands before the first name.
  void add_group(std::string_view label, std::string_view group, std::string_view format) {
    bool is_first = true;
    for (std::size_t row = 0; row < numbers_.front().size(); ++row) {
      const Number& number = numbers_.front()[row];
      if (!number.is_in(group)) continue;
      const std::string name = number.name() == "total" ? "" : number.name();
      add_row(fmt::format("{} {}", is_first ? label : " ", name), row, format);
      is_first = false;
    }
  }
  void add_text(std::string_view label,
                const std::function<std::string(const compare::ComparedRun&)>& text) {
    std::vector<std::string> cells;
    for (const compare::ComparedRun& run : comparison_.runs) cells.push_back(text(run));
    add_cells(label, cells);
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  static std::string cell(std::string_view value) {
    return fmt::format("{:>{}}", value, column_width);
  }
  void add_row(std::string_view label, std::size_t row, std::string_view format) {
    std::vector<std::string> cells;
    for (const std::vector<Number>& numbers : numbers_) {
      const double value = numbers[row].value;
      cells.push_back(std::isnan(value) ? "" : fmt::format(fmt::runtime(format), value));
    }
    add_cells(label, cells);
  }
  void add_cells(std::string_view label, const std::vector<std::string>& cells) {
    std::string line = fmt::format("  {:<{}}", label, label_width - 2);
    bool is_empty = true;
    for (const std::string& value : cells) {
      is_empty = is_empty && value.empty();
      line += cell(value.empty() ? "-" : value);
    }
    if (!is_empty) text_ += line + '\n';
  }

  const compare::Comparison& comparison_;
  std::vector<std::vector<Number>> numbers_;  ///< of each run
  std::string text_;
};

std::string domains_text(const compare::ComparedRun& run) {
  const measure::ShapeNumbers& shape = run.verdict.shape;
  if (!shape.domains_1) return "";
  return fmt::format("{} + {}", *shape.domains_1, shape.domains_2.value_or(0));
}

std::string optional_text(std::string_view name, const std::optional<double>& value) {
  return value ? fmt::format(", {} {:.2e}", name, *value) : "";
}

std::string difference_text(const compare::Difference& difference) {
  std::string text =
      fmt::format("{} - {}{}: energy {:.3e} (relative {:.2e})", difference.second, difference.first,
                  difference.is_on_common_mesh ? ", both polished on the nodes of the first" : "",
                  difference.energy, difference.relative_energy);
  model::PerConstraint::fields(
      difference.multipliers, [&](const Field& field, const std::optional<double>& lambda) {
        text += optional_text(fmt::format("multiplier {}", field.name), lambda);
      });
  return text +
         fmt::format("\n  shapes {:.2e} R_c in L2, {:.2e} R_c Hausdorff", difference.shape.l2,
                     difference.shape.hausdorff) +
         optional_text("phase fields", difference.shape.phase_l2) +
         fmt::format("\n{}\n", difference.conclusion);
}

}  // namespace

void print_comparison(std::ostream& out, const compare::Comparison& comparison) {
  SideBySide table(comparison);
  table.add_text("status", [](const compare::ComparedRun& run) {
    return std::string(name_of(run.verdict.outcome.status));
  });
  table.add_text("method", [](const compare::ComparedRun& run) { return run.verdict.method; });
  table.add_group("energy", "energy", "{:.10g}");
  table.add_group("multiplier", "multipliers", "{:.9g}");
  table.add_group("constraint error", "constraints", "{:.1e}");
  table.add_group("shape", "shape", "{:.6g}");
  table.add_text("domains, phase 1 + 2", domains_text);
  table.add("nodes", "mesh/nodes", "{}");
  table.add("mesh quality", "mesh/quality", "{:.3f}");
  table.add("seconds", "seconds/total", "{:.2f}");
  table.add("  processor", "seconds/processor", "{:.2f}");
  table.add("steps", "counts/steps", "{}");
  table.add("evaluations", "counts/residuals", "{}");
  table.add("factorisations", "counts/factorisations", "{}");
  out << table.text();
  for (const compare::Difference& difference : comparison.differences)
    out << '\n' << difference_text(difference);
  out << std::flush;
}

}  // namespace vesica::io
