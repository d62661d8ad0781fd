#include "coupling/generate/lobule.hpp"

#include "coupling/generate/buckets.hpp"
#include "coupling/generate/sinusoids.hpp"

namespace acinus::coupling {
namespace {

constexpr double kVeinMargin = 20;    // um beyond the bottom and top planes
constexpr double kSeedClearance = 4;  // um from a vessel's wall: a cell of 3 um and 1 um to spare
constexpr double kLargestClearance = 10;  ///< um, tried first
constexpr int kMaxMisses = 200000;

void add_segment(Lobule& lobule, int a, int b, double radius, VesselKind kind) {
  lobule.vessels.segment.push_back({a, b});
  lobule.vessels.radius.push_back({radius, radius});
  lobule.kind.push_back(kind);
}

void add_vessels(const LobuleParameters& p, const Domain& domain, const Sinusoids& sinusoids,
                 Lobule& lobule) {
  lobule.vessels.node = sinusoids.node;
  for (const auto& [a, b] : sinusoids.segment)
    add_segment(lobule, a, b, p.sinusoid_radius, VesselKind::kSinusoid);
  for (const Vein& vein : domain.vein) {
    const int first = static_cast<int>(lobule.vessels.node.size());
    lobule.vessels.node.push_back(vein.axis + Vec3(0, 0, -kVeinMargin));
    lobule.vessels.node.push_back(vein.axis + Vec3(0, 0, p.height + kVeinMargin));
    add_segment(lobule, first, first + 1, vein.radius,
                vein.portal ? VesselKind::kPortalVein : VesselKind::kCentralVein);
  }
}

void add_seeds(const LobuleParameters& p, const Domain& domain, const Sinusoids& sinusoids,
               const Uniform& uniform, Lobule& lobule) {
  Buckets sinusoid(p.sinusoid_radius + kLargestClearance), seed(p.min_distance);
  for (const auto& [a, b] : sinusoids.segment) sinusoid.add(sinusoids.node[a], sinusoids.node[b]);
  const auto fits = [&](const Vec3& point, double clearance) {
    if (depth_inside(domain, point) < p.initial_radius + clearance - kSeedClearance) return false;
    for (const Vein& vein : domain.vein)
      if (axis_distance(vein, point) < vein.radius + clearance) return false;
    if (axis_distance(domain.vein.front(), point) < p.lesion_radius) return false;
    return !seed.any_within(point, p.min_distance) &&
           !sinusoid.any_within(point, p.sinusoid_radius + clearance);
  };
  // Places with the largest clearance first: a sphere that grows between two close vessels can
  // never get out.
  for (double clearance = kLargestClearance; clearance >= kSeedClearance; clearance -= 1) {
    const int patience = clearance > kSeedClearance ? kMaxMisses / 20 : kMaxMisses;
    for (int misses = 0; static_cast<int>(lobule.seeds.size()) < p.cells && misses < patience;
         ++misses) {
      Vec3 point;
      for (int axis = 0; axis < 3; ++axis)
        point[axis] = domain.low[axis] + uniform() * (domain.high[axis] - domain.low[axis]);
      if (!fits(point, clearance)) continue;
      seed.add(point, point);
      lobule.seeds.push_back(point);
      misses = 0;
    }
  }
}

}  // namespace

Lobule make_lobule(const LobuleParameters& p, const Uniform& uniform) {
  const Domain domain = make_domain(p);
  const Sinusoids sinusoids = make_sinusoids(p, domain, uniform);
  Lobule lobule;
  lobule.planes = domain.plane;
  lobule.wanted_cells = p.cells;
  lobule.axis_point = domain.vein.front().axis;
  lobule.n_branch_point = sinusoids.n_branch;
  lobule.sinusoid_length = sinusoids.length;
  lobule.sinusoid_target_length = sinusoids.target_length;
  lobule.volume = domain.volume;
  add_vessels(p, domain, sinusoids, lobule);
  add_seeds(p, domain, sinusoids, uniform, lobule);
  return lobule;
}

}  // namespace acinus::coupling
