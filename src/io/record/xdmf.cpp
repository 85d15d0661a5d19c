#include "io/record/xdmf.hpp"

#include <fmt/format.h>
#include <array>
#include <utility>

namespace vesica::io {
namespace {

/// Name in ParaView, name in the HDF5 file.
constexpr std::array<std::pair<std::string_view, std::string_view>, 3> fields{
    {{"kappa", "mean_curvature"},
     {"normal_velocity", "normal_velocity"},
     {"bending_energy_density", "bending_energy_density"}}};

/// The positions are a field as well: meshio reads the geometry of the first frame only.
std::string positions_text(std::string_view hdf5_name, const XdmfFrame& frame) {
  return fmt::format(
      "        <Attribute Name=\"positions\" AttributeType=\"Vector\" Center=\"Node\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{} "
      "3\">{}:{}/positions</DataItem>\n"
      "        </Attribute>\n",
      frame.num_nodes, hdf5_name, frame.group);
}

std::string attribute_text(std::string_view hdf5_name, const XdmfFrame& frame,
                           std::string_view shown, std::string_view stored) {
  return fmt::format(
      "        <Attribute Name=\"{}\" AttributeType=\"Scalar\" Center=\"Node\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" "
      "Dimensions=\"{}\">{}:{}/{}</DataItem>\n"
      "        </Attribute>\n",
      shown, frame.num_nodes, hdf5_name, frame.group, stored);
}

}  // namespace

std::string xdmf_head(std::string_view run) {
  return fmt::format(
      "<?xml version=\"1.0\"?>\n"
      "<!-- run {} -->\n"
      "<Xdmf Version=\"3.0\">\n"
      "  <Domain>\n"
      "    <Grid Name=\"vesicle\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      run);
}

std::string xdmf_frame(std::string_view hdf5_name, const XdmfFrame& frame) {
  std::string text = fmt::format(
      "      <Grid Name=\"{0}\" GridType=\"Uniform\">\n"
      "        <Time Value=\"{1}\"/>\n"
      "        <Topology TopologyType=\"Tri_6\" NumberOfElements=\"{2}\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Int\" Precision=\"4\" Dimensions=\"{2} "
      "6\">{3}:{4}/triangles"
      "</DataItem>\n"
      "        </Topology>\n"
      "        <Geometry GeometryType=\"XYZ\">\n"
      "          <DataItem Format=\"HDF\" NumberType=\"Float\" Precision=\"8\" Dimensions=\"{5} "
      "3\">{3}:{6}/positions"
      "</DataItem>\n"
      "        </Geometry>\n",
      frame.group, frame.time, frame.num_triangles, hdf5_name, frame.mesh, frame.num_nodes,
      frame.group);
  text += positions_text(hdf5_name, frame);
  if (frame.is_two_phase) text += attribute_text(hdf5_name, frame, "c", "order_parameter");
  for (const auto& [shown, stored] : fields)
    text += attribute_text(hdf5_name, frame, shown, stored);
  return text + "      </Grid>\n";
}

std::string xdmf_text(std::string_view hdf5_name, std::string_view run,
                      std::span<const XdmfFrame> frames) {
  std::string text = xdmf_head(run);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool is_replaced = i + 1 < frames.size() && frames[i + 1].time == frames[i].time;
    if (!is_replaced) text += xdmf_frame(hdf5_name, frames[i]);
  }
  text += xdmf_foot;
  return text;
}

}  // namespace vesica::io
