#pragma once

#include <array>
#include <optional>
#include <vector>

#include "vesica/measure/phase_domains.hpp"
#include "vesica/model/schedule.hpp"
#include "vesica/relax/observer.hpp"

namespace vesica::relax {

/// Tells when the number of domains of a phase changes. Specks do not count: a domain is one of at
/// least the area of a disc whose diameter is the interface width. A change is an event when the
/// new number holds for three steps in a row, or until the run ends; the event has step and time of
/// the first of them.
class DomainWatch {
 public:
  explicit DomainWatch(model::Schedule interface_width);

  /// Looks at the domains and returns the events that are certain now. To be called at the start
  /// and after every step.
  [[nodiscard]] std::vector<Event> look(const StepView& view);
  /// Returns the changes that have not lasted for three steps. To be called once, at the end.
  [[nodiscard]] std::vector<Event> finish() const;

 private:
  /// A number of domains that may be the new one.
  struct Change {
    int number = 0;
    long step = 0;
    double time = 0;
    int lasted = 0;  ///< steps
  };
  struct Phase {
    std::optional<int> number;  ///< absent before the start
    std::optional<Change> change;
  };

  void look(Phase& phase, int number, const StepView& view);
  [[nodiscard]] Event event(std::size_t index) const;

  model::Schedule interface_width_;
  std::array<Phase, 2> phases_;
};

}  // namespace vesica::relax
