#include <array>
#include <optional>
#include <utility>

#include "shapes/formats/cells.hpp"
#include "shapes/formats/file_cursor.hpp"

namespace vesica::shapes {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 12> type_names = {
    {{"char", NumberType::i8},
     {"unsigned_char", NumberType::u8},
     {"short", NumberType::i16},
     {"unsigned_short", NumberType::u16},
     {"int", NumberType::i32},
     {"vtkIdType", NumberType::i32},
     {"unsigned_int", NumberType::u32},
     {"long", NumberType::i64},
     {"vtktypeint64", NumberType::i64},
     {"unsigned_long", NumberType::u64},
     {"float", NumberType::f32},
     {"double", NumberType::f64}}};

/// Reads a legacy file of VTK (docs.vtk.org, "VTK legacy file format").
class VtkReader {
 public:
  VtkReader(const std::string& path, std::string_view bytes) : path_(path), cursor_(path, bytes) {}

  SurfaceData read() {
    read_header();
    while (!cursor_.is_at_end()) read_section();
    cursor_.enter("cells");
    const auto refuse = [this](const std::string& text) { cursor_.refuse("{}", text); };
    add_cells(cells_, data_, refuse);
    return std::move(data_);
  }

 private:
  void read_header() {
    cursor_.enter("header");
    const std::string first(cursor_.line());
    constexpr std::string_view start = "# vtk DataFile Version ";
    if (!first.starts_with(start))
      cursor_.refuse("the first line must be '{}' and a number", start);
    has_offsets_ = first[start.size()] >= '5';
    (void)cursor_.line();
    const std::string encoding(cursor_.word());
    if (encoding != "ASCII" && encoding != "BINARY")
      cursor_.refuse("'{}': must be ASCII or BINARY", encoding);
    if (encoding == "BINARY") cursor_.encoding = Encoding::big_endian;
    if (cursor_.word() != "DATASET") cursor_.refuse("must be DATASET");
    dataset_ = cursor_.word();
    if (dataset_ != "UNSTRUCTURED_GRID" && dataset_ != "POLYDATA")
      cursor_.refuse("DATASET {}: must be UNSTRUCTURED_GRID or POLYDATA", dataset_);
  }

  void read_section() {
    cursor_.enter("");
    const std::string keyword(cursor_.word());
    cursor_.enter(keyword);
    if (keyword == "POINTS") {
      read_points();
    } else if (keyword == "CELLS" || keyword == "POLYGONS") {
      read_cells(cells_);
    } else if (keyword == "CELL_TYPES") {
      cells_.types = numbers(cursor_.count(), NumberType::i32);
    } else if (keyword == "VERTICES" || keyword == "LINES") {
      Cells passed_over;
      read_cells(passed_over);
    } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
      is_point_data_ = keyword == "POINT_DATA";
      num_tuples_ = cursor_.count();
    } else if (keyword == "METADATA") {
      (void)cursor_.line();
      while (!cursor_.is_at_end() && !cursor_.line().empty()) continue;
    } else {
      read_attribute(keyword);
    }
  }

  void read_points() {
    const std::size_t count = cursor_.count();
    const NumberType type = number_type();
    (void)cursor_.line();
    for (std::size_t i = 0; i < count; ++i) {
      cursor_.enter("point", i, count);
      data_.points.push_back(cursor_.point(type));
    }
  }

  /// Before version 5 each cell has its size in front; since then there are offsets.
  void read_cells(Cells& cells) {
    const std::size_t first = cursor_.count();
    const std::size_t second = cursor_.count();
    if (has_offsets_) {
      if (cursor_.word() != "OFFSETS") cursor_.refuse("must be OFFSETS");
      const NumberType type = number_type();
      cells.offsets = numbers(first, type);
      if (cursor_.word() != "CONNECTIVITY") cursor_.refuse("must be CONNECTIVITY");
      const NumberType connectivity_type = number_type();
      cells.connectivity = numbers(second, connectivity_type);
      return;
    }
    const std::vector<double> list = numbers(second, NumberType::i32);
    cells.offsets = {0};
    std::size_t i = 0;
    while (i < list.size()) {
      if (!(list[i] >= 0 && list[i] < static_cast<double>(list.size() - i)))
        cursor_.refuse("a cell of {} points: must fit the {} numbers", list[i], second);
      const auto end = i + 1 + static_cast<std::size_t>(list[i]);
      for (++i; i < end; ++i) cells.connectivity.push_back(list[i]);
      cells.offsets.push_back(static_cast<double>(cells.connectivity.size()));
    }
    if (cells.offsets.size() != first + 1)
      cursor_.refuse("{} cells: must be {}", cells.offsets.size() - 1, first);
  }

