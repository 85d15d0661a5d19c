#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <ostream>
#include <string>

#include "io/numbers.hpp"
#include "vesica/io/verdict_files.hpp"

namespace vesica::io {
namespace {

/// How a number is printed whose name or format is not that of its row; no format: not at all.
struct Look {
  std::string_view path;
  std::string_view label;
  std::string_view format;
};
constexpr std::array looks{Look{"shape/reduced_volume", "v_r", "{:.5g}"},
                           Look{"shape/phase_fraction", "x_r", "{:.5g}"},
                           Look{"shape/reduced_line_tension", "line tension", "{:.5g}"},
                           Look{"shape/rigidity_ratio", "b_r", "{:.5g}"},
                           Look{"shape/saddle_splay_difference", "Delta_g", "{:.5g}"},
                           Look{"domains/phase_1", "phase 1:", "{}"},
                           Look{"domains/phase_2", "phase 2:", "{}"},
                           Look{"mesh/quality_initial", "at the start", "{:.3f}"},
                           Look{"mesh/quality_smallest", "smallest", "{:.3f}"},
                           Look{"mesh/area_ratio", "area ratio", "{:.3g}"},
                           Look{"mesh/smallest_normal_cosine", "", ""},
                           Look{"mesh/adaptions", "", ""},
                           Look{"counts/newton", "Newton", "{}"},
                           Look{"counts/krylov", "Krylov", "{}"},
                           Look{"counts/jacobians", "Jacobians", "{}"},
                           Look{"seconds/total", "", "{:.2f}"},
                           Look{"seconds/jacobian", "Jacobian", "{:.2f}"}};

/// "name value, name value, ..." of the values that exist.
class Row {
 public:
  explicit Row(std::string_view title) : text_(fmt::format("  {:<18}", title)) {}

  Row& add(std::string_view name, double value, std::string_view format) {
    if (std::isnan(value)) return *this;
    text_ += fmt::format("{}{}{}", is_empty_ ? "" : ", ", name, name.empty() ? "" : " ");
    text_ += fmt::format(fmt::runtime(format), value);
    is_empty_ = false;
    return *this;
  }
  [[nodiscard]] std::string text() const { return is_empty_ ? "" : text_ + "\n"; }

 private:
  std::string text_;
  bool is_empty_ = true;
};

/// All numbers of a group, counts as whole numbers.
class Table {
 public:
  explicit Table(const relax::Verdict& verdict) : numbers_(numbers_of(verdict)) {}

  [[nodiscard]] Row row(
      std::string_view title, std::string_view group, std::string_view format,
      bool (*is_wanted)(const Number&) = [](const Number&) { return true; }) const {
    Row row(title);
    for (const Number& number : numbers_) {
      if (!number.is_in(group) || !is_wanted(number)) continue;
      const auto* const look = std::find_if(
          looks.begin(), looks.end(), [&](const Look& known) { return known.path == number.path; });
      if (look == looks.end()) {
        row.add(number.name(), number.value, number.is_count ? "{}" : format);
      } else if (!look->format.empty()) {
        row.add(look->label, number.value, look->format);
      }
    }
    return row;
  }

 private:
  std::vector<Number> numbers_;
};

Row velocity_row(const measure::VelocityNorms& velocity) {
  Row row("normal velocity");
  return row.add("", velocity.normal_rigid_free, "{:.2e}")
      .add("with rigid drift", velocity.normal, "{:.2e}");
}

Row polish_row(const std::optional<solve::PolishReport>& polish) {
  Row row("polish");
  if (!polish) return row;
  const double lowest = polish->curvature.value;
  return row.add("iterations", polish->iterations, "{}")
      .add("gradient", polish->gradient, "{:.1e}")
      .add(lowest < 0 ? "a SADDLE: lowest curvature" : "a minimum: lowest curvature", lowest,
           "{:.4g}");
}

std::string tables_of(const relax::Verdict& verdict) {
  const auto is_pure = [](const Number& number) { return number.unit == "-"; };
  const auto has_unit = [](const Number& number) { return number.unit != "-"; };
  const Table table(verdict);
  Row mesh = table.row("mesh", "mesh", "{:.3f}");
  if (verdict.smallest_normal_cosine < 0)
    mesh.add("FOLDED: normal cosine", verdict.smallest_normal_cosine, "{:.2f}");
  std::string text;
  for (const Row& row :
       {table.row("energy", "energy", "{:.8g}"), table.row("multipliers", "multipliers", "{:.8g}"),
        table.row("constraint errors", "constraints", "{:.1e}"),
        table.row("shape", "shape", "{:.8g}", has_unit),
        table.row("reduced numbers", "shape", "{:.5g}", is_pure),
        table.row("domains", "domains", "{}"), velocity_row(verdict.velocity), mesh,
        polish_row(verdict.outcome.report.polish), table.row("work", "counts", "{}"),
        table.row("seconds", "seconds", "{:.2f}")})
    text += row.text();
  return text;
}

}  // namespace

void print_verdict(std::ostream& out, const relax::Verdict& verdict) {
  out << fmt::format("{}: {}\n", name_of(verdict.outcome.status), verdict.outcome.reason)
      << fmt::format("  {:<18}{:.6g}\n", "time", verdict.time) << tables_of(verdict) << std::flush;
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
