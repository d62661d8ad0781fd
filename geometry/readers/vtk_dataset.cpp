#include "geometry/readers/vtk_dataset.hpp"

#include <fmt/format.h>

#include <string_view>

namespace acinus::geometry {

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
    const std::int64_t index = list.index[k];
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
  std::string_view start = file.bytes();
  if (start.starts_with("\xef\xbb\xbf")) start.remove_prefix(3);
  return lower_case(start.substr(0, 14)) == "# vtk datafile";
}

}  // namespace acinus::geometry
