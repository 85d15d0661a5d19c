#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <utility>

#include "shapes/formats/file_cursor.hpp"
#include "shapes/formats/formats.hpp"

namespace vesica::shapes {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 16> type_names = {
    {{"char", NumberType::i8},
     {"uchar", NumberType::u8},
     {"short", NumberType::i16},
     {"ushort", NumberType::u16},
     {"int", NumberType::i32},
     {"uint", NumberType::u32},
     {"float", NumberType::f32},
     {"double", NumberType::f64},
     {"int8", NumberType::i8},
     {"uint8", NumberType::u8},
     {"int16", NumberType::i16},
     {"uint16", NumberType::u16},
     {"int32", NumberType::i32},
     {"uint32", NumberType::u32},
     {"float32", NumberType::f32},
     {"float64", NumberType::f64}}};

struct Property {
  std::string name;
  NumberType type = NumberType::f64;
  bool is_list = false;
  NumberType count_type = NumberType::u8;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

NumberType type_of(const FileCursor& cursor, const std::string& word) {
  for (const auto& [name, type] : type_names) {
    if (name == word) return type;
  }
  cursor.refuse("type '{}': must be a number type of PLY, as float or int32", word);
}

Property read_property(const FileCursor& cursor, std::istringstream& words) {
  Property property;
  std::string type;
  words >> type;
  property.is_list = type == "list";
  if (property.is_list) {
    std::string count_type;
    words >> count_type >> type;
    property.count_type = type_of(cursor, count_type);
    if (!is_integer(property.count_type)) cursor.refuse("a list is counted by an integer");
  }
  property.type = type_of(cursor, type);
  if (!(words >> property.name)) cursor.refuse("property without a name");
  return property;
}

Encoding read_format(const FileCursor& cursor, std::istringstream& words) {
  std::string format;
  words >> format;
  if (format == "ascii") return Encoding::text;
  if (format == "binary_little_endian") return Encoding::little_endian;
  if (format == "binary_big_endian") return Encoding::big_endian;
  cursor.refuse("format '{}': must be ascii, binary_little_endian or binary_big_endian", format);
}

/// Reads the header; the cursor is then at the first element, with its encoding.
std::vector<Element> read_header(FileCursor& cursor) {
  cursor.enter("header");
  if (cursor.line() != "ply") cursor.refuse("the first line must be 'ply'");
  std::vector<Element> elements;
  Encoding encoding = Encoding::text;
  while (true) {
    const std::string line(cursor.line());
    std::istringstream words(line);
    std::string keyword;
    words >> keyword;
    if (keyword == "end_header") break;
    if (keyword == "format") {
      encoding = read_format(cursor, words);
    } else if (keyword == "element") {
      Element element;
      if (!(words >> element.name >> element.count)) cursor.refuse("element without name or count");
      if (element.count > cursor.size())
        cursor.refuse("{} of element {}: is more than a file of {} bytes can hold", element.count,
                      element.name, cursor.size());
      elements.push_back(std::move(element));
    } else if (keyword == "property") {
      if (elements.empty()) cursor.refuse("property before the first element");
      elements.back().properties.push_back(read_property(cursor, words));
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.refuse(
          "keyword '{}': must be format, element, property, comment, obj_info or "
          "end_header",
          keyword);
    }
  }
  cursor.encoding = encoding;
  return elements;
}

std::size_t list_size(FileCursor& cursor, const Property& property) {
  const double size = cursor.number(property.count_type);
  if (!(size >= 0)) cursor.refuse("list of {} numbers: must be >= 0", size);
  return static_cast<std::size_t>(size);
}

void skip(FileCursor& cursor, const Property& property) {
  const std::size_t count = property.is_list ? list_size(cursor, property) : 1;
  for (std::size_t i = 0; i < count; ++i) (void)cursor.number(property.type);
}

/// What becomes of the properties of a vertex: 0 to 2 is a coordinate, 3 + i point field i.
constexpr auto nothing = static_cast<std::size_t>(-1);

std::vector<std::size_t> vertex_targets(const FileCursor& cursor, const Element& element,
                                        const std::string& path, SurfaceData& data) {
  std::vector<std::size_t> targets;
  std::array<int, 3> found{};
  for (const Property& property : element.properties) {
    const std::size_t axis = property.name.size() == 1 ? std::string_view("xyz").find(property.name)
                                                       : std::string_view::npos;
    if (property.is_list) {
      targets.push_back(nothing);
    } else if (axis < 3) {
      targets.push_back(axis);
      ++found[axis];
    } else {
      targets.push_back(3 + data.fields.size());
      data.fields.push_back({property.name, path + ": point field '" + property.name + "'",
                             Eigen::VectorXd(static_cast<Eigen::Index>(element.count))});
    }
  }
  if (found != std::array{1, 1, 1}) cursor.refuse("vertices must have the properties x, y and z");
  return targets;
}

void read_vertices(FileCursor& cursor, const Element& element, const std::string& path,
                   SurfaceData& data) {
  const std::vector<std::size_t> targets = vertex_targets(cursor, element, path, data);
  for (std::size_t i = 0; i < element.count; ++i) {
    cursor.enter("vertex", i, element.count);
    Eigen::Vector3d& point = data.points.emplace_back();
    for (std::size_t p = 0; p < targets.size(); ++p) {
      if (targets[p] == nothing) {
        skip(cursor, element.properties[p]);
        continue;
      }
      const double value = cursor.number(element.properties[p].type);
      if (targets[p] >= 3) {
        data.fields[targets[p] - 3].values[static_cast<Eigen::Index>(i)] = value;
      } else if (std::isfinite(value)) {
        point[static_cast<Eigen::Index>(targets[p])] = value;
      } else {
        cursor.refuse("{} = {}: must be finite", element.properties[p].name, value);
      }
    }
  }
}

bool holds_corners(const Property& property) {
  return property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
}

void read_faces(FileCursor& cursor, const Element& element, SurfaceData& data) {
  if (std::ranges::count_if(element.properties, holds_corners) != 1)
    cursor.refuse("faces must have one list vertex_indices");
  for (std::size_t i = 0; i < element.count; ++i) {
    cursor.enter("face", i, element.count);
    for (const Property& property : element.properties) {
      if (!holds_corners(property)) {
        skip(cursor, property);
        continue;
      }
      if (const std::size_t corners = list_size(cursor, property); corners != 3)
        cursor.refuse("{} corners: must be a triangle", corners);
      mesh::Corners& corners = data.triangles.emplace_back();
      for (mesh::NodeIndex& corner : corners)
        corner = cursor.index(property.type, data.points.size());
    }
  }
}

}  // namespace

SurfaceData parse_ply(const std::string& path, std::string_view bytes) {
  FileCursor cursor(path, bytes);
  SurfaceData data;
  for (const Element& element : read_header(cursor)) {
    if (element.name == "vertex") {
      read_vertices(cursor, element, path, data);
    } else if (element.name == "face") {
      read_faces(cursor, element, data);
    } else {
      for (std::size_t i = 0; i < element.count; ++i) {
        cursor.enter(element.name, i, element.count);
        for (const Property& property : element.properties) skip(cursor, property);
      }
    }
  }
  cursor.enter("faces");
  if (data.triangles.empty()) cursor.refuse("there are none: must be triangles");
  return data;
}

}  // namespace vesica::shapes
