#include "io/record/publication.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/record/durable_files.hpp"
#include "io/record/file_names.hpp"
#include "io/record/record_reader.hpp"
#include "vesica/core/error.hpp"

namespace vesica::io {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

fs::path temporary(const fs::path& path) { return path.string() + ".tmp"; }

/// Text files that belong to a record; the verdict comes last.
struct Copies {
  std::vector<std::pair<const char*, std::string>> files;
  bool has_xdmf = false;
};

Copies copies_of(const fs::path& record) {
  const RecordReader reader(record);
  const std::string run = reader.run();
  const std::optional<std::string> verdict = reader.verdict();
  if (!verdict) throw IoError(fmt::format("{}: /outcome/verdict is missing", record.string()));
  Copies copies;
  copies.has_xdmf = reader.has_xdmf();
  if (copies.has_xdmf) {
    copies.files.emplace_back(file_names::xdmf,
                              xdmf_text(file_names::record, run, reader.frames()));
  }
  copies.files.emplace_back(file_names::configuration, first_line(run) + reader.configuration());
  copies.files.emplace_back(file_names::verdict, *verdict);
  return copies;
}

}  // namespace

void publish(const fs::path& folder) {
  const bool has_part = is_there(folder / file_names::part);
  const Copies copies = copies_of(folder / (has_part ? file_names::part : file_names::record));
  for (const auto& [name, text] : copies.files) write_durably(temporary(folder / name), text);
  remove_file(folder / file_names::verdict);  // of an older run
  if (!copies.has_xdmf) remove_file(folder / file_names::xdmf);
  remove_file(folder / file_names::journal);
  synchronise_folder(folder);
  if (has_part) rename_file(folder / file_names::part, folder / file_names::record);
  for (const auto& [name, text] : copies.files) {
    if (name == file_names::verdict) synchronise_folder(folder);
    rename_file(temporary(folder / name), folder / name);
  }
  remove_file(folder / file_names::part_xdmf);
  synchronise_folder(folder);
}

bool is_unpublished(const fs::path& folder) {
  return is_there(folder / file_names::part) || !is_there(folder / file_names::verdict) ||
         is_there(folder / file_names::part_xdmf);
}

std::string first_line(const std::string& run) { return fmt::format("# run {}\n", run); }

bool goes_on_in(const fs::path& folder, const setup::Case& vesicle) {
  std::error_code ignored;
  return vesicle.resumed && fs::equivalent(folder, vesicle.resumed->folder, ignored);
}

}  // namespace vesica::io
