#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "surface_samples.hpp"
#include "vesica/config/config.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"
#include "vesica/model/make_model.hpp"
#include "vesica/relax/make_mesh_controller.hpp"
#include "vesica/run/make_stepper.hpp"

namespace vesica {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// The functions of the library that take options.
void use(const shapes::ShapeOptions& options) { (void)shapes::make_shape(options); }
void use(const phase::PhaseOptions& options) {
  (void)phase::initial_phase(options, problem::unit_sphere(1), 0.3, std::nullopt);
}
void use(const model::MaterialOptions& options) { (void)model::resolved_material(options, 1); }
void use(const model::ConstraintOptions& options) { (void)model::make_targets(options, {}, true); }
void use(const solve::SolverOptions& options) { (void)run::make_stepper(options, {}, {}); }
void use(const relax::DampingOptions& options) { (void)relax::DampingController(options, {}); }
void use(const relax::StopOptions& options) { (void)relax::Stationarity(options, {}); }
void use(const relax::AdaptionOptions& options) {
  (void)relax::make_mesh_controller(options, {}, {});
}
void use(const config::OutputOptions& options) {
  config::RunConfig config;
  config.output = options;
  config::check(config);
}

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const ConfigError& error) {
    const std::string_view message = error.what();
    const auto rule = message.rfind(": ");
    return std::string(message.substr(rule + 2));
  }
  return "nothing is refused";
}

// Gives an option a number, in whatever form it has one; false when it has none.
template <class T>
bool assign(T& value, double number) {
  if constexpr (std::is_same_v<T, bool> || std::is_enum_v<T> || std::is_same_v<T, std::string>) {
    return false;
  } else if constexpr (std::is_same_v<T, int>) {
    value = std::isfinite(number) ? static_cast<int>(number) : 0;
    return std::isfinite(number);
  } else if constexpr (std::is_same_v<T, Eigen::Vector3d>) {
    value = {1, number, 1};
  } else if constexpr (std::is_same_v<T, std::vector<Eigen::Vector3d>>) {
    value = {{1, 0, 0}, {0, number, 1}};
  } else if constexpr (std::is_same_v<T, model::PhaseSchedules>) {
    value.phase_2 = number;
  } else if constexpr (std::is_same_v<T, model::Target>) {
    value = {model::TargetKind::prescribed, number};
  } else if constexpr (std::is_same_v<T, solve::TimeStep>) {
    value.value = number;
  } else {
    value = number;
  }
  return true;
}

template <class T>
std::string toml(double number) {
  if constexpr (std::is_same_v<T, int>) return std::to_string(static_cast<int>(number));
  const std::string text = std::isnan(number) ? "nan" : fmt::format("{}", number);
  if constexpr (std::is_same_v<T, Eigen::Vector3d>) return fmt::format("[1, {}, 1]", text);
  if constexpr (std::is_same_v<T, std::vector<Eigen::Vector3d>>)
    return fmt::format("[[1, 0, 0], [0, {}, 1]]", text);
  if constexpr (std::is_same_v<T, model::PhaseSchedules>) return fmt::format("[1, {}]", text);
  return text;
}

// The alternative that uses the field.
template <class Options>
void choose_user(Options& options, const Field& field) {
  if constexpr (std::is_same_v<Options, shapes::ShapeOptions>) {
    for (const auto& [kind, name] : EnumNames<shapes::ShapeKind>::names) {
      if (field.used_by.include(kind)) options.kind = kind;
    }
  }
}

std::vector<double> numbers_that_break(const Rule& rule) {
  std::vector<double> numbers{nan, -infinity};
  if (!rule.allows_infinity) numbers.push_back(infinity);
  if (std::isfinite(rule.least)) numbers.push_back(rule.least - 1);
  if (rule.excludes_least) numbers.push_back(rule.least);
  if (std::isfinite(rule.most)) numbers.push_back(rule.most + 1);
  return numbers;
}

struct CheckEveryField {
  int num_refusals = 0;

  template <class Options>
  void operator()(const config::Table& table, const std::optional<Options>&) {
    (*this)(table, Options{});
  }

  template <class Options>
  void operator()(const config::Table& table, const Options& defaults) {
    Options::fields(defaults, [&]<class T>(const Field& field, const T&) {
      for (const double number : numbers_that_break(field.rule)) {
        Options options;
        bool has_number = false;
        Options::fields(options, [&](const Field& other, auto& value) {
          if (other.name == field.name) has_number = assign(value, number);
        });
        if (!has_number) continue;
        choose_user(options, field);
        const std::string text =
            fmt::format("[{}]\n{} = {}", table.name, field.name, toml<T>(number));
        const std::string expected = broken_rule(field.rule, {&number, 1});
        EXPECT_NE(expected, "");
        EXPECT_EQ(refusal([&] { use(options); }), expected) << text;
        EXPECT_EQ(refusal([&] { (void)config::read_config_text(text, "case.toml", {}); }), expected)
            << text;
        ++num_refusals;
      }
    });
  }
};

TEST(OptionRules, AreTheSameForCaseFilesAndForCallersOfTheLibrary) {
  CheckEveryField check_every_field;
  config::RunConfig config;
  config::RunConfig::tables(config, check_every_field);
  EXPECT_GT(check_every_field.num_refusals, 150);
}

TEST(OptionRules, AllowInfinityWhereItMeansNoLimit) {
  const Rule rule = Rule::positive_or_infinite;
  EXPECT_EQ(broken_rule(rule, std::vector{infinity}), "");
  EXPECT_EQ(broken_rule(rule, std::vector{1.0, nan}), "must be > 0");
  EXPECT_EQ(broken_rule(Rule::any, std::vector{infinity}), "must be finite");
}

TEST(OptionRules, RefuseASolverToleranceOfACallerByItsName) {
  solve::SolverOptions options;
  options.rtol = -1;
  try {
    use(options);
    FAIL() << "nothing is refused";
  } catch (const ConfigError& error) {
    EXPECT_STREQ(error.what(), "solver.rtol = -1: must be > 0");
  }
}

TEST(OptionRules, NameTheAlternativesThatUseAField) {
  const Users users(shapes::ShapeKind::torus, shapes::ShapeKind::tips);
  EXPECT_TRUE(users.include(shapes::ShapeKind::tips));
  EXPECT_FALSE(users.include(shapes::ShapeKind::sphere));
  EXPECT_TRUE(Users().include(shapes::ShapeKind::sphere));
  EXPECT_EQ(users.names()[0], "torus");
}

}  // namespace
}  // namespace vesica
