#include "core/mesh/vtk_legacy.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/mesh/vtk_types.hpp"

namespace acinus::mesh {

namespace {

class Parser {
 public:
  explicit Parser(VtkLegacy& out) : out_(out), file_(out.file) {}

  void header(const std::vector<std::string>& allowed, const std::string& remedy);
  void sections();

 private:
  enum class Attributes { kNone, kPoint, kCell };

  const VtkType& type(std::string_view what);
  std::uint64_t count(std::string_view what);
  void start_data();  // to the first byte after the line of a header in a binary file
  template <class Value>
  std::vector<Value> values(const VtkType& type, std::uint64_t n, std::uint64_t components,
                            const std::string& what, VtkPlace& place);
  void points();
  void cells(VtkCells& list, const std::string& keyword);
  void packed_cells(VtkCells& list, std::uint64_t n_cell, std::uint64_t size,
                    const std::string& keyword);
  void offset_cells(VtkCells& list, std::uint64_t n_offset, std::uint64_t size,
                    const std::string& keyword);
  void cell_types();
  void attribute_count(Attributes kind);
  bool attribute(const std::string& keyword);
  void scalars();
  void field();
  void metadata();
  void keep(VtkArray array);

  VtkLegacy& out_;
  InputFile& file_;
  bool seen_points_ = false;
  Attributes attributes_ = Attributes::kNone;
  std::uint64_t n_tuple_ = 0;
};

const VtkType& Parser::type(std::string_view what) {
  const std::string_view token = file_.next_token();
  if (const VtkType* found = find_vtk_type(token)) return *found;
  file_.fail(fmt::format(
      "{} has data type {}; allowed are float, double, (unsigned_)char, short, int, long, "
      "vtkIdType and vtktypeint64. Save the array with one of these, or leave it out.",
      what, quoted(token)));
}

std::uint64_t Parser::count(std::string_view what) {
  const std::int64_t n = file_.next_integer(what);
  // Node and segment indices are int in the program.
  if (n < 0 || n > std::numeric_limits<int>::max()) {
    file_.fail(
        fmt::format("{} is {}; allowed are 0 to {}.", what, n, std::numeric_limits<int>::max()));
  }
  return static_cast<std::uint64_t>(n);
}

void Parser::start_data() {
  if (file_.binary()) file_.next_line();
}

template <class Value>
std::vector<Value> Parser::values(const VtkType& info, std::uint64_t n, std::uint64_t components,
                                  const std::string& what, VtkPlace& place) {
  const bool text = !file_.binary();
  // A value of text takes a digit and a separator, only the last may lack the separator.
  if (!text || 2 * n * components > file_.remaining() + 1) {
    file_.check_room(n, text ? 2 * components : info.bytes * components, what);
  }
  place = {file_.position(), text ? 0 : info.bytes};
  const std::uint64_t total = n * components;
  const std::string item = "a value of " + what;
  std::vector<Value> value;
  value.reserve(text ? std::min<std::uint64_t>(total, file_.remaining() / 2 + 1) : total);
  for (std::uint64_t i = 0; i < total; ++i) {
    if (!text) {
      value.push_back(decode_vtk<Value>(file_.bytes().data() + place.begin + i * info.bytes, info));
    } else if constexpr (std::is_same_v<Value, double>) {
      value.push_back(file_.next_double(item));
    } else {
      value.push_back(file_.next_integer(item));
    }
  }
  if (!text) file_.set_position(place.begin + total * info.bytes);
  return value;
}

void Parser::header(const std::vector<std::string>& allowed, const std::string& remedy) {
  const std::string_view start = file_.bytes().substr(0, 512);
  if (start.find("<VTKFile") != start.npos || start.rfind("<?xml", 0) == 0) {
    file_.fail(
        "the file is VTK XML (.vtp, .vtu, ...), which is not read. Save it as legacy VTK (.vtk), "
        "for instance in ParaView: File > Save Data > \"Legacy VTK Files\".");
  }
  if (!is_vtk_legacy(file_)) {
    file_.fail(fmt::format(
        "the first line is {}; a legacy VTK file begins with \"# vtk DataFile Version\". "
        "Check that it is the file you meant.",
        quoted(file_.next_line())));
  }
  file_.next_line();
  file_.next_line();  // title, any text
  const std::string_view mode = file_.next_token();
  if (lower_case(mode) == "binary") {
    file_.next_line();
  } else if (lower_case(mode) != "ascii") {
    file_.fail(
        fmt::format("found {}; line 3 of a legacy VTK file says ASCII or BINARY.", quoted(mode)));
  }
  const std::string_view keyword = file_.next_token();
  if (lower_case(keyword) != "dataset") {
    file_.fail(fmt::format("found {} where DATASET is expected.", quoted(keyword)));
  }
  out_.dataset = file_.next_token();
  std::transform(out_.dataset.begin(), out_.dataset.end(), out_.dataset.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  if (std::find(allowed.begin(), allowed.end(), out_.dataset) == allowed.end()) {
    file_.fail(fmt::format("DATASET {} cannot be used here; allowed: {}. {}", quoted(out_.dataset),
                           fmt::join(allowed, ", "), remedy));
  }
  file_.set_binary(lower_case(mode) == "binary");
}

void Parser::sections() {
  static constexpr std::pair<const char*, void (*)(Parser&)> kSections[] = {
      {"points", [](Parser& p) { p.points(); }},
      {"vertices", [](Parser& p) { p.cells(p.out_.vertices, "VERTICES"); }},
      {"lines", [](Parser& p) { p.cells(p.out_.lines, "LINES"); }},
      {"polygons", [](Parser& p) { p.cells(p.out_.polygons, "POLYGONS"); }},
      {"triangle_strips", [](Parser& p) { p.cells(p.out_.strips, "TRIANGLE_STRIPS"); }},
      {"cells", [](Parser& p) { p.cells(p.out_.cells, "CELLS"); }},
      {"cell_types", [](Parser& p) { p.cell_types(); }},
      {"point_data", [](Parser& p) { p.attribute_count(Attributes::kPoint); }},
      {"cell_data", [](Parser& p) { p.attribute_count(Attributes::kCell); }},
      {"field", [](Parser& p) { p.field(); }},
      {"metadata", [](Parser& p) { p.metadata(); }}};
  for (std::string_view token = file_.next_token(); !token.empty(); token = file_.next_token()) {
    const std::string keyword = lower_case(token);
    const auto* section = std::find_if(std::begin(kSections), std::end(kSections),
                                       [&](const auto& entry) { return keyword == entry.first; });
    if (section != std::end(kSections)) {
      section->second(*this);
    } else if (!attribute(keyword)) {
      file_.fail(
          fmt::format("found {} where a section keyword (POINTS, LINES, POINT_DATA, ...) is "
                      "expected. The count of the section before is wrong or the file is "
                      "damaged.",
                      quoted(token)));
    }
  }
  if (!seen_points_) file_.fail("the file has no POINTS section. Save it with its points.");
  if (out_.cell_type.size() != out_.cells.size()) {
    file_.fail(
        fmt::format("CELLS has {} cells but CELL_TYPES {}; both must be there with equal counts.",
                    out_.cells.size(), out_.cell_type.size()));
  }
}

void Parser::points() {
  const std::uint64_t n = count("the number of POINTS");
  const VtkType& info = type("POINTS");
  start_data();
  VtkPlace place;
  const std::vector<double> xyz = values<double>(info, n, 3, "POINTS", place);
  out_.point.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    out_.point[i] = Vec3(xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]);
    if (out_.point[i].allFinite()) continue;
    file_.fail_at(
        out_.position(place, 3 * i),
        fmt::format(
            "node {} has the coordinates ({}, {}, {}); they must be finite numbers. Repair or "
            "remove the node.",
            i, xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]));
  }
  seen_points_ = true;
}

