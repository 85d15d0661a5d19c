#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ostream>
#include <sstream>

#include "config/case_paths.hpp"
#include "config/option_values.hpp"
#include "vesica/config/config.hpp"
#include "vesica/core/check.hpp"

namespace vesica::config {
namespace {

/// Writes the keys of one table with their values.
class ValueWriter {
 public:
  explicit ValueWriter(std::ostream& out) : out_(out) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    out_ << fmt::format("{} = {}\n", field.name, toml_text(value));
  }
  template <class T>
  void operator()(const Field& field, const std::optional<T>& value) {
    if (value) (*this)(field, *value);
  }

 private:
  std::ostream& out_;
};

/// Writes the keys of one table commented out, each below its meaning.
class TemplateWriter {
 public:
  explicit TemplateWriter(std::ostream& out) : out_(out) {}

  template <class T>
  void operator()(const Field& field, const T& value) {
    describe<T>(field);
    out_ << fmt::format("#{} = {}\n", field.name, toml_text(value));
  }
  /// An absent value has no default to show.
  template <class T>
  void operator()(const Field& field, const std::optional<T>&) {
    describe<T>(field);
    out_ << fmt::format("#{} = <{}>\n", field.name,
                        std::is_same_v<T, double> ? "number, not set" : "not set");
  }

 private:
  template <class T>
  void describe(const Field& field) {
    out_ << "# ";
    if (!field.used_by.names().empty())
      out_ << fmt::format("{}: ", fmt::join(field.used_by.names(), ", "));
    out_ << field.meaning;
    if (field.unit != "-") out_ << fmt::format(" [{}]", field.unit);
    if (field.rule != Rule::any) out_ << "; " << rule_text(field.rule);
    if constexpr (std::is_enum_v<T>)
      out_ << fmt::format("; one of: {}", fmt::join(enum_names<T>(), ", "));
    out_ << '\n';
  }

  std::ostream& out_;
};

void write_accuracy_template(std::ostream& out) {
  out << "# preset for what is not given: draft (rtol 1e-2, stop.normal_velocity 1e-2), normal, "
         "reference (1e-5, 1e-4)\n"
         "#accuracy = \"normal\"\n";
}

}  // namespace

void write_template(std::ostream& out) {
  out << "# Case file of vesica-relax. Every option is shown with its default: take away the # to "
         "change one.\n"
         "# Units follow from the case: a length, an energy; times are length^4/energy.\n\n"
         "#title = \"\"\n";
  const RunConfig defaults;
  RunConfig::tables(defaults, [&out]<class Options>(const Table& table, const Options& options) {
    out << fmt::format("\n# {}\n", table.meaning);
    if constexpr (requires { options.has_value(); }) {
      out << fmt::format("#[{}]\n", table.name);
      const typename Options::value_type values;
      Options::value_type::fields(values, TemplateWriter(out));
    } else {
      out << fmt::format("[{}]\n", table.name);
      if constexpr (std::is_same_v<Options, solve::SolverOptions>) write_accuracy_template(out);
      Options::fields(options, TemplateWriter(out));
    }
  });
}

std::string to_toml(const RunConfig& given) {
  const RunConfig config = with_absolute_paths(given);
  std::ostringstream out;
  out << "title = " << toml_text(config.title) << '\n';
  RunConfig::tables(config,
                    [&out, &config]<class Options>(const Table& table, const Options& options) {
                      if constexpr (requires { options.has_value(); }) {
                        if (!options) return;
                        out << fmt::format("\n[{}]\n", table.name);
                        Options::value_type::fields(*options, ValueWriter(out));
                      } else {
                        out << fmt::format("\n[{}]\n", table.name);
                        if constexpr (std::is_same_v<Options, solve::SolverOptions>) {
                          out << "accuracy = " << toml_text(config.accuracy) << '\n';
                        }
                        Options::fields(options, ValueWriter(out));
                      }
                    });
  return std::move(out).str();
}

}  // namespace vesica::config
