#include "geometry/readers/vtk_parser.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "geometry/readers/vtk_types.hpp"

namespace acinus::geometry {

void VtkParser::cells(VtkCells& list, const std::string& keyword) {
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

void VtkParser::packed_cells(VtkCells& list, std::uint64_t n_cell, std::uint64_t size,
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
    at += packed[at] + 1;
  }
  if (at != size) {
    file_.fail_at(
        out_.position(list.place, at),
        fmt::format("{} holds {} cells that use {} values, but its header says {}. Its counts are "
                    "inconsistent: write the file again.",
                    keyword, n_cell, at, size));
  }
}

void VtkParser::offset_cells(VtkCells& list, std::uint64_t n_offset, std::uint64_t size,
                             const std::string& keyword) {
  file_.next_token();
  const VtkType& offset_type = type(keyword + " OFFSETS");
  start_data();
  VtkPlace place;
  const auto offset = values<std::int64_t>(offset_type, n_offset, 1, keyword + " OFFSETS", place);
  const std::string_view token = file_.next_token();
  if (token != "CONNECTIVITY") {
    file_.fail(
        fmt::format("found {} where CONNECTIVITY of {} is expected.", in_quotes(token), keyword));
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
    list.token.push_back(low);
    list.start.push_back(offset[c]);
  }
  if (list.start.back() != static_cast<std::int64_t>(size)) {
    file_.fail_at(place.begin,
                  fmt::format("the last offset of {} is {} but CONNECTIVITY has {} values. Write "
                              "the file again.",
                              keyword, list.start.back(), size));
  }
}

void VtkParser::cell_types() {
  static constexpr VtkType kInt = {"int", 4, VtkType::kSigned};
  const std::uint64_t n = count("the number of CELL_TYPES");
  start_data();
  VtkPlace place;
  out_.cell_type = values<std::int64_t>(kInt, n, 1, "CELL_TYPES", place);
}

}  // namespace acinus::geometry
