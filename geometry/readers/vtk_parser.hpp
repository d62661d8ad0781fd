#pragma once
/// Parser of read_vtk_legacy, in three files: vtk_parser.cpp reads the header and the order of
/// sections, vtk_cells.cpp lists of cells, vtk_attributes.cpp data of points and cells.

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "geometry/readers/vtk_dataset.hpp"
#include "geometry/readers/vtk_types.hpp"

namespace acinus::geometry {

class VtkParser {
 public:
  explicit VtkParser(VtkLegacy& out) : out_(out), file_(out.file) {}

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
  void check_owner(const std::string& keyword);
  void check_order(const std::string& keyword);
  void scalars();
  void field();
  void metadata();
  void keep(VtkArray array);

  VtkLegacy& out_;
  InputFile& file_;
  bool seen_points_ = false;
  std::vector<std::string> seen_;  ///< sections of points and cells, in lower case
  Attributes attributes_ = Attributes::kNone;
  std::uint64_t n_tuple_ = 0;
};

template <class Value>
std::vector<Value> VtkParser::values(const VtkType& info, std::uint64_t n, std::uint64_t components,
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

}  // namespace acinus::geometry
