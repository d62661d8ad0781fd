#include "coupling/measure/measure.hpp"

#include <algorithm>
#include <utility>

#include "core/sphere.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/contact_sums.hpp"
#include "coupling/step/ghost_cells.hpp"
#include "coupling/step/step.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/loads/stress.hpp"
#include "dcm/terms/area.hpp"
#include "dcm/terms/volume.hpp"

namespace acinus::coupling {
namespace {

/// Step length, s, of an assembly for measures: reference values do not change over it, to
/// rounding.
constexpr double kNow = 1e-9;
/// Age, s, after which a cell counts as settled.
constexpr double kNewborn = 600;

/// Process that measures a cell, by index among measures.
int owner_of(const Workspace& w, std::size_t cell) {
  const std::size_t n_body = w.dcm.body.size();
  const std::size_t lane = cell < n_body ? w.dcm.lane_of_body[cell] : w.dcm_lanes + cell - n_body;
  return owner_of_lane(w, lane);
}

void set_life(const State& s, const Cycle& cycle, const Ramp& volume, CellMeasure& m) {
  const double now = s.clock.time;
  m.parent = cycle.parent;
  m.newborn = cycle.parent >= 0 && now < cycle.birth + kNewborn;
  m.fate = cycle.fate;
  m.growth_rate = volume.slope_at(now);
  if (cycle.duration > 0 && cycle.fate != Fate::kLyse)
    m.progress = volume.at(now) / cycle.birth_volume - 1;
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

std::vector<CellMeasure> measure_cells(const World& world, const Workspace& w) {
  std::vector<CellMeasure> cells;
  cells.reserve(w.dcm.body.size() + world.state.cbm.n_cell());
  for (std::size_t k = 0; k < w.dcm.body.size(); ++k) cells.push_back(measure_surface(world, w, k));
  for (std::size_t c = 0; c < world.state.cbm.n_cell(); ++c)
    cells.push_back(measure_sphere(world, w, c));
  add_contacts(world, w, cells);
  for (CellMeasure& m : cells) {
    m.pressure = -(m.stress[0] + m.stress[3] + m.stress[5]) / 3;
    if (!m.deformable) m.cytosol_pressure = m.pressure;
  }
  if (w.system.ownership.is_whole()) return cells;
  std::vector<CellMeasure> own;
  const int self = w.system.ownership.ranks.rank();
  for (std::size_t k = 0; k < cells.size(); ++k)
    if (owner_of(w, k) == self) own.push_back(cells[k]);
  solve::gather_in_order(
      w.system.ownership.ranks, cells.size(), [&](std::size_t k) { return owner_of(w, k); },
      [](std::size_t) { return std::size_t{1}; }, own, cells);
  return cells;
}

NodeMeasure measure_nodes(const World& world, const Workspace& w) {
  const State& s = world.state;
  NodeMeasure n;
  std::size_t n_node = 0;
  for (const contact::SurfaceBody& b : w.dcm.body) n_node += b.topology->n_node;
  n.force.reserve(n_node);
  n.pressure.reserve(n_node);
  n.tension.reserve(n_node);
  RowVector<double> contact;
  set_size(contact, s.dcm.position.size());
  solve::clear_own_rows(w.system, kPointStride, contact);
  const solve::Links& links = w.system.links;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const contact::Contact& k = w.contacts.all[links.law[l].contact];
    if (k.partner == contact::Partner::kNucleus) continue;
    const solve::Stencil stencil = solve::stencil_of(links.link[l]);
    const Vec3 f = k.force * k.normal;
    for (int m = 0; m < stencil.n; ++m)
      if (stencil.address[m] < contact.size())
        add_point(contact.data(), stencil.address[m], stencil.weight[m] * f);
  }
  for (std::size_t b = 0; b < w.dcm.body.size(); ++b) {
    const std::size_t lane = w.dcm.lane_of_body[b];
    if (w.dcm.is_ghost(lane)) continue;
    const dcm::Group& group = s.dcm.group[lane / kLanes];
    const dcm::GroupView g = dcm::view_group(s.dcm, w.lanes, w.system, lane / kLanes);
    const auto tension =
        dcm::compute_node_tension(w.dcm_params[group.type], g, static_cast<int>(lane % kLanes));
    const double r2 = w.lanes.radius[lane] * w.lanes.radius[lane];
    for (int i = 0; i < group.topology->n_node; ++i) {
      const std::size_t k = i;
      const Vec3 f = load_point(contact.data(), dcm::node_address(s.dcm, lane, i));
      n.force.push_back(f);
      n.pressure.push_back(-f.dot(w.dcm.body[b].node_normal[k]) /
                           (group.topology->rest_node_area[k] * r2));
      n.tension.push_back(tension[k]);
    }
  }
  if (w.system.ownership.is_whole()) return n;
  const auto gather = [&](auto& values) {
    const auto own = std::exchange(values, {});
    solve::gather_in_order(
        w.system.ownership.ranks, w.dcm.body.size(), [&](std::size_t b) { return owner_of(w, b); },
        [&](std::size_t b) { return static_cast<std::size_t>(w.dcm.body[b].topology->n_node); },
        own, values, solve::Receivers::kRoot);
  };
  gather(n.force);
  gather(n.pressure);
  gather(n.tension);
  return n;
}

}  // namespace acinus::coupling
