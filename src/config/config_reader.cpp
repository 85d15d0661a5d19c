#include <fmt/format.h>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

#include "config/case_document.hpp"
#include "config/case_paths.hpp"
#include "config/nearest_name.hpp"
#include "config/option_values.hpp"
#include "core/refuse.hpp"
#include "vesica/config/config.hpp"
#include "vesica/core/check.hpp"
#include "vesica/core/error.hpp"

namespace vesica::config {
namespace {

constexpr Field accuracy_field{"accuracy", "-", "preset of solver.rtol and stop.normal_velocity"};

/// Reads the keys of one table into an options struct.
class TableReader {
 public:
  TableReader(const CaseDocument& document, std::string_view name, const toml::table& table)
      : document_(document), name_(name), table_(table) {}

  template <class T>
  void operator()(const Field& field, T& target) {
    known_.emplace_back(field.name);
    const toml::node* node = table_.get(field.name);
    if (node == nullptr) return;
    const std::string key = fmt::format("{}.{}", name_, field.name);
    const Entry entry{document_.place(key, node->source()), key, *node};
    assign(entry, target);
    check_value(field.rule, target,
                [&](const auto&, std::string_view rule) { entry.refuse(rule); });
  }

  void refuse_unknown_keys() const {
    for (const auto& [key, node] : table_) {
      const std::string word(key.str());
      if (std::find(known_.begin(), known_.end(), word) != known_.end()) continue;
      const std::string path = fmt::format("{}.{}", name_, word);
      Entry{document_.place(path, key.source()), path, node}.refuse("unknown key" +
                                                                    suggestion(word, known_));
    }
  }

 private:
  const CaseDocument& document_;
  std::string name_;
  const toml::table& table_;
  std::vector<std::string> known_;
};

/// Reads the tables of a case file.
class ConfigReader {
 public:
  explicit ConfigReader(const CaseDocument& document) : document_(document) {}

  template <class Options>
  void operator()(const Table& table, Options& options) {
    known_.emplace_back(table.name);
    const toml::node* node = document_.root().get(table.name);
    if (node == nullptr) return;
    const std::string name(table.name);
    if (!node->is_table())
      Entry{document_.place(name, node->source()), name, *node}.refuse("must be a table");
    TableReader reader(document_, name, *node->as_table());
    if constexpr (std::is_same_v<Options, solve::SolverOptions>) {
      Accuracy already_read = Accuracy::normal;
      reader(accuracy_field, already_read);
    }
    Options::fields(options, reader);
    reader.refuse_unknown_keys();
  }

  template <class Options>
  void operator()(const Table& table, std::optional<Options>& options) {
    if (document_.root().contains(table.name)) {
      (*this)(table, options.emplace());
    } else {
      known_.emplace_back(table.name);
    }
  }

  void read_title(std::string& title) {
    known_.emplace_back("title");
    const toml::node* node = document_.root().get("title");
    if (node != nullptr)
      assign(Entry{document_.place("title", node->source()), "title", *node}, title);
  }

  void refuse_unknown_tables() const {
    for (const auto& [key, node] : document_.root()) {
      const std::string word(key.str());
      if (std::find(known_.begin(), known_.end(), word) != known_.end()) continue;
      const std::string place = document_.place(word, key.source());
      if (!node.is_table())
        Entry{place, word, node}.refuse("unknown key" + suggestion(word, known_));
      throw ConfigError(
          fmt::format("{}: [{}]: unknown table{}", place, word, suggestion(word, known_)));
    }
  }

