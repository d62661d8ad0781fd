#include "cbm/state.hpp"

#include <cmath>

namespace acinus::cbm {

State make_state(const std::vector<NewCell>& cells) {
  State s;
  s.position.assign((cells.size() + kLanes - 1) / kLanes * kPointStride, 0.0);
  s.lineage.reserve(cells.size());
  s.type.reserve(cells.size());
  s.volume.reserve(cells.size());
  s.young.reserve(cells.size());
  s.pull.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    store_point(s.position.data(), cell_address(0, c), cells[c].center);
    s.lineage.push_back(cells[c].lineage);
    s.type.push_back(cells[c].type);
    s.volume.push_back(Ramp::constant(4.0 / 3 * kPi * std::pow(cells[c].radius, 3)));
    s.young.push_back(cells[c].young);
    s.pull.push_back(cells[c].pull);
  }
  return s;
}

std::vector<double> radii_at(const State& s, double time) {
  std::vector<double> r(s.n_cell());
  for (std::size_t c = 0; c < r.size(); ++c)
    r[c] = std::cbrt(s.volume[c].at(time) / (4.0 / 3 * kPi));
  return r;
}

std::vector<solve::Block> make_blocks(const State& s) {
  static const solve::BlockPattern kSinglePoint{1, {}, {}, {}};
  solve::Block block;
  block.pattern = &kSinglePoint;
  return std::vector<solve::Block>(s.n_row(), block);
}

}  // namespace acinus::cbm
