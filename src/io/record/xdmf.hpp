#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace vesica::io {

/// A frame of the HDF5 file, as ParaView has to know it.
struct XdmfFrame {
  double time = 0;
  std::string group;  ///< "/frames/000000"
  std::string mesh;   ///< "/meshes/000000"
  std::int64_t num_nodes = 0;
  std::int64_t num_triangles = 0;
  bool is_two_phase = false;
  long step = 0;
};

/// The text before the frames, with the number of the run, one frame, and the text behind them.
[[nodiscard]] std::string xdmf_head(std::string_view run);
[[nodiscard]] std::string xdmf_frame(std::string_view hdf5_name, const XdmfFrame& frame);
inline constexpr std::string_view xdmf_foot =
    "    </Grid>\n"
    "  </Domain>\n"
    "</Xdmf>\n";

/// XDMF text: a temporal collection of quadratic triangles whose arrays stand in `hdf5_name`, a
/// file in the same folder. Of frames at one time (before and after a change of the mesh) the last:
/// ParaView shows one grid at a time.
/// `run` is noted.
[[nodiscard]] std::string xdmf_text(std::string_view hdf5_name, std::string_view run,
                                    std::span<const XdmfFrame> frames);

}  // namespace vesica::io
