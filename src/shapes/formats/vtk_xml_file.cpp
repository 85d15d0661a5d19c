#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <utility>

#include "shapes/formats/cells.hpp"
#include "shapes/formats/encoded_array.hpp"

namespace vesica::shapes {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 10> type_names = {
    {{"Int8", NumberType::i8},
     {"UInt8", NumberType::u8},
     {"Int16", NumberType::i16},
     {"UInt16", NumberType::u16},
     {"Int32", NumberType::i32},
     {"UInt32", NumberType::u32},
     {"Int64", NumberType::i64},
     {"UInt64", NumberType::u64},
     {"Float32", NumberType::f32},
     {"Float64", NumberType::f64}}};

/// Reads .vtu and .vtp files (docs.vtk.org, "VTK XML file formats").
class VtkXmlReader {
 public:
  VtkXmlReader(const std::string& path, std::string_view bytes) : path_(path), bytes_(bytes) {
    parse();
    file_ = document_.child("VTKFile");
    if (!file_) refuse(document_, "the root must be VTKFile");
    read_coding();
  }

  SurfaceData read() {
    const std::string type = file_.attribute("type").value();
    if (type != "UnstructuredGrid" && type != "PolyData")
      refuse(file_, fmt::format("type '{}': must be UnstructuredGrid or PolyData", type));
    const pugi::xml_node piece = only_piece(file_.child(type.c_str()));
    read_points(piece);
    const pugi::xml_node cells = piece.child(type == "PolyData" ? "Polys" : "Cells");
    Cells given;
    given.connectivity = named_array(cells, "connectivity");
    given.offsets = named_array(cells, "offsets");
    given.offsets.insert(given.offsets.begin(), 0);
    if (type == "UnstructuredGrid") given.types = named_array(cells, "types");
    add_cells(given, data_, [&](const std::string& text) { refuse(cells, text); });
    for (const pugi::xml_node array : piece.child("PointData").children("DataArray"))
      read_field(array);
    return std::move(data_);
  }

 private:
  /// Raw data behind the underscore of AppendedData are no XML, so they are left out.
  void parse() {
    std::string xml(bytes_);
    if (const std::size_t tag = xml.find("<AppendedData"); tag != std::string::npos) {
      const std::size_t begin = xml.find('_', xml.find('>', tag));
      if (begin == std::string::npos)
        throw ConfigError(fmt::format("{}: AppendedData without data behind a '_'", path_));
      appended_ = bytes_.substr(begin + 1);
      xml.resize(begin);
      xml += "</AppendedData></VTKFile>";
    }
    const pugi::xml_parse_result result = document_.load_buffer(xml.data(), xml.size());
    if (!result) {
      throw ConfigError(fmt::format("{}:{}: XML: {}", path_,
                                    line_of(static_cast<std::size_t>(result.offset)),
                                    result.description()));
    }
  }

  [[nodiscard]] std::size_t line_of(std::size_t offset) const {
    const std::string_view before = bytes_.substr(0, offset);
    return 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
  }

