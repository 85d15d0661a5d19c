#pragma once

#include <ctime>

namespace vesica::relax {

/// Adds the processor seconds, of all threads, of its lifetime to a total.
class ProcessorTimer {
 public:
  explicit ProcessorTimer(double& total) : total_(total) {}
  ProcessorTimer(const ProcessorTimer&) = delete;
  ProcessorTimer& operator=(const ProcessorTimer&) = delete;
  ~ProcessorTimer() { total_ += static_cast<double>(std::clock() - start_) / CLOCKS_PER_SEC; }

 private:
  double& total_;
  std::clock_t start_ = std::clock();
};

}  // namespace vesica::relax
