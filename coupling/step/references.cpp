#include "coupling/step/references.hpp"

#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "dcm/loads/loads.hpp"

namespace acinus::coupling {

namespace {

/// Sizes of the spheres that have numbers on this process, their strengths if one is not 1, and
/// then their mothers.
void refresh_spheres(const State& at, double end, Workspace& w) {
  const cbm::State& s = at.cbm;
  const std::size_t n = s.n_cell();
  const auto for_each_present = [&](const auto& f) {
    for_each_index(n, worth_threads(s.n_row()), [&](std::size_t c) {
      if (!w.cbm.is_absent(c)) f(c);
    });
  };
  set_size(w.cbm_radius, n);
  for_each_present([&](std::size_t c) { w.cbm_radius[c] = sphere_radius(s.volume[c].at(end)); });
  bool are_strong = true;
  for (std::size_t c = 0; c < n && are_strong; ++c)
    are_strong = w.cbm.is_absent(c) || s.strength[c].at(end) == 1;
  set_size(w.cbm_strength, are_strong ? 0 : n);
  set_size(w.cbm_mother, are_strong || at.cycle.empty() ? 0 : n);
  if (are_strong) return;
  for_each_present([&](std::size_t c) { w.cbm_strength[c] = s.strength[c].at(end); });
  if (at.cycle.empty()) return;
  for_each_present([&](std::size_t c) { w.cbm_mother[c] = at.cycle[at.dcm.n_lane() + c].parent; });
}

}  // namespace

void refresh_references(const World& world, const State& at, double end, Workspace& w) {
  if (!at.tree.node.empty()) {
    if (!w.boundary) w.boundary = world.params.boundary;
    place_vessels(world.params.tree, at.tree, w.boundary->vessels);
  }
  dcm::refresh_lane_data(at.dcm, end, w.lanes, w.dcm.ghost);
  refresh_spheres(at, end, w);
}

}  // namespace acinus::coupling
