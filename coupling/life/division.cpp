#include "coupling/life/division.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/numbers/random.hpp"
#include "core/sphere.hpp"
#include "coupling/life/fill.hpp"
#include "dcm/shape/split.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/inner_ball.hpp"
#include "geometry/measures.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::coupling {
namespace {

constexpr int kMostPlanes = 8;  ///< planes tried at most
/// Least triangle quality of an accepted daughter mesh.
constexpr double kLeastBirthQuality = 0.1;
/// Tilt of later planes: share of a random direction added to the axis.
constexpr double kTurn = 0.5;
/// Distance from the cut, in mean edges, of nodes that are fixed while the volume is made exact,
/// since the sister is on the other side.
constexpr double kOnCut = 0.15;

/// Radius of the initial ball in a folded half, over that of its largest ball.
constexpr double kSeed = 0.9;

Vec3 random_direction(const World& world, std::int64_t lineage, int attempt) {
  const Vec3 v =
      normal3({world.params.life.seed, Purpose::kDivisionAxis, static_cast<std::uint64_t>(lineage),
               0, static_cast<std::uint32_t>(attempt)});
  return v.normalized();
}

/// Direction of the vessel with the nearest wall; zero without vessels.
Vec3 along_nearest_vessel(const geometry::Network& network, const Vec3& x) {
  const int segment = geometry::nearest_segment(network, x).segment;
  if (segment < 0) return Vec3::Zero();
  const auto [a, b] = network.segment[segment];
  const Vec3 along = network.node[b] - network.node[a];
  return along.norm() > 0 ? along.normalized() : Vec3::Zero();
}

/// Mother cell, prepared for the division.
struct MotherCell {
  std::vector<Vec3> node;
  const geometry::Topology* topology = nullptr;
  double volume = 0, rest_volume = 0;  ///< um^3
  double stretch = 1;                  ///< area of the surface over its reference
};

MotherCell look_at(const World& world, std::size_t lane) {
  const State& s = world.state;
  MotherCell m;
  m.topology = s.dcm.group[lane / kLanes].topology;
  dcm::copy_nodes(s.dcm, lane, m.node);
  m.volume = geometry::compute_volume(m.node, m.topology->triangle);
  m.rest_volume = s.dcm.volume[lane].at(s.clock.time);
  m.stretch = dcm::measure_stretch(s.dcm.birth[lane], *m.topology, m.node,
                                   sphere_radius(m.rest_volume), s.clock.time);
  return m;
}

/// Largest distance of the nodes outside a closed surface, um.
double farthest_outside(const std::vector<Vec3>& node, const geometry::AuditBody& body) {
  double farthest = 0;
  for (const Vec3& x : node)
    if (body.locate(x) == geometry::Location::kOutside)
      farthest = std::max(farthest, body.distance(x));
  return farthest;
}

const char* describe(dcm::SplitFailure failure) {
  switch (failure) {
    case dcm::SplitFailure::kNone:
      break;
    case dcm::SplitFailure::kNoHalving:
      return "no plane halves the volume";
    case dcm::SplitFailure::kSeveralLoops:
      return "the plane cuts the cell in more than one place";
    case dcm::SplitFailure::kNotStarShaped:
      return "a half is folded";
    case dcm::SplitFailure::kNoVolume:
      return "half the volume does not fit";
  }
  return "";
}

/// Fault of a daughter mesh, or empty.
std::string find_fault(const geometry::Topology& topology, const std::vector<Vec3>& node) {
  if (geometry::compute_quality(node, topology.triangle) < kLeastBirthQuality)
    return "a daughter's mesh is too distorted";
  if (geometry::AuditBody(node, topology.triangle).self_intersects())
    return "a daughter crosses herself";
  return {};
}

/// Fills a half that is not star-shaped: inflates a ball inside it up to the fixed surface of the
/// mother.
Filling blow_up(const World& world, int type, const MotherCell& mother,
                const geometry::CutPlane& plane, const geometry::Surface& half) {
  const geometry::Topology& topology = *mother.topology;
  const geometry::InnerBall ball = geometry::find_inner_ball(half);
  if (!(ball.radius > 0)) return {.ok = false, .cause = "a half has no inside", .node = {}};
  std::vector<Vec3> seed;
  for (const Vec3& x : topology.rest) seed.push_back(ball.center + kSeed * ball.radius * x);
  Filling filling = fill(world, type, topology, seed, half);
  if (!filling.ok) return filling;
  const double edge = topology.mean_rest_length * sphere_radius(0.5 * mother.volume);
  std::vector<double> weight;
  for (const Vec3& x : filling.node)
    weight.push_back(std::abs(plane.normal.dot(x) - plane.offset) < kOnCut * edge ? 0 : 1);
  filling.ok = dcm::match_volume(topology, 0.5 * mother.volume, weight, filling.node);
  if (!filling.ok) filling.cause = "half the volume does not fit";
  return filling;
}

/// Makes both daughters of a plane.   @return fault of the plane, or empty
std::string try_plane(const World& world, int type, const MotherCell& mother, const Vec3& axis,
                      DaughterMeshes& daughters) {
  const double thickness = world.params.dcm[type].cortex_thickness;
  const dcm::Split split = dcm::split_cell(*mother.topology, mother.node, axis, thickness);
  std::string why;
  if (split.daughters) {
    daughters.node = split.daughters->node;
  } else if (split.failure == dcm::SplitFailure::kNotStarShaped ||
             split.failure == dcm::SplitFailure::kNoVolume) {
    const auto plane = geometry::find_halving_plane(mother.node, mother.topology->triangle, axis);
    const geometry::Cut cut = geometry::cut_surface(mother.node, mother.topology->triangle, *plane);
    for (std::size_t k = 0; k < 2 && why.empty(); ++k) {
      Filling filling = blow_up(world, type, mother, *plane, cut.half[k]);
      why = filling.cause;
      daughters.figures.steps += filling.steps;
      daughters.node[k] = std::move(filling.node);
    }
  } else {
    why = describe(split.failure);
  }
  for (std::size_t k = 0; k < 2 && why.empty(); ++k)
    why = find_fault(*mother.topology, daughters.node[k]);
  return why;
}

}  // namespace