 private:
  const CaseDocument& document_;
  std::vector<std::string> known_;
};

std::map<std::string, std::string> places_of(const CaseDocument& document) {
  std::map<std::string, std::string> places;
  for (const auto& [name, table] : document.root()) {
    if (!table.is_table()) continue;
    for (const auto& [key, value] : *table.as_table()) {
      const std::string path = fmt::format("{}.{}", name.str(), key.str());
      places[path] = document.place(path, value.source());
    }
  }
  return places;
}

const toml::node* find(const CaseDocument& document, std::string_view table, std::string_view key) {
  const toml::table* found = document.root()[table].as_table();
  return found == nullptr ? nullptr : found->get(key);
}

/// The preset comes before the keys it sets.
void read_accuracy(const CaseDocument& document, RunConfig& config) {
  const toml::node* node = find(document, "solver", accuracy_field.name);
  if (node == nullptr) return;
  const std::string key = "solver.accuracy";
  assign(Entry{document.place(key, node->source()), key, *node}, config.accuracy);
  apply_accuracy(config.accuracy, config);
}

/// The paper's scheme comes with its damping constants and its stopping rule (3.4), unless the case
/// says otherwise.
void apply_method(const CaseDocument& document, RunConfig& config) {
  const toml::node* node = find(document, "solver", "method");
  if (node == nullptr) return;
  const std::string key = "solver.method";
  assign(Entry{document.place(key, node->source()), key, *node}, config.solver.method);
  if (config.solver.method != solve::Method::semi_implicit) return;
  config.damping.kind = relax::DampingKind::paper;
  config.stop.steps_without_newton = 10;
}

void check_rules_between_options(const CaseDocument& document, const RunConfig& config) {
  const auto refuse = [&document](std::string_view table, std::string_view key,
                                  std::string_view rule) {
    const toml::node* node = find(document, table, key);
    const std::string path = fmt::format("{}.{}", table, key);
    Entry{document.place(path, node->source()), path, *node}.refuse(rule);
  };
  if (config.output.directory.empty()) refuse("output", "directory", "must not be empty");
}

/// Which methods can go on from a state on a new mesh.
void check_adaption(solve::Method method, relax::MeshMethod mesh_method) {
  if (method == solve::Method::minimize) {
    if (mesh_method == relax::MeshMethod::local) return;
    refuse("adaption.method", name_of(mesh_method), "must be local for solver.method = minimize");
  }
  if (method == solve::Method::ida) return;
  refuse("adaption.enabled", true,
         fmt::format("needs solver.method = \"minimize\" or \"ida\", not \"{}\"", name_of(method)));
}

RunConfig read_document(const CaseDocument& document) {
  RunConfig config;
  read_accuracy(document, config);
  apply_method(document, config);
  ConfigReader reader(document);
  reader.read_title(config.title);
  RunConfig::tables(config, reader);
  reader.refuse_unknown_tables();
  check_rules_between_options(document, config);
  config.places = places_of(document);
  with_places(config, [&config] { check(config); });
  return config;
}

}  // namespace

RunConfig read_config_text(std::string_view text, std::string_view name,
                           std::span<const std::string> overrides) {
  return read_document(CaseDocument(text, name, overrides));
}

void check(const RunConfig& given) {
  const RunConfig config = resolved(given);
  RunConfig::tables(config, []<class Options>(const Table& table, const Options& options) {
    if constexpr (requires { options.has_value(); }) {
      if (options) vesica::check(table.name, *options);
    } else {
      vesica::check(table.name, options);
    }
  });
  if (config.adaption.enabled) check_adaption(config.solver.method, config.adaption.method);
}

std::string placed(const RunConfig& config, std::string_view message) {
  const auto found =
      config.places.find(std::string(message.substr(0, message.find_first_of(" :["))));
  if (found == config.places.end()) return std::string(message);
  return fmt::format("{}: {}", found->second, message);
}

RunConfig read_config(const std::string& path, std::span<const std::string> overrides) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf())) {
    throw IoError(fmt::format("{}: cannot be read ({})", path,
                              errno == 0 ? "empty file" : std::generic_category().message(errno)));
  }
  const CaseDocument document(std::move(text).str(), path, overrides);
  RunConfig config = read_document(document);
  locate_files(document, std::filesystem::path(path).parent_path(), config);
  return config;
}

}  // namespace vesica::config
