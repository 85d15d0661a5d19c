#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "vesica/io/comparison_files.hpp"

namespace vesica::io {
namespace {

// Runs differ by their dashes and widths, phases and energies by their colours. A thin dark line
// lies on a broad pale one, so both are seen where they agree.
struct Style {
  int dashes;
  double width;
  const char* phase_1;
  const char* phase_2;
  const char* energy;
};
constexpr std::array<Style, 3> styles{{{1, 6, "#f4a582", "#92c5de", "#1b7837"},
                                       {1, 1.8, "#b2182b", "#2166ac", "#762a83"},
                                       {2, 1.8, "#4d0000", "#001a4d", "#e08214"}}};

const Style& style_of(std::size_t run) { return styles[std::min(run, styles.size() - 1)]; }

std::string escaped(std::string text) {  // gnuplot's enhanced text takes _ for a subscript
  for (std::size_t at = 0; (at = text.find('_', at)) != std::string::npos; ++at) text[at] = ' ';
  return text;
}

std::string joined(const std::vector<std::string>& parts) {
  return fmt::format("plot {}\n", fmt::join(parts, ", \\\n     "));
}

std::string profile_curve(const compare::ComparedRun& run, std::size_t index, bool is_phase_1) {
  const Style& style = style_of(index);
  const bool is_two_phase = run.state.is_two_phase();
  const char* condition = is_phase_1 ? ">=" : "<=";
  const char* phase = !is_two_phase ? "" : is_phase_1 ? ", c > 0" : ", c < 0";
  return fmt::format(
      "'profile_{}.csv' using 2:($4 {} 0 ? $3 : NaN) with lines lw {} dt {} lc rgb '{}' title "
      "'{}{}'",
      run.name, condition, style.width, style.dashes, is_phase_1 ? style.phase_1 : style.phase_2,
      escaped(run.name), phase);
}

std::string profiles_script(const compare::Comparison& comparison) {
  std::vector<std::string> curves;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    curves.push_back(profile_curve(comparison.runs[i], i, true));
    if (comparison.runs[i].state.is_two_phase())
      curves.push_back(profile_curve(comparison.runs[i], i, false));
  }
  return "set terminal pngcairo size 1200,700 font 'sans,14' background rgb 'white'\n"
         "set output 'profiles.png'\n"
         "set title 'Cut through the long axis'\n"
         "set xlabel 'along the axis'\n"
         "set ylabel 'across it'\n"
         "set size ratio -1\n"
         "set offsets graph 0.04, graph 0.04, graph 0.06, graph 0.06\n" +
         joined(curves) + "set size noratio\nset offsets\n";
}

/// False for a run that could not even begin.
bool has_energies(const compare::ComparedRun& run) {
  return !run.history.energy.empty() && std::isfinite(run.history.energy.back());
}

/// Of the final ones: on the way a state may lie lower while it misses its constraints.
double lowest_energy(const compare::Comparison& comparison) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const compare::ComparedRun& run : comparison.runs)
    if (has_energies(run)) lowest = std::min(lowest, run.history.energy.back());
  return lowest;
}

/// Above, the energies; below, on a logarithmic scale, what they are above the lowest one at the
/// end.
std::string energy_script(const compare::Comparison& comparison) {
  const double lowest = lowest_energy(comparison);
  std::vector<std::string> totals;
  std::vector<std::string> excesses;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const compare::ComparedRun& run = comparison.runs[i];
    if (!has_energies(run)) continue;
    const std::string line =
        fmt::format("with linespoints pt 7 ps 0.5 lw 1.8 dt {} lc rgb '{}' title '{}'",
                    style_of(i).dashes, style_of(i).energy, escaped(run.name));
    totals.push_back(fmt::format("'energy_{}.csv' using 2:3 {}", run.name, line));
    excesses.push_back(fmt::format("'energy_{}.csv' using 2:($3 > lowest ? $3 - lowest : NaN) {}",
                                   run.name, line));
  }
  if (totals.empty()) return "";
  return fmt::format(
             "set terminal pngcairo size 1200,900 font 'sans,14' background rgb 'white'\n"
             "set output 'energy.png'\n"
             "lowest = {}\n"
             "set multiplot layout 2,1 title 'Energy against processor seconds'\n"
             "set title\nset xlabel\nset bmargin\nset logscale x\nunset key\n"
             "set ylabel 'energy'\n",
             lowest) +
         joined(totals) +
         "set key outside bottom center horizontal\nset xlabel 'seconds'\n"
         "set ylabel 'energy - lowest at the end'\nset logscale y\nset format y '10^{%T}'\n" +
         joined(excesses) + "unset multiplot\n";
}

}  // namespace

std::string plot_script(const compare::Comparison& comparison) {
  return "# Draws profiles.png and energy.png: gnuplot comparison.gp\n"
         "set datafile separator ','\n"
         "set key at screen 0.5, screen 0.02 center bottom horizontal\n"
         "set bmargin 5.5\n"
         "set grid lt 1 lw 0.5 lc rgb '#cccccc'\n" +
         profiles_script(comparison) + energy_script(comparison);
}

}  // namespace vesica::io
