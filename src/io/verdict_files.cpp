#include "vesica/io/verdict_files.hpp"

#include <filesystem>

#include "vesica/io/run_folder.hpp"

namespace vesica::io {

void write_verdict(const config::RunConfig& config, const relax::Verdict& verdict) {
  const std::filesystem::path folder = config.output.directory;
  write_text_file(folder / "case.toml", config::to_toml(config));
  write_text_file(folder / "verdict.json", to_json(verdict));
}

}  // namespace vesica::io
