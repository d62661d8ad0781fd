#include "coupling/subworld/ring.hpp"

#include <algorithm>
#include <iterator>

#include "cbm/contact.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/world/cell.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/triangle_contact.hpp"

namespace acinus::coupling {

CellSet unite(const CellSet& a, const CellSet& b) {
  CellSet all;
  std::ranges::set_union(a.dcm, b.dcm, std::back_inserter(all.dcm));
  std::ranges::set_union(a.cbm, b.cbm, std::back_inserter(all.cbm));
  return all;
}

CellSet subtract(const CellSet& a, const CellSet& b) {
  CellSet rest;
  std::ranges::set_difference(a.dcm, b.dcm, std::back_inserter(rest.dcm));
  std::ranges::set_difference(a.cbm, b.cbm, std::back_inserter(rest.cbm));
  return rest;
}

double contact_reach(const World& world) {
  const State& s = world.state;
  const Params& p = world.params;
  const std::vector<double> shell = dcm::reference_radii(s.dcm, s.clock.time),
                            sphere = cbm::radii_at(s.cbm, s.clock.time);
  cbm::Extremes extremes;
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) {
    if (!holds_points(world.ranks, s, cell_index(s, c))) continue;
    extremes.largest = std::max(extremes.largest, sphere[c]);
    extremes.softest = std::min(extremes.softest, s.cbm.young[c]);
  }
  if (s.near_set != 0)
    extremes = {-world.ranks.max(-extremes.softest), world.ranks.max(extremes.largest)};
  double reach = cbm::largest_separation(p.cbm, extremes, p.boundary) + p.cbm_contact.skin;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l))
      reach = std::max(reach, p.dcm_contact.skin +
                                  dcm::contact_range(p.dcm_contact,
                                                     *s.dcm.group[l / kLanes].topology, shell[l]));
  if (p.dcm_contact.law == dcm::ContactLaw::kMaugisDugdale)
    reach = std::max(reach, p.dcm_contact.skin +
                                dcm::triangle_reach({s.dcm, p.dcm, p.dcm_contact, {}, p.boundary}));
  return reach;
}

CellSet find_ring(const World& world, const CellSet& cells) {
  const double reach = contact_reach(world);
  const CellSet near = find_neighbours(world, cells, reach);
  if (near.cbm.empty()) return near;
  const CellSet next = find_neighbours(world, {{}, near.cbm}, reach);
  return subtract(unite(near, next), cells);
}

}  // namespace acinus::coupling
