#include "io/result_json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "vesica/core/error.hpp"
#include "vesica/io/comparison_files.hpp"
#include "vesica/io/verdict_files.hpp"

namespace vesica::io {
namespace {

using Json = nlohmann::ordered_json;
using measure::PhaseDomain;

std::string pointer_text(std::string_view name) {
  return name.empty() ? "" : fmt::format("/{}", name);
}

/// Path of the numbers `field` of the domains of one phase, "/areas/phase_1".
std::string domain_pointer(const Field& field, int phase) {
  return fmt::format("/{}s/phase_{}", field.name, phase);
}

/// Visits the numbers of a domain that stand in `verdict.json`.
template <class Domain, class Visit>
void visit_numbers(Domain& domain, const Visit& visit) {
  PhaseDomain::fields(domain, [&]<class T>(const Field& field, T& value) {
    if constexpr (std::is_same_v<std::remove_const_t<T>, double>) visit(field, value);
  });
}

/// Writes the fields of a result into a JSON object.
class Writer {
 public:
  explicit Writer(Json& object) : object_(object) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    write(object_[Json::json_pointer(pointer_text(field.name))], value);
  }

 private:
  template <class T>
  static void write(Json& place, const T& value) {
    if constexpr (HasFields<T>) {
      T::fields(value, Writer(place));
    } else if constexpr (std::is_enum_v<T>) {
      place = name_of(value);
    } else {
      place = value;
    }
  }
  /// What is absent is null, in a struct each of its numbers.
  template <class T>
  static void write(Json& place, const std::optional<T>& value) {
    place = nullptr;
    if (value) return write(place, *value);
    if constexpr (HasFields<T>) {
      write(place, T{});
      for (Json& number : place) number = nullptr;
    }
  }
  template <class T>
  static void write(Json& place, const std::vector<T>& list) {
    place = Json::array();
    for (const T& value : list) write(place.emplace_back(), value);
  }
  /// How many there were; when and why stands in the trajectory.
  static void write(Json& place, const std::vector<relax::MeshChange>& changes) {
    place = changes.size();
  }
  /// An array for each number and phase.
  static void write(Json& place, const std::vector<PhaseDomain>& domains) {
    const auto array = [&](const Field& field, int phase) -> Json& {
      return place[Json::json_pointer(domain_pointer(field, phase))];
    };
    const PhaseDomain none;
    for (const int phase : {1, 2})
      visit_numbers(none, [&](const Field& field, double) { array(field, phase) = Json::array(); });
    for (const PhaseDomain& domain : domains) {
      visit_numbers(domain, [&](const Field& field, double value) {
        array(field, domain.phase).push_back(value);
      });
    }
  }

  Json& object_;
};

/// Reads the fields of a result from a JSON file. Values are named by their JSON pointers.
class Reader {
 public:
  Reader(const std::filesystem::path& file, const Json& root, std::string object = "")
      : file_(file), root_(root), object_(std::move(object)) {}

  template <class T>
  void operator()(const Field& field, T& value) const {
    read(object_ + pointer_text(field.name), value);
  }
  /// A computed number.
  template <class T>
  void operator()(const Field&, const T&&) const {}