void Parser::cells(VtkCells& list, const std::string& keyword) {
  const std::uint64_t n = count(fmt::format("the number of {}", keyword));
  const std::uint64_t size = count(fmt::format("the size of {}", keyword));
  list = VtkCells{};
  start_data();
  if (file_.peek_token() == "OFFSETS") {
    offset_cells(list, n, size, keyword);
  } else {
    packed_cells(list, n, size, keyword);
  }
}

void Parser::packed_cells(VtkCells& list, std::uint64_t n_cell, std::uint64_t size,
                          const std::string& keyword) {
  static constexpr VtkType kInt = {"int", 4, VtkType::kSigned};
  const std::vector<std::int64_t> packed = values<std::int64_t>(kInt, size, 1, keyword, list.place);
  std::size_t at = 0;
  for (std::uint64_t c = 0; c < n_cell; ++c) {
    if (at >= size || packed[at] < 0 || packed[at] > static_cast<std::int64_t>(size - at - 1)) {
      file_.fail_at(
          out_.position(list.place, std::min<std::size_t>(at, size ? size - 1 : 0)),
          fmt::format(
              "cell {} of {} has {} entries, more than the section's size {} leaves. Its counts "
              "are inconsistent: write the file again.",
              c, keyword, at < size ? packed[at] : 0, size));
    }
    const auto begin = packed.begin() + static_cast<std::ptrdiff_t>(at) + 1;
    list.token.push_back(at);
    list.index.insert(list.index.end(), begin, begin + packed[at]);
    list.start.push_back(static_cast<std::int64_t>(list.index.size()));
    at += static_cast<std::size_t>(packed[at]) + 1;
  }
  if (at != size) {
    file_.fail_at(
        out_.position(list.place, at),
        fmt::format("{} holds {} cells that use {} values, but its header says {}. Its counts are "
                    "inconsistent: write the file again.",
                    keyword, n_cell, at, size));
  }
}

