#include "vesica/io/progress.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <ostream>

namespace vesica::io {
namespace {

constexpr long sparse_steps = 10;
constexpr double sparse_seconds = 5;

double largest_error(const model::PerConstraint& errors) {
  double largest = 0;
  for (const auto& error : errors.values) largest = std::max(largest, std::abs(error.value_or(0)));
  return largest;
}

}  // namespace

std::string progress_line(const relax::StepView& view) {
  const measure::Diagnostics& measured = view.diagnostics;
  if (view.report.gradient) {
    return fmt::format("step {}  evaluations {}  F {:.6f}  distance {:.1e}  C {:.1e}  q {:.3f}",
                       view.report.counts.steps, view.report.counts.residuals,
                       measured.energy.total(), *view.report.gradient,
                       largest_error(measured.constraint_errors), measured.quality);
  }
  return fmt::format(
      "step {}  t {:.4g}  dt {:.1e}  order {}  F {:.6f}  v {:.1e}  C {:.1e}  q {:.3f}",
      view.report.counts.steps, view.state.time, view.report.step_size, view.report.order,
      measured.energy.total(),
      measured.velocity.normal_rigid_free / measured.characteristic_radius(),
      largest_error(measured.constraint_errors), measured.quality);
}

std::string event_line(const relax::Event& event) {
  return fmt::format("step {}  t {:.4g}  {}", event.step, event.time, event.what);
}

bool Progress::is_due(const relax::StepView& view) const {
  return is_first_ || style_ == ProgressStyle::rewriting ||
         view.report.counts.steps - last_step_ >= sparse_steps ||
         view.report.seconds.total - last_seconds_ >= sparse_seconds;
}

void Progress::write(const relax::StepView& view) {
  if (style_ == ProgressStyle::rewriting) {
    out_ << '\r' << progress_line(view) << "\x1b[K" << std::flush;
  } else {
    out_ << progress_line(view) << std::endl;
  }
  is_first_ = false;
  last_step_ = view.report.counts.steps;
  last_seconds_ = view.report.seconds.total;
}

void Progress::observe(const relax::StepView& view) {
  if (style_ != ProgressStyle::none && is_due(view)) write(view);
}

void Progress::happened(const relax::StepView&, const relax::Event& event) {
  if (style_ == ProgressStyle::none) return;
  if (style_ == ProgressStyle::rewriting) out_ << '\r';
  out_ << event_line(event) << (style_ == ProgressStyle::rewriting ? "\x1b[K" : "") << std::endl;
}

void Progress::finish(const relax::StepView& view, const relax::Outcome&) {
  if (style_ == ProgressStyle::none) return;
  if (style_ == ProgressStyle::rewriting || view.report.counts.steps != last_step_ || is_first_)
    write(view);
  if (style_ == ProgressStyle::rewriting) out_ << std::endl;
}

}  // namespace vesica::io
