#include "geometry/readers/vtk_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "geometry/readers/vtk_types.hpp"

namespace acinus::geometry {

void VtkParser::attribute_count(Attributes kind) {
  const std::string name = kind == Attributes::kPoint ? "POINT_DATA" : "CELL_DATA";
  if (!seen_points_)
    file_.fail(name +
               " stands before POINTS; data come behind the points and cells that they "
               "belong to. Write the file again.");
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

void VtkParser::keep(VtkArray array) {
  if (attributes_ == Attributes::kPoint) out_.point_data.push_back(std::move(array));
  if (attributes_ == Attributes::kCell) out_.cell_data.push_back(std::move(array));
}

void VtkParser::check_owner(const std::string& keyword) {
  if (attributes_ == Attributes::kNone)
    file_.fail(
        fmt::format("{} stands before POINT_DATA and CELL_DATA, so nothing says what it "
                    "belongs to. Write the file again.",
                    in_quotes(keyword)));
}

bool VtkParser::attribute(const std::string& keyword) {
  static constexpr VtkType kByte = {"unsigned_char", 1, VtkType::kUnsigned};
  if (keyword == "scalars") {
    check_owner(keyword);
    scalars();
    return true;
  }
  // Components by keyword; 0: given in the header line.
  static constexpr std::pair<const char*, int> kKinds[] = {
      {"vectors", 3},       {"normals", 3},
      {"tensors", 9},       {"tensors6", 6},
      {"global_ids", 1},    {"pedigree_ids", 1},
      {"edge_flags", 1},    {"lookup_table", 4},
      {"color_scalars", 0}, {"texture_coordinates", 0}};
  const auto* kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const auto& entry) { return keyword == entry.first; });
  if (kind == std::end(kKinds)) return false;
  const bool table = keyword == "lookup_table";
  if (!table) check_owner(keyword);
  VtkArray array;
  array.name = decode_vtk_name(file_.next_token());
  const std::string what = "array " + in_quotes(array.name);
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

void VtkParser::scalars() {
  VtkArray array;
  array.name = decode_vtk_name(file_.next_token());
  const std::string what = "array " + in_quotes(array.name);
  const VtkType& info = type(what);
  const std::string rest(file_.next_line());
  const std::size_t digit = rest.find_first_not_of(" \t");
  std::int64_t components = 1;
  if (digit != rest.npos) {
    const std::string number = rest.substr(digit, rest.find_last_not_of(" \t") - digit + 1);
    if (!parse_integer(number, components) || components < 1 || components > 4) {
      file_.fail(fmt::format("{} has {} components as SCALARS; allowed are 1 to 4.", what,
                             in_quotes(number)));
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

void VtkParser::field() {
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
    const std::string what = "array " + in_quotes(array.name);
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

void VtkParser::metadata() {  // text up to a blank line, in binary files too
  file_.next_line();
  while (file_.remaining() > 0) {
    if (file_.next_line().find_first_not_of(" \t") == std::string_view::npos) return;
  }
}

}  // namespace acinus::geometry
