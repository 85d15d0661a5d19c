#include "vesica/relax/interrupt_controller.hpp"

#include <fmt/format.h>

#include <cstring>
#include <string>

namespace vesica::relax {
namespace {

std::string name_of_signal(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name == nullptr ? fmt::format("signal {}", signal) : fmt::format("SIG{}", name);
}

}  // namespace

std::vector<Request> InterruptController::respond(const StepView& view) {
  const int signal = signal_.load();
  if (signal == 0) return {};
  return {Stop{
      RunStatus::interrupted,
      fmt::format("{} received after step {}", name_of_signal(signal), view.report.counts.steps),
      signal}};
}

std::vector<Request> InterruptController::respond_to_failure(const StepView& view) {
  return respond(view);
}

}  // namespace vesica::relax
