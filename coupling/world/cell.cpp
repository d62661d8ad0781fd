#include "coupling/world/cell.hpp"

namespace acinus::coupling {

std::vector<Cell> list_cells(const State& s) {
  std::vector<Cell> cells;
  for_each_cell(s, [&](const Cell& c) { cells.push_back(c); });
  return cells;
}

CellIndex index_cells(const State& s) {
  CellIndex index;
  for_each_cell(s, [&](const Cell& c) { index.emplace(lineage_of(s, c), c); });
  return index;
}

std::optional<Cell> find_cell(const State& s, std::int64_t lineage) {
  std::optional<Cell> found;
  for_each_cell(s, [&](const Cell& c) {
    if (!found && lineage_of(s, c) == lineage) found = c;
  });
  return found;
}

}  // namespace acinus::coupling