 private:
  template <class T>
  void read(const std::string& pointer, T& value) const {
    if constexpr (HasFields<T>) {
      T::fields(value, Reader(file_, root_, pointer));
    } else if constexpr (std::is_enum_v<T>) {
      const auto name = get<std::string>(pointer, &Json::is_string, "must be a text");
      for (const auto& [candidate, known] : EnumNames<T>::names)
        if (name == known) return void(value = candidate);
      refuse(pointer, fmt::format("\"{}\" is not known", name));
    } else if constexpr (std::is_same_v<T, std::string>) {
      value = get<T>(pointer, &Json::is_string, "must be a text");
    } else if constexpr (std::is_integral_v<T>) {
      value = whole_number<T>(pointer);
    } else {
      value = at(pointer).is_null()  // a number that is not finite
                  ? std::numeric_limits<T>::quiet_NaN()
                  : get<T>(pointer, &Json::is_number, "must be a number or null");
    }
  }
  template <class T>
  void read(const std::string& pointer, std::optional<T>& value) const {
    value.reset();
    if (!root_.contains(Json::json_pointer(pointer))) return;  // an older version wrote the file
    const Json flat = at(pointer).flatten();
    if (std::any_of(flat.begin(), flat.end(), [](const Json& leaf) { return !leaf.is_null(); }))
      read(pointer, value.emplace());
  }
  template <class T>
  void read(const std::string& pointer, std::vector<T>& list) const {
    list.resize(size(pointer));
    for (std::size_t i = 0; i < list.size(); ++i) read(fmt::format("{}/{}", pointer, i), list[i]);
  }
  void read(const std::string& pointer, std::vector<relax::MeshChange>& changes) const {
    constexpr std::int32_t most = 1'000'000;
    const auto count = whole_number<std::int32_t>(pointer);
    if (count > most) refuse(pointer, fmt::format("must be at most {}", most));
    changes.resize(static_cast<std::size_t>(count));
  }
  void read(const std::string& pointer, std::vector<PhaseDomain>& domains) const {
    domains.clear();
    const PhaseDomain none;
    for (const int phase : {1, 2}) {
      const auto first = domains.size();
      visit_numbers(none, [&](const Field& field, double) {
        domains.resize(first + size(pointer + domain_pointer(field, phase)));
      });
      for (std::size_t i = first; i < domains.size(); ++i) {
        domains[i].phase = phase;
        visit_numbers(domains[i], [&](const Field& field, double& value) {
          read(fmt::format("{}{}/{}", pointer, domain_pointer(field, phase), i - first), value);
        });
      }
    }
  }

  [[nodiscard]] const Json& at(const std::string& pointer) const {
    const Json::json_pointer place(pointer);
    if (!root_.contains(place)) refuse(pointer, "is missing");
    return root_.at(place);
  }
  template <class T>
  [[nodiscard]] T get(const std::string& pointer, bool (Json::*is_right)() const noexcept,
                      std::string_view rule) const {
    const Json& value = at(pointer);
    if (!(value.*is_right)()) refuse(pointer, rule);
    return value.get<T>();
  }
  /// All of a verdict are counts.
  template <class T>
  [[nodiscard]] T whole_number(const std::string& pointer) const {
    const auto value =
        get<std::int64_t>(pointer, &Json::is_number_integer, "must be a whole number");
    if (value < 0 || value > static_cast<std::int64_t>(std::numeric_limits<T>::max()))
      refuse(pointer, fmt::format("must be from 0 to {}", std::numeric_limits<T>::max()));
    return static_cast<T>(value);
  }
  [[nodiscard]] std::size_t size(const std::string& pointer) const {
    if (!at(pointer).is_array()) refuse(pointer, "must be an array");
    return at(pointer).size();
  }
  [[noreturn]] void refuse(const std::string& pointer, std::string_view rule) const {
    throw IoError(fmt::format("{}: {} {}", file_.string(), pointer, rule));
  }

  const std::filesystem::path& file_;
  const Json& root_;
  std::string object_;
};

/// Numbers that are not finite are null; bytes that are no UTF-8, as in names of folders, are
/// replaced.
std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

Json parsed(const std::filesystem::path& path, std::string_view text) {
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    throw IoError(fmt::format("{}: is no JSON: {}", path.string(), error.what()));
  }
}

}  // namespace

std::string to_json(const relax::Verdict& verdict) {
  Json json;
  relax::Verdict::fields(verdict, Writer(json));
  return text_of(json);
}

std::string to_json(const compare::Comparison& comparison) {
  Json json;
  for (const compare::ComparedRun& run : comparison.runs) {
    json[run.name]["folder"] = run.folder.string();
    relax::Verdict::fields(run.verdict, Writer(json[run.name]));
  }
  for (const compare::Difference& difference : comparison.differences) {
    const bool is_main = &difference == &comparison.differences.front();
    compare::Difference::fields(
        difference, Writer(json[is_main ? "difference" : "difference_" + difference.second]));
  }
  return text_of(json);
}

relax::Verdict read_verdict(const std::filesystem::path& file, std::string_view text) {
  const Json json = parsed(file, text);
  relax::Verdict verdict;
  relax::Verdict::fields(verdict, Reader(file, json));
  relax::Outcome& outcome = verdict.outcome;
  outcome.report.time = verdict.time;
  outcome.diagnostics.velocity = verdict.velocity.over(1 / verdict.shape.characteristic_radius);
  // A run whose polish fails does not end as converged.
  if (outcome.report.polish) outcome.report.polish->is_converged = true;
  return verdict;
}

}  // namespace vesica::io
