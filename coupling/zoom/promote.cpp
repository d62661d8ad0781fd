#include "coupling/zoom/promote.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/orientation.hpp"
#include "coupling/zoom/cell_volume.hpp"
#include "dcm/shape/give_shape.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

/// Least share of the wanted volume that a mesh has to enclose.
constexpr double kLeastVolume = 0.7;
/// Least triangle quality of an accepted mesh.
constexpr double kLeastShapeQuality = 0.1;
constexpr int kFillings = 2;  ///< trials of the enclosed volume; the rest is scaled

std::vector<Vec3> directions(const geometry::Topology& t, const Mat3& turn) {
  std::vector<Vec3> direction;
  for (const Vec3& rest : t.rest) direction.push_back((turn * rest).normalized());
  return direction;
}

/// Copies properties of a cell that do not depend on the model to the only cell of a state.
void carry_over(const State& from, const Cell& c, State& to) {
  to.clock = from.clock;
  to.leader.assign(1, 0);
  if (c.index < from.leader.size()) to.leader[0] = from.leader[c.index];
  to.cycle.assign(1, Cycle{});
  if (c.index < from.cycle.size()) to.cycle[0] = from.cycle[c.index];
}

}  // namespace

NewShell shape_sphere(const World& world, std::size_t sphere, double pressure,
                      std::span<const double> radius) {
  const State& s = world.state;
  const int type = s.cbm.type[sphere];
  const geometry::Topology& t = *world.params.zoom.mesh[static_cast<std::size_t>(type)];
  const double bulk = world.params.dcm[static_cast<std::size_t>(type)].bulk_modulus;
  const double rest = s.cbm.volume[sphere].at(s.clock.time);
  const double wanted = rest * std::exp(-std::max(pressure, 0.0) / bulk);
  const dcm::AvailableVolume available = make_available_volume(world, sphere, radius);
  const std::vector<Vec3> direction =
      directions(t, random_orientation(world.params.zoom.seed, s.cbm.lineage[sphere]));
  NewShell shell;
  double found = wanted;
  const double largest = kRayReach * radius[sphere];
  dcm::CuttingBall ball = available.find_ball(wanted, largest);
  // The chords of the mesh cut off volume: the free surface moves outward until it is regained,
  // faces at neighbours keep their places.
  for (double volume = wanted, k = 0; k < kFillings; ++k) {
    if (k > 0) ball.radius = available.find_radius(volume, largest, ball.offset);
    shell.node = available.fill(t, direction, ball);
    found = geometry::compute_volume(shell.node, t.triangle);
    volume *= wanted / found;
  }
  const double quality = geometry::compute_quality(shell.node, t.triangle);
  shell.ok = found >= kLeastVolume * wanted && quality >= kLeastShapeQuality;
  if (!shell.ok)
    shell.why = fmt::format(
        "the available volume holds {:.2f} of the cell's, with triangles down to {:.2g}",
        found / wanted, quality);
  else
    dcm::match_volume(t, wanted, std::vector<double>(shell.node.size(), 1), shell.node);
  return shell;
}

State make_shell(const World& world, std::size_t sphere, const NewShell& shell) {
  const State& s = world.state;
  const cbm::State& c = s.cbm;
  const auto type = static_cast<std::size_t>(c.type[sphere]);
  const dcm::Params& params = world.params.dcm[type];
  const double radius = sphere_radius(c.volume[sphere].at(s.clock.time));
  State out;
  out.dcm = dcm::make_state(
      {{c.lineage[sphere], c.type[sphere], world.params.zoom.mesh[type], cbm::center_of(c, sphere),
        radius, c.pull[sphere], random_orientation(world.params.zoom.seed, c.lineage[sphere]),
        dcm::nucleus_mesh(params.nucleus ? &*params.nucleus : nullptr)}});
  out.dcm.volume[0] = c.volume[sphere];
  const double now = s.clock.time;
  dcm::give_shape(params, {shell.node, radius, 1, {1, 0, now, now + dcm::kForgetShape}}, 0,
                  out.dcm);
  carry_over(s, {false, sphere, cell_index(s, sphere)}, out);
  out.cycle.resize(out.dcm.n_lane());
  out.leader.resize(out.dcm.n_lane());
  if (!has_last_move(s)) return out;
  out.last_move.assign(out.dcm.position.size(), 0.0);
  const Vec3 move = load_point(s.last_move.data(), cbm::cell_address(s.dcm.n_row(), sphere));
  for (int i = 0; i < out.dcm.group[0].n_point(); ++i)
    store_point(out.last_move.data(), dcm::node_address(out.dcm, 0, i), move);
  return out;
}

State make_sphere(const World& world, std::size_t lane) {
  const State& s = world.state;
  const dcm::State& d = s.dcm;
  const dcm::Group& group = d.group[lane / kLanes];
  std::vector<Vec3> node;
  dcm::copy_nodes(d, lane, node);
  State out;
  out.cbm = cbm::make_state(
      {{d.lineage[lane], group.type, geometry::compute_centroid(node, group.topology->triangle),
        sphere_radius(d.volume[lane].at(s.clock.time)),
        cbm::draw_young(world.params.cbm[static_cast<std::size_t>(group.type)],
                        world.params.zoom.seed, d.lineage[lane]),
        d.pull[lane]}});
  out.cbm.volume[0] = d.volume[lane];
  carry_over(s, {true, lane, lane}, out);
  if (!has_last_move(s)) return out;
  Vec3 move = Vec3::Zero();
  for (int i = 0; i < group.topology->n_node; ++i)
    move += load_point(s.last_move.data(), dcm::node_address(d, lane, i)) / group.topology->n_node;
  out.last_move.assign(out.cbm.position.size(), 0.0);
  store_point(out.last_move.data(), cbm::cell_address(0, 0), move);
  return out;
}

}  // namespace acinus::coupling
