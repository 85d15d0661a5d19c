#include <CLI/CLI.hpp>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string>

#include "common/program.hpp"
#include "vesica/core/version.hpp"
#include "vesica/io/run_reader.hpp"
#include "vesica/io/surface_writer.hpp"

namespace vesica {
namespace {

constexpr int bad_input = 2;

int export_frame(int argc, char** argv) {
  CLI::App app("Writes a frame of a run as a surface file.", "vesica-export");
  std::string folder;
  std::string file;
  std::optional<std::size_t> index;
  bool is_quiet = false;
  app.set_version_flag("--version", std::string(version()));
  app.add_option("run", folder, "folder of a run")->type_name("RUN")->required();
  app.add_option("file", file, "surface file: .vtu (quadratic triangles, fields), .ply or .obj")
      ->type_name("FILE")
      ->required();
  app.add_option("--frame", index, "number of the frame, from 0; without it the last one")
      ->type_name("N");
  app.add_flag("--quiet", is_quiet, "print nothing but errors");
  app.footer("Exit status: 0 written; 2 bad input; 4 files could not be read or written.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : bad_input;
  }
  const io::Frame frame = io::read_frame(folder, index);
  io::write_surface(file, frame.state.surface(), io::fields_of(frame.state));
  if (!is_quiet) {
    std::cout << file << ": frame " << frame.index << " (0 to " << frame.count - 1
              << "), t = " << frame.state.time << ", " << frame.state.triangulation->num_nodes()
              << " nodes\n";
  }
  return 0;
}

}  // namespace
}  // namespace vesica

int main(int argc, char** argv) {
  return vesica::run_program("vesica-export", [&] { return vesica::export_frame(argc, argv); });
}
