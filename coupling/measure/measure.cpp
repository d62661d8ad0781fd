#include "coupling/measure/measure.hpp"

#include <algorithm>
#include <utility>

#include "core/sphere.hpp"
#include "coupling/measure/cell_numbers.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/contact_sums.hpp"
#include "coupling/step/constrained_points.hpp"
#include "coupling/step/contact_search.hpp"
#include "coupling/step/references.hpp"
#include "coupling/step/step.hpp"
#include "coupling/world/contact_input.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::coupling {
namespace {

/// Step length, s, of an assembly for measures: reference values do not change over it, to
/// rounding.
constexpr double kNow = 1e-9;
/// Age, s, after which a cell counts as settled.
constexpr double kNewborn = 600;

void set_life(const State& s, const Cycle& cycle, const Ramp& volume, CellMeasure& m) {
  const double now = s.clock.time;
  m.parent = cycle.parent;
  m.newborn = cycle.parent >= 0 && now < cycle.birth + kNewborn;
  m.fate = cycle.fate;
  m.growth_rate = volume.slope_at(now);
  m.in_cycle = cycle.duration > 0 && cycle.fate != Fate::kLyse;
  if (m.in_cycle) m.progress = volume.at(now) / cycle.birth_volume - 1;
}

void add_stress(CellMeasure& m, double reference_volume, const Vec3& force, const Vec3& arm) {
  const double w = 1 / reference_volume;
  m.stress[0] += w * force.x() * arm.x();
  m.stress[1] += w * 0.5 * (force.x() * arm.y() + force.y() * arm.x());
  m.stress[2] += w * 0.5 * (force.x() * arm.z() + force.z() * arm.x());
  m.stress[3] += w * force.y() * arm.y();
  m.stress[4] += w * 0.5 * (force.y() * arm.z() + force.z() * arm.y());
  m.stress[5] += w * force.z() * arm.z();
}

CellMeasure measure_surface(const World& world, const Workspace& w, std::size_t body) {
  const State& s = world.state;
  const std::size_t lane = w.dcm.lane_of_body[body];
  const dcm::GroupView g = dcm::view_group(s.dcm, w.lanes, w.system, lane / kLanes);
  const int l = static_cast<int>(lane % kLanes);
  CellMeasure m;
  m.id = s.dcm.lineage[lane];
  m.deformable = true;
  m.type = s.dcm.group[lane / kLanes].type;
  m.leader = lane < w.leader.size() && w.leader[lane];
  if (lane < s.cycle.size()) set_life(s, s.cycle[lane], s.dcm.volume[lane], m);
  m.center = dcm::cell_center(s.dcm, lane);
  m.radius = w.lanes.radius[lane];
  if (w.dcm.is_ghost(lane)) return m;  // its owner measures it
  m.volume = dcm::compute_volumes(g)[l];
  m.area = dcm::compute_areas(g)[l];
  m.cytosol_pressure = dcm::cytosol_pressure(world.params.dcm[m.type].bulk_modulus, m.volume,
                                             sphere_volume(m.radius));
  m.migration_force = w.forces.dcm[lane].norm();
  // Points have shares of the reference surface, scaled here to the present one.
  const std::vector<double>& share = w.dcm.share[body];
  double touching = 0, whole = 0;
  for (std::size_t p = 0; p < share.size(); ++p) {
    const double area =
        dcm::point_area(*w.dcm.body[body].topology, world.params.dcm_contact.quadrature,
                        static_cast<int>(p), m.radius);
    touching += std::min(1.0, share[p]) * area;
    whole += area;
  }
  m.contact_area = whole > 0 ? std::min(1.0, touching / whole) * m.area : 0;
  return m;
}

CellMeasure measure_sphere(const World& world, const Workspace& w, std::size_t c) {
  const State& s = world.state;
  CellMeasure m;
  m.id = s.cbm.lineage[c];
  m.type = s.cbm.type[c];
  const std::size_t at = s.dcm.n_lane() + c;
  m.leader = at < w.leader.size() && w.leader[at];
  if (at < s.cycle.size()) set_life(s, s.cycle[at], s.cbm.volume[c], m);
  m.center = cbm::center_of(s.cbm, c);
  m.radius = w.cbm_radius[c];
  if (w.cbm.is_ghost(c)) return m;
  if (!w.cbm_strength.empty()) m.strength = w.cbm_strength[c];
  m.volume = sphere_volume(m.radius);
  m.area = 4 * kPi * m.radius * m.radius;
  m.contact_area = std::min(w.cbm.contact_area[c], m.area);
  m.migration_force = w.forces.cbm[c].norm();
  return m;
}

/// Adds contact forces: stress, force sums, numbers of contacts.
void add_contacts(const World& world, const Workspace& w, std::vector<CellMeasure>& cells) {
  auto press = [&](std::size_t cell, const Vec3& force, const Vec3& arm) {
    add_stress(cells[cell], sphere_volume(cells[cell].radius), force, arm);
  };
  visit_contacts(world, w, [&](const ContactForce& c) {
    press(c.a, c.force, c.arm_a);
    if (c.b != kNoCell) press(c.b, -c.force, c.arm_b);
  });
  for (const CellContact& pair : sum_contacts(world, w))
    for (const std::size_t k : {pair.a, pair.b}) {
      if (k == kNoCell) continue;
      if (pair.touching) ++cells[k].contacts;
      cells[k].contact_force += pair.force.norm();
      cells[k].normal_force += pair.normal_force;
    }
}

}  // namespace

void observe(const World& world, Workspace& w) { assemble(world, kNow, w); }

void observe_contacts(const World& world, Workspace& w) {
  const double end = world.state.clock.time + kNow;
  refresh_references(world, world.state, end, w);
  apply_constraints(w);
  refresh_contacts(world, world.state, end, w);
  const PhaseParams phase = phase_params(world);
  const InterfaceInput in = contact_input(world, world.state, phase, 0, w);
  solve::Links links;
  dcm::add_contact_loads(in.dcm, w.dcm, w.contacts, links);
  add_interface_loads(in, w.dcm, w.cbm.modulus, w.contacts, links);
}

std::vector<CellMeasure> measure_cells(const World& world, const Workspace& w) {
  const CellNumbers numbers = number_cells(world.state, w);
  std::vector<CellMeasure> cells(numbers.of_sphere(world.state.cbm.n_cell()));
  for (std::size_t k = 0; k < w.dcm.body.size(); ++k)
    cells[numbers.of_body[k]] = measure_surface(world, w, k);
  for (std::size_t c = 0; c < world.state.cbm.n_cell(); ++c)
    if (!w.cbm.is_absent(c)) cells[numbers.of_sphere(c)] = measure_sphere(world, w, c);
  add_contacts(world, w, cells);
  for (CellMeasure& m : cells) {
    m.pressure = -(m.stress[0] + m.stress[3] + m.stress[5]) / 3;
    if (!m.deformable) m.cytosol_pressure = m.pressure;
  }
  if (w.system.ownership.is_whole()) return cells;
  std::vector<CellMeasure> own;
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (is_own_number(numbers, w, k)) own.push_back(cells[k]);
  const std::size_t n = cells.size();
  cells = {};
  solve::gather_in_order(
      w.system.ownership.ranks, n, [&](std::size_t k) { return owner_of_number(numbers, w, k); },
      [](std::size_t) { return std::size_t{1}; }, own, cells);
  return cells;
}

}  // namespace acinus::coupling
