#include "coupling/zoom/cell_volume.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace acinus::coupling {
namespace {

/// Least extent of the available volume in any direction, over the radius.
constexpr double kLeastReach = 0.2;
constexpr int kTracingSteps = 60;     ///< largest number of steps along a ray
constexpr double kTracingGap = 1e-3;  ///< um, gap to a surface that ends a ray

/// Triangle of a neighbour's surface that faces the centre.
struct Facing {
  std::array<Vec3, 3> corner;  ///< um, from the centre
  Vec3 axis = Vec3::UnitX();   ///< unit axis of its bounding cone
  double least_cosine = 1;     ///< cosine of the half angle of that cone
};

/// Bounds of the available volume of a sphere.
struct VolumeBounds {
  Vec3 center = Vec3::Zero();
  double farthest = 0, time = 0;
  std::vector<dcm::VolumeFace> face;
  std::vector<Facing> facing;
  contact::Boundary boundary;  ///< walls only
  const geometry::Network* network = nullptr;
  std::vector<int> segment;
  std::vector<const contact::StaticMesh*> mesh;
};

void add_spheres(const cbm::State& s, std::size_t self, std::span<const double> radius,
                 VolumeBounds& around) {
  for (std::size_t c = 0; c < s.n_cell(); ++c) {
    if (c == self) continue;
    const Vec3 way = cbm::center_of(s, c) - around.center;
    const double distance = way.norm();
    if (distance > around.farthest + radius[c] || !(distance > 0)) continue;
    const double share = dcm::share_of_distance(radius[self], radius[c], distance);
    around.face.push_back({way / distance, share * distance});
  }
}

void add_surface(const dcm::State& s, std::size_t lane, VolumeBounds& around) {
  thread_local std::vector<Vec3> node;
  dcm::copy_nodes(s, lane, node);
  double nearest = around.farthest;
  for (const Vec3& x : node) nearest = std::min(nearest, (x - around.center).norm());
  if (!(nearest < around.farthest)) return;
  for (const auto& corner : s.group[lane / kLanes].topology->triangle) {
    Facing f;
    Vec3 middle = Vec3::Zero();
    double least = around.farthest;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t i = static_cast<std::size_t>(corner[k]);
      f.corner[k] = node[i] - around.center;
      middle += f.corner[k];
      least = std::min(least, f.corner[k].norm());
    }
    const Vec3 normal = (f.corner[1] - f.corner[0]).cross(f.corner[2] - f.corner[0]);
    if (least >= around.farthest || normal.dot(middle) >= 0) continue;  // its outer side faces away
    f.axis = middle.normalized();
    for (const Vec3& x : f.corner)
      f.least_cosine = std::min(f.least_cosine, f.axis.dot(x.normalized()));
    around.facing.push_back(f);
  }
}

void add_boundary(const contact::Boundary& b, VolumeBounds& around) {
  const auto is_near = [&](double gap) { return gap < around.farthest; };
  const auto keep_near = [&](const auto& walls, auto& kept) {
    for (const auto& wall : walls)
      if (is_near(contact::gap_to_wall(wall, around.center, around.time).gap)) kept.push_back(wall);
  };
  keep_near(b.planes, around.boundary.planes);
  keep_near(b.capsules, around.boundary.capsules);
  keep_near(b.pipettes, around.boundary.pipettes);
  around.network = &b.vessels.network;
  for (int s = 0; s < static_cast<int>(b.vessels.network.segment.size()); ++s)
    if (is_near(contact::gap_to_segment(b.vessels.network, s, around.center).gap))
      around.segment.push_back(s);
  for (const contact::StaticMesh& m : b.meshes)
    if (is_near(contact::gap_to_mesh(m.body, around.center, around.farthest).gap))
      around.mesh.push_back(&m);
}

bool has_boundary(const VolumeBounds& around) {
  return !around.boundary.empty() || !around.segment.empty() || !around.mesh.empty();
}

double gap_at(const VolumeBounds& around, const Vec3& x) {
  double gap = around.farthest;
  contact::for_each_wall(around.boundary, [&](auto, auto, const auto& wall) {
    gap = std::min(gap, contact::gap_to_wall(wall, x, around.time).gap);
  });
  for (const int s : around.segment)
    gap = std::min(gap, contact::gap_to_segment(*around.network, s, x).gap);
  for (const contact::StaticMesh* m : around.mesh)
    gap = std::min(gap, contact::gap_to_mesh(m->body, x, around.farthest).gap);
  return gap;
}

/// Length of a ray up to rigid surfaces, um, by sphere tracing.
double trace(const VolumeBounds& around, const Vec3& direction, double farthest) {
  double reach = 0;
  for (int step = 0; step < kTracingSteps && reach < farthest; ++step) {
    const double gap = gap_at(around, around.center + reach * direction);
    if (gap < kTracingGap) return reach;
    reach += gap;
  }
  return std::min(reach, farthest);
}

double reach_to_triangle(const Facing& f, const Vec3& direction, double farthest) {
  const Vec3 &a = f.corner[0], ab = f.corner[1] - a, ac = f.corner[2] - a;
  const Vec3 p = direction.cross(ac);
  const double determinant = ab.dot(p);
  if (determinant == 0) return farthest;
  const double u = -a.dot(p) / determinant;
  const Vec3 q = -a.cross(ab);
  const double v = direction.dot(q) / determinant;
  if (u < 0 || v < 0 || u + v > 1) return farthest;
  const double t = ac.dot(q) / determinant;
  return t > 0 ? std::min(t, farthest) : farthest;
}

double compute_reach(const VolumeBounds& around, const Vec3& direction) {
  double reach = dcm::reach_to_faces(direction, around.farthest, around.face);
  for (const Facing& f : around.facing)
    if (direction.dot(f.axis) >= f.least_cosine) reach = reach_to_triangle(f, direction, reach);
  if (has_boundary(around)) reach = trace(around, direction, reach);
  return std::max(reach, kLeastReach / kRayReach * around.farthest);
}

}  // namespace

dcm::AvailableVolume make_available_volume(const World& world, std::size_t sphere,
                                           std::span<const double> radius) {
  const State& s = world.state;
  VolumeBounds around;
  around.center = cbm::center_of(s.cbm, sphere);
  around.farthest = kRayReach * radius[sphere];
  around.time = time_since_start(world);
  add_spheres(s.cbm, sphere, radius, around);
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l)
    if (s.dcm.active(l)) add_surface(s.dcm, l, around);
  add_boundary(world.params.boundary, around);
  return {around.center, [around](const Vec3& d) { return compute_reach(around, d); }};
}

}  // namespace acinus::coupling