void Parser::offset_cells(VtkCells& list, std::uint64_t n_offset, std::uint64_t size,
                          const std::string& keyword) {
  file_.next_token();
  const VtkType& offset_type = type(keyword + " OFFSETS");
  start_data();
  VtkPlace place;
  const auto offset = values<std::int64_t>(offset_type, n_offset, 1, keyword + " OFFSETS", place);
  const std::string_view token = file_.next_token();
  if (token != "CONNECTIVITY") {
    file_.fail(
        fmt::format("found {} where CONNECTIVITY of {} is expected.", quoted(token), keyword));
  }
  const VtkType& index_type = type(keyword + " CONNECTIVITY");
  start_data();
  list.index = values<std::int64_t>(index_type, size, 1, keyword + " CONNECTIVITY", list.place);
  for (std::size_t c = 0; c < offset.size(); ++c) {
    const std::int64_t low = c == 0 ? 0 : offset[c - 1];
    const auto high = static_cast<std::int64_t>(c == 0 ? 0 : size);
    if (offset[c] < low || offset[c] > high) {
      file_.fail_at(
          out_.position(place, c),
          fmt::format("offset {} of {} is {}; allowed are {} to {}. Write the file again.", c,
                      keyword, offset[c], low, high));
    }
    if (c == 0) continue;
    list.token.push_back(static_cast<std::size_t>(low));
    list.start.push_back(offset[c]);
  }
  if (list.start.back() != static_cast<std::int64_t>(size)) {
    file_.fail_at(place.begin,
                  fmt::format("the last offset of {} is {} but CONNECTIVITY has {} values. Write "
                              "the file again.",
                              keyword, list.start.back(), size));
  }
}

void Parser::cell_types() {
  static constexpr VtkType kInt = {"int", 4, VtkType::kSigned};
  const std::uint64_t n = count("the number of CELL_TYPES");
  start_data();
  VtkPlace place;
  out_.cell_type = values<std::int64_t>(kInt, n, 1, "CELL_TYPES", place);
}

void Parser::attribute_count(Attributes kind) {
  const std::string name = kind == Attributes::kPoint ? "POINT_DATA" : "CELL_DATA";
  attributes_ = kind;
  n_tuple_ = count("the count of " + name);
  const std::size_t n_cell = out_.vertices.size() + out_.lines.size() + out_.polygons.size() +
                             out_.strips.size() + out_.cells.size();
  const std::size_t expected = kind == Attributes::kPoint ? out_.point.size() : n_cell;
  if (n_tuple_ != expected) {
    file_.fail(
        fmt::format("{} says {} values per array, but the file has {} {}. The two must be equal.",
                    name, n_tuple_, expected, kind == Attributes::kPoint ? "points" : "cells"));
  }
}

void Parser::keep(VtkArray array) {
  if (attributes_ == Attributes::kPoint) out_.point_data.push_back(std::move(array));
  if (attributes_ == Attributes::kCell) out_.cell_data.push_back(std::move(array));
}

bool Parser::attribute(const std::string& keyword) {
  static constexpr VtkType kByte = {"unsigned_char", 1, VtkType::kUnsigned};
  if (keyword == "scalars") {
    scalars();
    return true;
  }
  // Components by keyword; 0 = told in the header line.
  static constexpr std::pair<const char*, int> kKinds[] = {
      {"vectors", 3},       {"normals", 3},
      {"tensors", 9},       {"tensors6", 6},
      {"global_ids", 1},    {"pedigree_ids", 1},
      {"edge_flags", 1},    {"lookup_table", 4},
      {"color_scalars", 0}, {"texture_coordinates", 0}};
  const auto* kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const auto& entry) { return keyword == entry.first; });
  if (kind == std::end(kKinds)) return false;
  VtkArray array;
  array.name = decode_vtk_name(file_.next_token());
  const std::string what = "array " + quoted(array.name);
  const bool table = keyword == "lookup_table";
  const std::uint64_t n = table ? count("the size of " + what) : n_tuple_;
  const auto components = kind->second > 0 ? static_cast<std::uint64_t>(kind->second)
                                           : count("the number of components of " + what);
  const VtkType& info = table || keyword == "color_scalars" ? kByte : type(what);
  start_data();
  array.components = static_cast<int>(components);
  array.value = values<double>(info, n, components, what, array.place);
  if (!table) keep(std::move(array));
  return true;
}

