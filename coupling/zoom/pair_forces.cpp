#include "coupling/zoom/pair_forces.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "core/sphere.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

/// Lineages in the order of measure_cells.
std::vector<std::int64_t> list_lineages(const World& world, const Workspace& work) {
  const State& s = world.state;
  std::vector<std::int64_t> lineage;
  for (const std::size_t lane : work.dcm.lane_of_body) lineage.push_back(s.dcm.lineage[lane]);
  lineage.insert(lineage.end(), s.cbm.lineage.begin(), s.cbm.lineage.end());
  return lineage;
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

/// Exchanges pair forces among all processes. The owner of either cell has all its contacts, so
/// both processes have the same force.
void gather(const solve::Ownership& ownership, PairForces& forces) {
  if (ownership.is_whole()) return;
  struct PairEntry {
    std::int64_t a, b;
    std::array<double, 4> number;
  };
  std::vector<PairEntry> own, all;
  for (const auto& [pair, sum] : forces)
    own.push_back(
        {pair.first, pair.second, {sum.force.x(), sum.force.y(), sum.force.z(), sum.virial}});
  ownership.ranks.gather<PairEntry>(own, all);
  for (const PairEntry& e : all)
    forces[{e.a, e.b}] = {Vec3(e.number[0], e.number[1], e.number[2]), e.number[3]};
}

}  // namespace

PairForces compute_pair_forces(const World& world, const Workspace& work,
                               const std::set<std::int64_t>& cells) {
  const std::vector<std::int64_t> lineage = list_lineages(world, work);
  PairForces forces;
  visit_contacts(world, work, [&](const ContactForce& f) {
    const std::int64_t a = lineage[f.a], b = f.b == kNoCell ? kNoPartner : lineage[f.b];
    if (a == b || f.fades || (!cells.contains(a) && !cells.contains(b))) return;
    const bool swap = b != kNoPartner && b < a;
    const auto pair = swap ? std::pair(b, a) : std::pair(a, b);
    PairForce& sum = forces[pair];
    const Vec3 force = swap ? Vec3(-f.force) : f.force;
    sum.force += force;
    sum.virial += force.dot(swap ? f.arm_b : f.arm_a);
  });
  gather(work.system.ownership, forces);
  return forces;
}

void add_fading(const World& world, const PairForces& before, const PairForces& after,
                std::vector<FadingForce>& fading) {
  const State& s = world.state;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  struct CellLimits {
    Vec3 center = Vec3::Zero();
    double radius = kAny, most_force = kAny;
  };
  std::map<std::int64_t, CellLimits> limits{{kNoPartner, {}}};
  for_each_cell(s, [&](const Cell& c) {
    const double radius = sphere_radius(volume_of(s, c).at(s.clock.time));
    limits[lineage_of(s, c)] = {center_of(s, c), radius, largest_fading(world, c, radius)};
  });
  std::set<PairForces::key_type> pairs;
  for (const PairForces* forces : {&before, &after})
    for (const auto& [pair, force] : *forces) pairs.insert(pair);
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