Vec3 division_axis(const World& world, const CycleParams& cycle, std::int64_t lineage,
                   const Vec3& center, int attempt) {
  Vec3 random = random_direction(world, lineage, attempt);
  if (cycle.axis == DivisionAxis::kPlane) {
    random.z() = 0;
    random.normalize();
  }
  Vec3 wanted = Vec3::Zero();
  if (cycle.axis == DivisionAxis::kGiven) wanted = cycle.direction.normalized();
  if (cycle.axis == DivisionAxis::kVessel)
    wanted = along_nearest_vessel(world.params.boundary.vessels.network, center);
  if (wanted.isZero()) return random;
  return attempt == 0 ? wanted : (wanted + kTurn * random).normalized();
}

bool split_shell(const World& world, std::size_t lane, DaughterMeshes& daughters,
                 std::string& why) {
  const State& s = world.state;
  const MotherCell mother = look_at(world, lane);
  const int type = s.dcm.group[lane / kLanes].type;
  const CycleParams& cycle = world.params.life.type[type];
  const Vec3 center = geometry::compute_centroid(mother.node, mother.topology->triangle);
  const std::int64_t lineage = s.dcm.lineage[lane];
  DivisionFigures& f = daughters.figures;
  f.mother = lineage;
  for (int attempt = 0; attempt < kMostPlanes; ++attempt) {
    f.planes = attempt + 1;
    daughters.axis = division_axis(world, cycle, lineage, center, attempt);
    why = try_plane(world, type, mother, daughters.axis, daughters);
    if (why.empty()) break;
  }
  if (!why.empty()) return false;

  const geometry::AuditBody body(mother.node, mother.topology->triangle);
  const double bulk = world.params.dcm[type].bulk_modulus;
  const double before = dcm::cytosol_pressure(bulk, mother.volume, mother.rest_volume);
  daughters.stretch = mother.stretch;
  f.pressure = before;
  for (const std::vector<Vec3>& node : daughters.node) {
    const double volume = geometry::compute_volume(node, mother.topology->triangle);
    f.volume_error =
        std::max(f.volume_error, std::abs(volume - 0.5 * mother.volume) / mother.volume);
    f.outside = std::max(f.outside, farthest_outside(node, body));
    f.min_quality =
        std::min(f.min_quality, geometry::compute_quality(node, mother.topology->triangle));
    f.pressure_change =
        std::max(f.pressure_change,
                 std::abs(dcm::cytosol_pressure(bulk, volume, 0.5 * mother.rest_volume) - before));
  }
  return true;
}

}  // namespace acinus::coupling
