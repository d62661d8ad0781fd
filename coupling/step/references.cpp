#include "coupling/step/references.hpp"

#include "cbm/pair_kernel.hpp"
#include "dcm/loads/loads.hpp"

namespace acinus::coupling {

void refresh_references(const World& world, const State& at, double end, Workspace& w) {
  if (!at.tree.node.empty()) {
    if (!w.boundary) w.boundary = world.params.boundary;
    place_vessels(world.params.tree, at.tree, w.boundary->vessels);
  }
  dcm::refresh_lane_data(at.dcm, end, w.lanes, w.dcm.ghost);
  cbm::refresh_radii(at.cbm, end, w.cbm_radius);
  cbm::refresh_strengths(at.cbm, end, w.cbm_strength);
  w.cbm_mother.clear();
  if (w.cbm_strength.empty() || at.cycle.empty()) return;
  for (std::size_t c = 0; c < at.cbm.n_cell(); ++c)
    w.cbm_mother.push_back(at.cycle[at.dcm.n_lane() + c].parent);
}

}  // namespace acinus::coupling
