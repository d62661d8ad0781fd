#include "coupling/zoom/pair_forces.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "cbm/contact.hpp"
#include "core/sphere.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/subworld/population.hpp"
#include "coupling/subworld/ring.hpp"
#include "coupling/vessels/vessel_tree.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Cells of some lineages, and those that fading forces join to them.
struct FoundCells {
  CellSet cells, joined;
};

FoundCells find_cells(const State& s, const std::set<std::int64_t>& lineages) {
  std::set<std::int64_t> partners;
  for (const FadingForce& f : s.fading)
    if (lineages.contains(f.a) || lineages.contains(f.b)) partners.insert({f.a, f.b});
  FoundCells found;
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t lineage = lineage_of(s, c);
    const auto keep = [&c](CellSet& set) { (c.deformable ? set.dcm : set.cbm).push_back(c.at); };
    if (lineages.contains(lineage)) keep(found.cells);
    if (partners.contains(lineage)) keep(found.joined);
  });
  return found;
}

/// Some cells among all that decide their contact forces, which are constrained. Their order is
/// that of the whole world, so that sums are the same to the bit.
struct Surroundings {
  World world;
  Workspace work;

  Surroundings(const World& whole, const std::set<std::int64_t>& lineages) {
    const State& s = whole.state;
    const auto [cells, joined] = find_cells(s, lineages);
    const CellSet ring = cbm::has_correction(whole.params.cbm)
                             ? find_ring(whole, cells)
                             : find_neighbours(whole, cells, contact_reach(whole));
    const CellSet all = unite(unite(cells, ring), joined);
    std::vector<SelectedCell<State>> shells, spheres;
    for (const std::size_t lane : all.dcm) shells.push_back({&s, lane});
    for (const std::size_t sphere : all.cbm) spheres.push_back({&s, sphere});
    world.params = whole.params;
    if (!s.tree.node.empty())
      place_vessels(whole.params.tree, s.tree, world.params.boundary.vessels);
    world.state = compose(shells, spheres, s);
    const State& part = world.state;
    work.constraint.cell.assign(part.dcm.n_lane() + part.cbm.n_cell(), 0);
    for_each_cell(part, [&](const Cell& c) {
      work.constraint.cell[c.index] = lineages.contains(lineage_of(part, c)) ? 0 : 1;
    });
    begin_contacts(world, work);
    observe_contacts(world, work);
  }
};

/// Cell as ContactForce numbers it.
struct NumberedCell {
  std::int64_t lineage = 0;
  double volume = 0;  ///< um^3, reference volume
};

std::vector<NumberedCell> list_numbered(const World& world, const Workspace& work) {
  const State& s = world.state;
  std::vector<NumberedCell> cells;
  for (const std::size_t lane : work.dcm.lane_of_body)
    cells.push_back({s.dcm.lineage[lane], sphere_volume(work.lanes.radius[lane])});
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c)
    cells.push_back({s.cbm.lineage[c], sphere_volume(work.cbm_radius[c])});
  return cells;
}

/// Largest compression of a cell by a fading force, as a share of its volume. Differences between
/// the models are smaller; beyond them the contacts of a new mesh have to settle.
constexpr double kMostCompression = 0.05;

/// Relative displacement of a pair that ends its fading force, as a share of the smaller radius:
/// more than tissue in equilibrium moves in an hour.
constexpr double kPairReach = 0.25;

/// Force that compresses a cell by that share if it acts on its cross-section, nN.
double largest_fading(const World& world, const Cell& c, double radius) {
  const State& s = world.state;
  const auto type = static_cast<std::size_t>(type_of(s, c));
  return kMostCompression * world.params.dcm[type].bulk_modulus * kPi * radius * radius;
}

PairForce force_of(const PairForces& forces, const PairForces::key_type& pair) {
  const auto at = forces.find(pair);
  return at == forces.end() ? PairForce{} : at->second;
}

}  // namespace

CellContacts evaluate_contacts(const World& world, const std::set<std::int64_t>& cells) {
  const Surroundings around(world, cells);
  const std::vector<NumberedCell> number = list_numbered(around.world, around.work);
  CellContacts found;
  std::map<std::int64_t, Vec3> stress;  // its diagonal
  const auto press = [&](const NumberedCell& c, const Vec3& force, const Vec3& arm) {
    if (!cells.contains(c.lineage)) return;
    Vec3& sum = stress.try_emplace(c.lineage, Vec3::Zero()).first->second;
    const double w = 1 / c.volume;
    for (int k = 0; k < 3; ++k) sum[k] += w * force[k] * arm[k];
  };
  visit_contacts(around.world, around.work, [&](const ContactForce& f) {
    press(number[f.a], f.force, f.arm_a);
    if (f.b != kNoCell) press(number[f.b], -f.force, f.arm_b);
    const std::int64_t a = number[f.a].lineage,
                       b = f.b == kNoCell ? kNoPartner : number[f.b].lineage;
    if (a == b || f.fades || (!cells.contains(a) && !cells.contains(b))) return;
    const bool swap = b != kNoPartner && b < a;
    PairForce& sum = found.pair[swap ? std::pair(b, a) : std::pair(a, b)];
    const Vec3 force = swap ? Vec3(-f.force) : f.force;
    sum.force += force;
    sum.virial += force.dot(swap ? f.arm_b : f.arm_a);
  });
  for (const std::int64_t cell : cells) found.pressure[cell] = 0;
  for (const auto& [cell, sum] : stress) found.pressure[cell] = -(sum[0] + sum[1] + sum[2]) / 3;
  return found;
}

void add_fading(const World& world, const PairForces& before, const PairForces& after,
                std::vector<FadingForce>& fading) {
  const State& s = world.state;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  struct CellLimits {
    Vec3 center = Vec3::Zero();
    double radius = kAny, most_force = kAny;
  };
  std::set<PairForces::key_type> pairs;
  std::map<std::int64_t, CellLimits> limits;
  for (const PairForces* forces : {&before, &after})
    for (const auto& [pair, force] : *forces) {
      pairs.insert(pair);
      limits[pair.first] = limits[pair.second] = {};
    }
  for_each_cell(s, [&](const Cell& c) {
    const auto found = limits.find(lineage_of(s, c));
    if (found == limits.end()) return;
    const double radius = sphere_radius(volume_of(s, c).at(s.clock.time));
    found->second = {center_of(s, c), radius, largest_fading(world, c, radius)};
  });
  const double now = s.clock.time;
  for (const auto& pair : pairs) {
    const PairForce was = force_of(before, pair), is = force_of(after, pair);
    const CellLimits &a = limits.at(pair.first), &b = limits.at(pair.second);
    Vec3 missing = was.force - is.force;
    const Vec3 apart = a.center - b.center;
    if (pair.second != kNoPartner) missing = missing.dot(apart.normalized()) * apart.normalized();
    const double limit = std::min(a.most_force, b.most_force);
    const double share = std::min(1.0, limit / missing.norm());
    if (missing.norm() > 0)
      fading.push_back({pair.first,
                        pair.second,
                        share * missing,
                        share * (was.virial - is.virial),
                        {1, 0, now, now + world.params.zoom.fade},
                        apart,
                        kPairReach * std::min(a.radius, b.radius)});
  }
}

}  // namespace acinus::coupling
