#include "runs/assemble/placing_advice.hpp"

#include <algorithm>

namespace acinus::runs {

std::vector<std::string> list_smaller_starts(const Scene& scene) {
  std::vector<std::string> ways{"Let the cells grow from small ones first (start_up.enabled)"};
  const auto has_any_age = [](const auto& type) {
    return type.second.cycle.time > 0 && type.second.cycle.random_start;
  };
  if (std::ranges::any_of(scene.cell_types, has_any_age))
    ways.emplace_back(
        "start them just born (cycle.start = birth; random ones have up to twice the "
        "volume)");
  return ways;
}

// Clumps and boxes are laid out in diameters of their cells, so neither fewer nor smaller cells do
// it there.
std::string advise_spacing(const Scene& scene) {
  switch (scene.cells.source) {
    case CellSource::kList:
      return "move them apart or give them a smaller radius (cells.list)";
    case CellSource::kClump:
    case CellSource::kBox:
      return "place them farther apart (cells.spacing)";
    case CellSource::kFill:
      return "place fewer of them farther apart (cells.count, cells.min_distance), or take smaller "
             "ones (radius of the cell type)";
    case CellSource::kMeshes:
      return "move their surfaces apart (cells.file)";
    case CellSource::kLobule:
      break;
  }
  return "place fewer of them farther apart (lobule.cells, lobule.min_distance), or take smaller "
         "ones (radius of the cell type)";
}

}  // namespace acinus::runs
