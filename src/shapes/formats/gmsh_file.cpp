#include <fmt/format.h>

#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>

#include "shapes/formats/cells.hpp"
#include "shapes/formats/file_cursor.hpp"

namespace vesica::shapes {
namespace {

/// Number of nodes of the element types that are read or passed over; 0 for others.
std::size_t num_nodes_of(int type) {
  switch (type) {
    case 15:  // point
      return 1;
    case 1:  // line
      return 2;
    case 8:  // quadratic line
    case 2:  // triangle
      return 3;
    case 9:  // quadratic triangle
      return 6;
    default:
      return 0;
  }
}

bool is_triangle(int type) { return type == 2 || type == 9; }

/// Reads the formats 2.2 and 4.1 of Gmsh, https://gmsh.info/doc/texinfo/gmsh.html#File-formats.
class GmshReader {
 public:
  GmshReader(const std::string& path, std::string_view bytes) : path_(path), cursor_(path, bytes) {}

  SurfaceData read() {
    while (!cursor_.is_at_end()) read_section();
    cursor_.enter("$Elements");
    if (data_.triangles.empty()) cursor_.refuse("no element is a triangle");
    if (!data_.middles.empty() && data_.middles.size() != data_.triangles.size())
      cursor_.refuse("{} flat and {} quadratic triangles: must be of one kind",
                     data_.triangles.size() - data_.middles.size(), data_.middles.size());
    return std::move(data_);
  }

 private:
  void read_section() {
    cursor_.enter("");
    const std::string name(cursor_.word());
    if (!name.starts_with('$')) cursor_.refuse("'{}': must be the name of a section", name);
    cursor_.enter(name);
    if (name != "$MeshFormat" && !is_format_4_) cursor_.refuse("must come after $MeshFormat");
    if (name == "$MeshFormat") {
      read_format();
    } else if (name == "$Nodes") {
      *is_format_4_ ? read_nodes_4() : read_nodes_2();
    } else if (name == "$Elements") {
      *is_format_4_ ? read_elements_4() : read_elements_2();
    } else if (name == "$NodeData") {
      read_node_data();
    } else {
      skip_to_end_of(name);
      return;
    }
    cursor_.enter(name);
    const std::string end(cursor_.word());
    if (end != "$End" + name.substr(1)) cursor_.refuse("'{}': must be $End{}", end, name.substr(1));
  }

  /// Binary sections have no lines, but their end stands behind a line end.
  void skip_to_end_of(const std::string& name) {
    const std::string end = "$End" + name.substr(1);
    while (!cursor_.line().ends_with(end)) continue;
  }

  void read_format() {
    const std::string version(cursor_.word());
    if (version != "2.2" && version != "4.1")
      cursor_.refuse("version {}: must be 2.2 or 4.1 (gmsh -save -format msh41)", version);
    is_format_4_ = version == "4.1";
    const std::size_t is_binary = cursor_.count();
    if (const std::size_t size = cursor_.count(); size != 8)
      cursor_.refuse("numbers of {} bytes: must be 8", size);
    if (is_binary == 0) return;
    (void)cursor_.line();
    cursor_.encoding = Encoding::little_endian;
    if (cursor_.number(NumberType::i32) != 1) cursor_.encoding = Encoding::big_endian;
  }

  void begin_binary() {
    if (cursor_.encoding != Encoding::text) (void)cursor_.line();
  }

  int integer() { return static_cast<int>(cursor_.number(NumberType::i32)); }

  std::size_t size() {
    const double value = cursor_.number(NumberType::u64);
    if (!(value >= 0 && value <= static_cast<double>(cursor_.size())))
      cursor_.refuse("number {}: must be >= 0, and what the file can hold", value);
    return static_cast<std::size_t>(value);
  }

  void add_point(double tag, const Eigen::Vector3d& point) {
    const auto next = static_cast<mesh::NodeIndex>(data_.points.size());
    if (!nodes_.try_emplace(static_cast<long long>(tag), next).second)
      cursor_.refuse("number {}: must be given once", tag);
    data_.points.push_back(point);
  }

  mesh::NodeIndex node(double tag) {
    const auto found = nodes_.find(static_cast<long long>(tag));
    if (found == nodes_.end()) cursor_.refuse("node {}: must be one of $Nodes", tag);
    return found->second;
  }

  void read_nodes_2() {
    const std::size_t count = cursor_.count();
    begin_binary();
    for (std::size_t i = 0; i < count; ++i) {
      cursor_.enter("node", i, count);
      const double tag = cursor_.number(NumberType::i32);
      add_point(tag, cursor_.point(NumberType::f64));
    }
  }