void Parser::scalars() {
  VtkArray array;
  array.name = decode_vtk_name(file_.next_token());
  const std::string what = "array " + quoted(array.name);
  const VtkType& info = type(what);
  const std::string rest(file_.next_line());
  const std::size_t digit = rest.find_first_not_of(" \t");
  std::int64_t components = 1;
  if (digit != rest.npos) {
    const std::string number = rest.substr(digit, rest.find_last_not_of(" \t") - digit + 1);
    if (!parse_integer(number, components) || components < 1 || components > 4) {
      file_.fail(fmt::format("{} has {} components as SCALARS; allowed are 1 to 4.", what,
                             quoted(number)));
    }
  }
  if (file_.peek_token() == "LOOKUP_TABLE") {
    file_.next_token();
    file_.next_line();
  }
  array.components = static_cast<int>(components);
  array.value =
      values<double>(info, n_tuple_, static_cast<std::uint64_t>(components), what, array.place);
  keep(std::move(array));
}

void Parser::field() {
  file_.next_token();  // the field's own name, always FieldData
  const std::uint64_t n_array = count("the number of arrays of FIELD");
  for (std::uint64_t a = 0; a < n_array; ++a) {
    std::string_view token = file_.next_token();
    if (lower_case(token) == "metadata") {
      metadata();
      token = file_.next_token();
    }
    if (token.empty())
      file_.fail(fmt::format("FIELD announces {} arrays but the file ends after {}.", n_array, a));
    VtkArray array;
    array.name = decode_vtk_name(token);
    const std::string what = "array " + quoted(array.name);
    const std::uint64_t components = count("the number of components of " + what);
    const std::uint64_t n = count("the number of tuples of " + what);
    const VtkType& info = type(what);
    start_data();
    array.components = static_cast<int>(components);
    array.value = values<double>(info, n, components, what, array.place);
    if (attributes_ != Attributes::kNone && n != n_tuple_) {
      file_.fail_at(array.place.begin,
                    fmt::format("{} has {} tuples where {} are expected, one per {}.", what, n,
                                n_tuple_, attributes_ == Attributes::kPoint ? "point" : "cell"));
    }
    keep(std::move(array));
  }
}

void Parser::metadata() {  // text up to a blank line, in binary files too
  file_.next_line();
  while (file_.remaining() > 0) {
    if (file_.next_line().find_first_not_of(" \t") == std::string_view::npos) return;
  }
}

}  // namespace

std::size_t VtkLegacy::position(const VtkPlace& place, std::size_t i) const {
  return place.value_bytes > 0 ? place.begin + i * place.value_bytes
                               : file.token_position(place.begin, i);
}

std::size_t VtkLegacy::position(const VtkCells& list, std::size_t c) const {
  return position(list.place, list.token[c]);
}

std::vector<int> VtkLegacy::nodes_of(const VtkCells& list, std::size_t c,
                                     const std::string& what) const {
  std::vector<int> node;
  for (std::int64_t k = list.start[c]; k < list.start[c + 1]; ++k) {
    const std::int64_t index = list.index[static_cast<std::size_t>(k)];
    if (index < 0 || index >= static_cast<std::int64_t>(point.size())) {
      file.fail_at(
          position(list, c),
          fmt::format(
              "{} uses node {}, but the file has {} points, numbered from 0. Correct the index.",
              what, index, point.size()));
    }
    node.push_back(static_cast<int>(index));
  }
  return node;
}

bool is_vtk_legacy(const InputFile& file) {
  return lower_case(file.bytes().substr(0, 14)) == "# vtk datafile";
}

VtkLegacy read_vtk_legacy(const std::string& path, const std::vector<std::string>& allowed,
                          const std::string& remedy) {
  VtkLegacy out(path);
  Parser parser(out);
  parser.header(allowed, remedy);
  parser.sections();
  return out;
}

}  // namespace acinus::mesh
