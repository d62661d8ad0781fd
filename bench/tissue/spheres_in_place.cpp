#include "bench/tissue/spheres_in_place.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/measure/measure.hpp"
#include "coupling/step/stages.hpp"
#include "coupling/world/workspace.hpp"

namespace acinus::bench {
namespace {

/// Sum and number of the overlaps of one cell with cells and walls.
struct CellOverlaps {
  double sum = 0;
  int contacts = 0;
  void add(double overlap) {
    if (!(overlap > 0)) return;
    sum += overlap;
    ++contacts;
  }
  double measure(OverlapMeasure by) const {
    if (contacts == 0) return 0;
    const double all = sum / cbm::kNeighbours;
    return by == OverlapMeasure::kByContacts ? all * std::pow(contacts / 7.0, 0.1) : all;
  }
};

std::vector<CellOverlaps> find_crowding(const cbm::RoomInput& in) {
  std::vector<CellOverlaps> out(in.center.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t j = i + 1; j < out.size(); ++j) {
      const double overlap =
          1 - (in.center[i] - in.center[j]).norm() / (in.radius[i] + in.radius[j]);
      out[i].add(overlap);
      out[j].add(overlap);
    }
  for (const cbm::RoomWall& w : in.walls) out[w.cell].add(1 - w.distance / in.radius[w.cell]);
  return out;
}

/// Tangent planes of walls, capsules and vessels within two radii of each sphere.
std::vector<cbm::RoomWall> find_walls(const std::vector<Vec3>& center,
                                      const std::vector<double>& radius, double time,
                                      const contact::Boundary& boundary) {
  std::vector<cbm::RoomWall> walls;
  for (std::size_t i = 0; i < center.size(); ++i) {
    const auto add = [&](const contact::Gap& g) {
      if (g.gap < 2 * radius[i]) walls.push_back({static_cast<int>(i), -g.normal, g.gap});
    };
    contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) {
      add(contact::gap_to_wall(wall, center[i], time));
    });
    const geometry::Network& network = boundary.vessels.network;
    for (int k = 0; k < static_cast<int>(network.segment.size()); ++k) {
      const contact::Gap g = contact::gap_to_segment(network, k, center[i]);
      if (contact::is_local_minimum(boundary.vessels, k, center[i], g)) add(g);
    }
  }
  return walls;
}

/// Sets the spheres of the world, with moduli set directly for laws the program does not have.
void place(const JudgedCells& cells, double time, const SphereLaw& law, const cbm::RoomInput& in,
           coupling::World& world) {
  const bool own = law.measure != OverlapMeasure::kProgram;
  for (cbm::Params& p : world.params.cbm) {
    p.young = law.young;
    p.correction = own ? cbm::StiffnessLaw{} : law.correction;
  }
  const std::vector<CellOverlaps> crowding = own ? find_crowding(in) : std::vector<CellOverlaps>{};
  std::vector<cbm::NewCell> spheres;
  for (const auto& [id, c] : cells) {
    double young = law.young;
    if (own)
      young = cbm::corrected_modulus(law.correction, young,
                                     crowding[spheres.size()].measure(law.measure))
                  .value;
    spheres.push_back({id, 0, c.center, c.radius, young, Vec3::Zero()});
  }
  world.state = {};
  world.state.cbm = cbm::make_state(spheres);
  world.state.clock.time = time;
}

}  // namespace

std::vector<SphereLaw> sphere_laws(const calibration::Law& law, double plain, double bulk_modulus) {
  const cbm::StiffnessLaw table = calibration::stiffness_law(law);
  cbm::StiffnessLaw stiff = table, fitted;
  for (cbm::StiffnessLaw::Knot& k : stiff.table) k.added = std::max(0.0, law.a0 + k.added - plain);
  fitted.term.push_back({law.a1, law.power});
  fitted.range = table.range;
  cbm::StiffnessLaw soft;
  soft.term.push_back({1e3, 4});
  // Of a grid of constants the best in the calibration's clump (docs/calibration.md).
  const cbm::RoomLaw clump{bulk_modulus, 1.08, 0.98, 0.03}, all{bulk_modulus, 1.1, 0.98, 0.04};
  using enum OverlapMeasure;
  return {{"plain", plain, {}, kProgram, {}},
          {"Eq. (22), mean overlap", plain, cbm::paper_law(), kProgram, {}},
          {"Eq. (22), a1 fitted", plain, fitted, kSum, {}},
          {"table", law.a0, table, kProgram, {}},
          {"table alone", law.a0, table, kSum, {}},
          {"table alone, at least plain", plain, stiff, kSum, {}},
          {"table by contacts", law.a0, table, kByContacts, {}},
          {"room", law.a0, {}, kProgram, clump},
          {"room, fitted to all", law.a0, {}, kProgram, all},
          {"room and a1 d^4", 0.02, soft, kSum, all}};
}

JudgedCells compute_in_place(const JudgedCells& cells, double time, const SphereLaw& law,
                             coupling::World world) {
  std::vector<Vec3> center;
  std::vector<double> radius;
  for (const auto& [id, c] : cells) {
    center.push_back(c.center);
    radius.push_back(c.radius);
  }
  const std::vector<cbm::RoomWall> walls = find_walls(center, radius, time, world.params.boundary);
  const cbm::RoomInput in{center, radius, walls};
  place(cells, time, law, in, world);
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
  if (!law.room) return out;
  const std::vector<cbm::Room> rooms = cbm::find_rooms(in, law.room->reach);
  const cbm::RoomForces forces = cbm::find_room_forces(in, *law.room, rooms);
  std::size_t k = 0;
  for (auto& [id, c] : out) {
    c.pressure += forces.pressure[k];
    c.normal_force += forces.normal_force[k];
    c.contact_area = 0;
    for (const cbm::RoomFace& f : rooms[k].face) c.contact_area += f.cut.area;
    ++k;
  }
  return out;
}

}  // namespace acinus::bench