  [[noreturn]] void refuse(const pugi::xml_node& node, const std::string& text) const {
    const char* name = node.attribute("Name").value();
    throw ConfigError(fmt::format(
        "{}:{}: {}{}: {}", path_,
        line_of(static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, node.offset_debug()))),
        node.name(), *name == '\0' ? "" : fmt::format(" '{}'", name), text));
  }

  void read_coding() {
    coding_.is_big_endian = std::string_view(file_.attribute("byte_order").value()) == "BigEndian";
    const std::string_view header = file_.attribute("header_type").as_string("UInt32");
    if (header != "UInt32" && header != "UInt64")
      refuse(file_, fmt::format("header_type '{}': must be UInt32 or UInt64", header));
    coding_.header = header == "UInt64" ? NumberType::u64 : NumberType::u32;
    const std::string_view compressor = file_.attribute("compressor").value();
    coding_.is_compressed = !compressor.empty();
    if (coding_.is_compressed && compressor != "vtkZLibDataCompressor")
      refuse(file_,
             fmt::format("compressor '{}': must be vtkZLibDataCompressor or none", compressor));
  }

  pugi::xml_node only_piece(const pugi::xml_node& grid) const {
    if (!grid) refuse(file_, "must hold an element of the name of its type");
    std::optional<pugi::xml_node> found;
    for (const pugi::xml_node piece : grid.children("Piece")) {
      if (piece.attribute("NumberOfPoints").as_llong() == 0) continue;
      if (found) refuse(piece, "a second piece: must be one");
      found = piece;
    }
    if (!found) refuse(grid, "no piece has points");
    return *found;
  }

  void read_points(const pugi::xml_node& piece) {
    const pugi::xml_node points = piece.child("Points");
    const pugi::xml_node array = points.child("DataArray");
    if (!array) refuse(points ? points : piece, "must hold the DataArray of the points");
    const std::vector<double> values = numbers(array);
    const std::size_t count = values.size() / 3;
    if (values.size() != 3 * count || count != piece.attribute("NumberOfPoints").as_ullong())
      refuse(array, fmt::format("{} numbers: must be three for each of NumberOfPoints = {}",
                                values.size(), piece.attribute("NumberOfPoints").value()));
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d point(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
      if (!point.allFinite()) refuse(array, fmt::format("point {}: must be finite", i));
      data_.points.push_back(point);
    }
  }

  void read_field(const pugi::xml_node& array) {
    if (array.attribute("NumberOfComponents").as_int(1) != 1 ||
        std::string_view(array.attribute("type").value()) == "String")
      return;
    const std::vector<double> values = numbers(array);
    if (values.size() != data_.points.size())
      refuse(array, fmt::format("{} values: must be one for each of the {} points", values.size(),
                                data_.points.size()));
    const std::string name = array.attribute("Name").value();
    data_.fields.push_back({name, path_ + ": point field '" + name + "'",
                            Eigen::Map<const Eigen::VectorXd>(
                                values.data(), static_cast<Eigen::Index>(values.size()))});
  }

  std::vector<double> named_array(const pugi::xml_node& parent, const char* name) const {
    const pugi::xml_node array = parent.find_child_by_attribute("DataArray", "Name", name);
    if (!array)
      refuse(parent ? parent : file_, fmt::format("DataArray '{}' of the cells is missing", name));
    return numbers(array);
  }

  NumberType type_of(const pugi::xml_node& array) const {
    const std::string_view word = array.attribute("type").value();
    for (const auto& [name, type] : type_names) {
      if (name == word) return type;
    }
    refuse(array, fmt::format("type '{}': must be a number type of VTK, as Float64", word));
  }

  std::vector<double> numbers(const pugi::xml_node& array) const {
    const NumberType type = type_of(array);
    const std::string_view format = array.attribute("format").as_string("ascii");
    if (format == "ascii") return numbers_of_text(array, type);
    const RefuseArray refuse_array = [&](const std::string& text) { refuse(array, text); };
    const std::string bytes = array_bytes(coding_, stored_bytes(array, format, refuse_array),
                                          bytes_.size(), refuse_array);
    const std::size_t size = size_of(type);
    if (bytes.size() % size != 0)
      refuse(array, fmt::format("{} bytes: must be a multiple of {}", bytes.size(), size));
    std::vector<double> values;
    for (std::size_t i = 0; i < bytes.size(); i += size)
      values.push_back(decode(type, bytes.data() + i, coding_.is_big_endian));
    return values;
  }

  std::vector<double> numbers_of_text(const pugi::xml_node& array, NumberType type) const {
    std::vector<double> values;
    FileCursor cursor(path_, array.child_value());
    try {
      while (!cursor.is_at_end()) values.push_back(cursor.number(type));
    } catch (const ConfigError& error) {
      const std::string_view text = error.what();
      refuse(array, fmt::format("value number {}{}", values.size() + 1,
                                text.substr(text.find(": ", path_.size()))));
    }
    return values;
  }

  /// What gives the first bytes of an array that is not text.
  std::function<std::string(std::size_t)> stored_bytes(const pugi::xml_node& array,
                                                       std::string_view format,
                                                       const RefuseArray& refuse_array) const {
    if (format == "binary") {
      return [text = std::string_view(array.child_value()), refuse_array](std::size_t size) {
        return decode_base64(text, size, refuse_array);
      };
    }
    if (format != "appended")
      refuse(array, fmt::format("format '{}': must be ascii, binary or appended", format));
    const auto offset = static_cast<std::size_t>(array.attribute("offset").as_ullong(~0ULL));
    if (offset >= appended_.size())
      refuse(array, fmt::format("offset {}: must be below the {} appended bytes",
                                array.attribute("offset").value(), appended_.size()));
    const std::string_view rest = appended_.substr(offset);
    const std::string_view encoding =
        file_.child("AppendedData").attribute("encoding").as_string("base64");
    if (encoding == "base64") {
      return [rest, refuse_array](std::size_t size) {
        return decode_base64(rest, size, refuse_array);
      };
    }
    return [rest, refuse_array](std::size_t size) {
      if (size > rest.size())
        refuse_array(fmt::format("ends after {} bytes: must have {}", rest.size(), size));
      return std::string(rest.substr(0, size));
    };
  }

  std::string path_;
  std::string_view bytes_;
  std::string_view appended_;
  pugi::xml_document document_;
  pugi::xml_node file_;
  ArrayCoding coding_;
  SurfaceData data_;
};

}  // namespace

SurfaceData parse_vtk_xml(const std::string& path, std::string_view bytes) {
  return VtkXmlReader(path, bytes).read();
}

}  // namespace vesica::shapes
