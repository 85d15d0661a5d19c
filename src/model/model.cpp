#include "vesica/model/model.hpp"

#include <algorithm>
#include <limits>

namespace vesica::model {
namespace {

/// Collects the schedules among the fields of the material.
struct CollectSchedules {
  std::vector<NamedSchedule>& result;

  void operator()(const Field& field, const Schedule& schedule) const {
    result.push_back({"material", field.name, schedule});
  }
  void operator()(const Field& field, const PhaseSchedules& pair) const {
    (*this)(field, pair.phase_1);
    (*this)(field, pair.phase_2);
  }
  void operator()(const Field&, const std::optional<double>&) const {}
};

struct TakeValue {
  double time;
  void operator()(const Field&, Schedule& schedule) const { schedule = schedule.value(time); }
  void operator()(const Field&, PhaseSchedules& pair) const {
    pair = {pair.phase_1.value(time), pair.phase_2.value(time)};
  }
  void operator()(const Field&, const std::optional<double>&) const {}
};

}  // namespace

std::vector<NamedSchedule> schedules_of(const Model& model) {
  std::vector<NamedSchedule> result;
  MaterialOptions::fields(model.material, CollectSchedules{result});
  for_each_term<Constraints>([&]<class Constraint>(std::size_t) {
    const auto& target = model.targets.of<Constraint>();
    if (target) result.push_back({"constraints", Constraint::key, *target});
  });
  return result;
}

Physics Model::at(double time) const {
  Physics physics{material.at(time), is_two_phase};
  for (std::size_t place = 0; place < targets.values.size(); ++place)
    physics.is_free[place] = !targets[place];
  return physics;
}

double Model::next_kink(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const auto& named : schedules_of(*this))
    next = std::min(next, named.schedule.next_kink(time));
  return next;
}

bool Model::jumps_at(double time) const {
  const auto schedules = schedules_of(*this);
  return std::any_of(schedules.begin(), schedules.end(),
                     [&](const auto& named) { return named.schedule.jumps_at(time); });
}

double Model::rests_after() const {
  double last = -std::numeric_limits<double>::infinity();
  for (const auto& named : schedules_of(*this)) last = std::max(last, named.schedule.rests_after());
  return last;
}

Model Model::frozen(double time) const {
  Model result = *this;
  MaterialOptions::fields(result.material, TakeValue{time});
  for (auto& target : result.targets.values) {
    if (target) target = Schedule(target->value(time));
  }
  return result;
}

}  // namespace vesica::model