  void read_attribute(const std::string& keyword) {
    if (!num_tuples_) cursor_.refuse("must be a section of the geometry, POINT_DATA or CELL_DATA");
    if (keyword == "FIELD") return read_fields();
    const std::string name(cursor_.word());
    if (keyword == "SCALARS") return read_scalars(name);
    if (keyword == "LOOKUP_TABLE") {
      (void)numbers(4 * cursor_.count(), in_text() ? NumberType::f32 : NumberType::u8);
    } else if (keyword == "COLOR_SCALARS") {
      (void)numbers(cursor_.count() * *num_tuples_, in_text() ? NumberType::f32 : NumberType::u8);
    } else if (keyword == "TEXTURE_COORDINATES") {
      const std::size_t dimension = cursor_.count();
      add(name, dimension, *num_tuples_, number_type());
    } else if (const std::size_t size = components(keyword); size > 0) {
      add(name, size, *num_tuples_, number_type());
    } else {
      cursor_.refuse("is no section of a {} that is read here", dataset_);
    }
  }

  static std::size_t components(const std::string& keyword) {
    if (keyword == "VECTORS" || keyword == "NORMALS") return 3;
    if (keyword == "TENSORS") return 9;
    return keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS" ? 1 : 0;
  }

  void read_scalars(const std::string& name) {
    const NumberType type = number_type();
    std::size_t size = 1;
    std::string word(cursor_.word());
    if (word != "LOOKUP_TABLE") {
      if (word.size() != 1 || word[0] < '1' || word[0] > '9')
        cursor_.refuse("'{}': must be a number of components or LOOKUP_TABLE", word);
      size = static_cast<std::size_t>(word[0] - '0');
      if (cursor_.word() != "LOOKUP_TABLE") cursor_.refuse("must be LOOKUP_TABLE");
    }
    (void)cursor_.word();
    add(name, size, *num_tuples_, type);
  }

  void read_fields() {
    (void)cursor_.word();
    const std::size_t count = cursor_.count();
    for (std::size_t i = 0; i < count; ++i) {
      std::string name(cursor_.word());
      if (name == "METADATA") {
        (void)cursor_.line();
        while (!cursor_.line().empty()) continue;
        name = cursor_.word();
      }
      const std::size_t components = cursor_.count();
      const std::size_t tuples = cursor_.count();
      add(name, components, tuples, number_type());
    }
  }

  /// Reads an array; scalars at the points are kept.
  void add(const std::string& name, std::size_t components, std::size_t tuples, NumberType type) {
    cursor_.enter("array '" + name + "'");
    const std::vector<double> values = numbers(components * tuples, type);
    if (!is_point_data_ || components != 1) return;
    if (tuples != data_.points.size())
      cursor_.refuse("{} values: must be one for each of the {} points", tuples,
                     data_.points.size());
    data_.fields.push_back(
        {name, path_ + ": point field '" + name + "'",
         Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(tuples))});
  }

  [[nodiscard]] bool in_text() const { return cursor_.encoding == Encoding::text; }

  NumberType number_type() {
    const std::string_view word = cursor_.word();
    for (const auto& [name, type] : type_names) {
      if (name == word) return type;
    }
    cursor_.refuse("type '{}': must be a number type of VTK, as float or vtktypeint64", word);
  }

  /// Behind the rest of the line.
  std::vector<double> numbers(std::size_t count, NumberType type) {
    if (!in_text()) (void)cursor_.line();
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) values.push_back(cursor_.number(type));
    return values;
  }

  std::string path_;
  FileCursor cursor_;
  SurfaceData data_;
  Cells cells_;
  std::string dataset_;
  bool has_offsets_ = false;
  bool is_point_data_ = false;
  std::optional<std::size_t> num_tuples_;
};

}  // namespace

SurfaceData parse_vtk(const std::string& path, std::string_view bytes) {
  return VtkReader(path, bytes).read();
}

}  // namespace vesica::shapes
