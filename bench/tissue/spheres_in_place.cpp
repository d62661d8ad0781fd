#include "bench/tissue/spheres_in_place.hpp"

#include <algorithm>

#include "coupling/measure/measure.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::bench {
namespace {

/// Relative overlap d of every cell, with the other cells, planes, capsules and vessels.
std::vector<double> find_crowding(const JudgedCells& cells, double time,
                                  const contact::Boundary& boundary) {
  std::vector<double> out;
  for (const auto& [id, c] : cells) {
    double& own = out.emplace_back(0);
    const auto count = [&](double overlap) { own += std::max(0.0, overlap) / cbm::kNeighbours; };
    for (const auto& [other, o] : cells)
      if (other != id) count(1 - (c.center - o.center).norm() / (c.radius + o.radius));
    const auto add = [&](const contact::Gap& g) { count(1 - g.gap / c.radius); };
    contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
      add(contact::gap_to_wall(wall, c.center, time));
    });
    const geometry::Network& network = boundary.vessels.network;
    for (int k = 0; k < static_cast<int>(network.segment.size()); ++k) {
      const contact::Gap g = contact::gap_to_segment(network, k, c.center);
      if (contact::is_local_minimum(boundary.vessels, k, c.center, g)) add(g);
    }
  }
  return out;
}

/// Sets the spheres of the world, with moduli set directly for laws the program does not have.
void place(const JudgedCells& cells, double time, const SphereLaw& law, coupling::World& world) {
  const bool own = law.measure != OverlapMeasure::kProgram;
  for (cbm::Params& p : world.params.cbm) {
    p.young = law.young;
    p.correction = own ? cbm::StiffnessLaw{} : law.correction;
  }
  std::vector<double> crowding;
  if (own) crowding = find_crowding(cells, time, world.params.boundary);
  std::vector<cbm::NewCell> spheres;
  for (const auto& [id, c] : cells) {
    double young = law.young;
    if (own) young = cbm::corrected_modulus(law.correction, young, crowding[spheres.size()]).value;
    spheres.push_back({id, 0, c.center, c.radius, young, Vec3::Zero()});
  }
  world.state = {};
  world.state.cbm = cbm::make_state(spheres);
  world.state.clock.time = time;
}

}  // namespace

std::vector<SphereLaw> sphere_laws(const calibration::Law& law, double plain) {
  const cbm::StiffnessLaw table = calibration::stiffness_law(law);
  cbm::StiffnessLaw fitted;
  fitted.term.push_back({law.a1, law.power});
  fitted.range = table.range;
  using enum OverlapMeasure;
  return {{"plain", plain, {}, kProgram},
          {"Eq. (22), mean overlap", plain, cbm::paper_law(), kProgram},
          {"Eq. (22), a1 fitted", plain, fitted, kSum},
          {"table", law.a0, table, kProgram},
          {"table alone", law.a0, table, kSum}};
}

JudgedCells compute_in_place(const JudgedCells& cells, double time, const SphereLaw& law,
                             coupling::World world) {
  place(cells, time, law, world);
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  coupling::observe(world, work);
  JudgedCells out = cells;
  for (const coupling::CellMeasure& m : coupling::measure_cells(world, work)) {
    JudgedCell& c = out.at(m.id);
    c.pressure = m.pressure;
    c.normal_force = m.normal_force;
    c.contact_area = m.contact_area;
  }
  return out;
}

}  // namespace acinus::bench
