#include "io/record/time_series.hpp"

#include <array>

namespace vesica::io {
namespace {

struct Row {
  const problem::State& state;
  const solve::StepReport& report;
  const measure::Diagnostics& diagnostics;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit(Field{"time", "time", "time reached"}, self.state.time);
    visit(Field{"step_size", "time", "size of the step"}, self.report.step_size);
    visit(Field{"order", "-", "order of the method"}, self.report.order);
    visit(Field{"damping", "length^2/energy", "alpha"}, self.state.damping);
    visit(Field{"multipliers", "-", "signs as in (1.7a)"}, self.state.values.multipliers);
    visit(Field{"", "-", "measured after the step"}, self.diagnostics);
    visit(Field{"", "length/time", "velocities over R_c"},
          self.diagnostics.velocity.over(self.diagnostics.characteristic_radius()));
    visit(Field{"counts", "-", "work since the start"}, self.report.counts);
    visit(Field{"seconds", "second", "time since the start"}, self.report.seconds);
  }
};

/// What stands in a column's name for the group of the number in `verdict.json`.
struct Prefix {
  std::string_view group;
  std::string_view prefix;
};
constexpr std::array prefixes{Prefix{"energy/", "energy_"},
                              Prefix{"multipliers/", "multiplier_"},
                              Prefix{"constraints/", "constraint_error_"},
                              Prefix{"shape/", ""},
                              Prefix{"mesh/", ""},
                              Prefix{"counts/steps", "step"},
                              Prefix{"counts/", ""},
                              Prefix{"seconds/", "seconds_"}};

}  // namespace

std::vector<Number> series_row(const relax::StepView& view) {
  std::vector<Number> row = numbers_of(Row{view.state, view.report, view.diagnostics});
  for (Number& number : row) {
    for (const auto& [group, prefix] : prefixes)
      if (number.path.starts_with(group)) number.path.replace(0, group.size(), prefix);
  }
  return row;
}

}  // namespace vesica::io
