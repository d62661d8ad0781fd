#include "coupling/step/clearance.hpp"

#include "dcm/contact/contact.hpp"

namespace acinus::coupling {

bool is_clear(const World& world, const Workspace& w, std::size_t body, double distance) {
  const State& s = world.state;
  const contact::SurfaceBody& b = w.dcm.body[body];
  const double radius = w.lanes.radius[w.dcm.lane_of_body[body]];
  const double range = dcm::contact_range(world.params.dcm_contact, *b.topology, radius);
  const Box box = b.box.grown(2 * distance + range);
  for (std::size_t k = 0; k < w.dcm.body.size(); ++k)
    if (k != body && box.overlaps(w.dcm.body[k].box)) return false;
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) {
    if (box.overlaps(sphere_box(cbm::center_of(s.cbm, c), w.cbm_radius[c]))) return false;
  }
  const contact::Boundary& boundary = world.params.boundary;
  // Vessels and meshes are not tested one by one: cells near them keep the displacement limit.
  if (!boundary.meshes.empty() || !boundary.vessels.network.segment.empty()) return false;
  bool clear = true;
  const double reach = 0.5 * (box.high - box.low).norm();
  contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
    clear =
        clear && contact::gap_to_wall(wall, 0.5 * (box.low + box.high), s.clock.time).gap > reach;
  });
  return clear;
}

}  // namespace acinus::coupling
