#include "coupling/measure/cell_numbers.hpp"

#include "coupling/step/ghost_cells.hpp"

namespace acinus::coupling {

CellNumbers number_cells(const State& s, const Workspace& w) {
  CellNumbers n;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (!s.dcm.active(lane)) continue;
    const std::size_t body = n.of_body.size();
    if (body < w.dcm.lane_of_body.size() && w.dcm.lane_of_body[body] == lane)
      n.of_body.push_back(n.lane.size());
    n.lane.push_back(lane);
  }
  return n;
}

int owner_of_number(const CellNumbers& n, const Workspace& w, std::size_t cell) {
  return owner_of_lane(w, cell < n.lane.size() ? n.lane[cell] : w.dcm_lanes + cell - n.lane.size());
}

bool is_own_number(const CellNumbers& n, const Workspace& w, std::size_t cell) {
  const solve::Ownership& ownership = w.system.ownership;
  return ownership.is_whole() || owner_of_number(n, w, cell) == ownership.ranks.rank();
}

}  // namespace acinus::coupling