  void read_nodes_4() {
    begin_binary();
    const std::size_t num_blocks = size();
    for (int i = 0; i < 3; ++i) (void)cursor_.number(NumberType::u64);
    for (std::size_t block = 0; block < num_blocks; ++block) {
      cursor_.enter("block of nodes", block, num_blocks);
      const int dimension = integer();
      (void)integer();
      const int is_parametric = integer();
      if (is_parametric != 0 && dimension > 2) cursor_.refuse("parametric nodes of a volume");
      std::vector<double> tags(size());
      for (double& tag : tags) tag = cursor_.number(NumberType::u64);
      for (std::size_t i = 0; i < tags.size(); ++i) {
        add_point(tags[i], cursor_.point(NumberType::f64));
        for (int k = 0; is_parametric != 0 && k < dimension; ++k)
          (void)cursor_.number(NumberType::f64);
      }
    }
  }

  /// An element of type `type` behind its number and tags.
  void read_element(int type, NumberType number_type) {
    std::vector<mesh::NodeIndex> nodes(num_nodes_of(type));
    if (nodes.empty())
      cursor_.refuse("type {}: must be a triangle (2) or a quadratic triangle (9)", type);
    for (mesh::NodeIndex& index : nodes) index = node(cursor_.number(number_type));
    if (is_triangle(type)) add_triangle(nodes, data_);
  }

  /// Text: number, type, tags, nodes. Binary: blocks of one type.
  void read_elements_2() {
    const std::size_t count = cursor_.count();
    begin_binary();
    const bool is_text = cursor_.encoding == Encoding::text;
    std::size_t i = 0;
    while (i < count) {
      cursor_.enter("element", i, count);
      if (is_text) (void)integer();
      const int type = integer();
      const int in_block = is_text ? 1 : integer();
      const int num_tags = integer();
      if (in_block < 1) cursor_.refuse("block of {} elements: must be >= 1", in_block);
      for (int k = 0; k < in_block; ++k, ++i) {
        cursor_.enter("element", i, count);
        if (!is_text) (void)integer();
        for (int tag = 0; tag < num_tags; ++tag) (void)integer();
        read_element(type, NumberType::i32);
      }
    }
  }

  void read_elements_4() {
    begin_binary();
    const std::size_t num_blocks = size();
    for (int i = 0; i < 3; ++i) (void)cursor_.number(NumberType::u64);
    for (std::size_t block = 0; block < num_blocks; ++block) {
      cursor_.enter("block of elements", block, num_blocks);
      for (int i = 0; i < 2; ++i) (void)integer();
      const int type = integer();
      const std::size_t count = size();
      for (std::size_t i = 0; i < count; ++i) {
        (void)cursor_.number(NumberType::u64);
        read_element(type, NumberType::u64);
      }
    }
  }

  /// A name in quotation marks and other words, numbers, the integers step, components and count.
  void read_node_data() {
    std::string name;
    const std::size_t num_words = cursor_.count();
    (void)cursor_.line();
    for (std::size_t i = 0; i < num_words; ++i) {
      std::string word(cursor_.line());
      if (i == 0 && word.size() > 1) name = word.substr(1, word.size() - 2);
    }
    const std::size_t num_reals = cursor_.count();
    for (std::size_t i = 0; i < num_reals; ++i) (void)cursor_.word();
    std::vector<std::size_t> integers(cursor_.count());
    for (std::size_t& value : integers) value = cursor_.count();
    if (integers.size() < 3) cursor_.refuse("must have step, components and number of nodes");
    begin_binary();
    std::vector<double> values(data_.points.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < integers[2]; ++i) {
      const mesh::NodeIndex at = node(cursor_.number(NumberType::i32));
      for (std::size_t k = 0; k < integers[1]; ++k)
        values[static_cast<std::size_t>(at)] = cursor_.number(NumberType::f64);
    }
    if (integers[1] != 1) return;
    data_.fields.push_back({name, path_ + ": point field '" + name + "'",
                            Eigen::Map<const Eigen::VectorXd>(
                                values.data(), static_cast<Eigen::Index>(values.size()))});
  }

  std::string path_;
  FileCursor cursor_;
  SurfaceData data_;
  std::unordered_map<long long, mesh::NodeIndex> nodes_;  ///< by their numbers in the file
  std::optional<bool> is_format_4_;
};

}  // namespace

SurfaceData parse_gmsh(const std::string& path, std::string_view bytes) {
  return GmshReader(path, bytes).read();
}

}  // namespace vesica::shapes
