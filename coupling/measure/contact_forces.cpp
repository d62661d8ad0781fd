#include "coupling/measure/contact_forces.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

#include "coupling/step/stages.hpp"

namespace acinus::coupling {
namespace {

/// Where cells are: surfaces first, then spheres, as measure_cells lists them.
struct Places {
  const World& world;
  const Workspace& w;
  std::vector<Vec3> center;  ///< um

  Places(const World& of, const Workspace& work) : world(of), w(work) {
    for (const std::size_t lane : w.dcm.lane_of_body)
      center.push_back(dcm::cell_center(world.state.dcm, lane));
    for (std::size_t c = 0; c < world.state.cbm.n_cell(); ++c)
      center.push_back(cbm::center_of(world.state.cbm, c));
  }

  Vec3 point(const contact::Contact& k) const {
    const contact::SurfaceBody& body = w.dcm.body[k.a];
    return contact::point_position(body, dcm::stencil_of(world.params.dcm_contact, body, k));
  }

  /// Spheres meet in the middle of their overlap; with an obstacle it is the obstacle's surface.
  void set_arms_of_sphere(const contact::Contact& k, ContactForce& f) const {
    const std::vector<double>& radius = w.cbm_radius;
    const bool pair = k.partner == contact::Partner::kSphere;
    const double depth = pair ? -0.5 * k.gap : -k.gap;
    f.arm_a = -(radius[k.a] - depth) * k.normal;
    if (pair) f.arm_b = (radius[k.b] - depth) * k.normal;
  }

  void set_arms_of_surface(const contact::Contact& k, ContactForce& f) const {
    const Vec3 x = point(k);
    f.arm_a = x - center[f.a];
    if (f.b == kNoCell) return;
    const bool surfaces = k.partner == contact::Partner::kSurface;
    f.arm_b = (surfaces ? Vec3(x - k.gap * k.normal) : x) - center[f.b];
  }
};

void visit_fading(const World& world, const Places& places,
                  const std::function<void(const ContactForce&)>& look) {
  const State& s = world.state;
  if (s.fading.empty()) return;
  std::unordered_map<std::int64_t, std::size_t> number;
  for (const std::size_t lane : places.w.dcm.lane_of_body)
    number.emplace(s.dcm.lineage[lane], number.size());
  for (const std::int64_t lineage : s.cbm.lineage) number.emplace(lineage, number.size());
  for (const FadingForce& fading : s.fading) {
    const auto a = number.find(fading.a), b = number.find(fading.b);
    const bool boundary = fading.b == kNoPartner;
    if (a == number.end() || (b == number.end() && !boundary)) continue;
    ContactForce f;
    f.a = a->second;
    const Vec3& center = places.center[f.a];
    const Vec3 apart = boundary ? center : Vec3(center - places.center[b->second]);
    const double share = left_of(fading, s.clock.time, apart);
    f.force = share * fading.force;
    const double size = f.force.norm();
    if (!(size > 0)) continue;
    f.arm_a = (share * fading.virial / size) * (f.force / size);
    if (!boundary) {
      f.b = b->second;
      f.normal = apart.normalized();
      f.arm_b = f.arm_a + apart;
    }
    f.fades = true;
    look(f);
  }
}

}  // namespace

void visit_contacts(const World& world, const Workspace& w,
                    const std::function<void(const ContactForce&)>& look) {
  const Places places(world, w);
  const std::size_t n_body = w.dcm.body.size();
  for (const contact::Contact& k : w.contacts.all) {
    const bool sphere = k.point == contact::kWhole;
    ContactForce f;
    f.a = static_cast<std::size_t>(k.a) + (sphere ? n_body : 0);
    f.force = k.force * k.normal;
    f.normal = k.normal;
    if (contact::is_cell(k.partner)) {
      f.b = static_cast<std::size_t>(k.b) + (k.partner == contact::Partner::kSphere ? n_body : 0);
      f.touching = f.a != f.b && (sphere || f.force.squaredNorm() > 0);
    } else {
      f.kind = k.partner;
      f.index = k.b;
      f.area = k.touching;
    }
    if (sphere)
      places.set_arms_of_sphere(k, f);
    else
      places.set_arms_of_surface(k, f);
    look(f);
  }
  visit_fading(world, places, look);
}

Reactions find_reactions(const World& world, const Workspace& w) {
  const contact::Boundary& boundary = world.params.boundary;
  Reactions r;
  const auto part_of = [&r](contact::Partner kind) -> std::vector<Reaction>& {
    return r.part[static_cast<std::size_t>(kind)];
  };
  contact::for_each_wall(
      boundary, [&](contact::Partner kind, auto, const auto&) { part_of(kind).emplace_back(); });
  part_of(contact::Partner::kMesh).resize(boundary.meshes.size());
  part_of(contact::Partner::kVessel).resize(boundary.vessels.network.segment.size());
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (c.b != kNoCell || c.fades) return;
    const std::size_t at = c.index;
    Reaction& part = part_of(c.kind)[at];
    part.net -= c.force;
    part.normal += c.force.dot(c.normal);
    part.area += c.area;
  });
  return r;
}

std::vector<std::pair<std::size_t, std::size_t>> find_touching(const World& world,
                                                               const Workspace& w) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (c.touching) pairs.emplace(std::min(c.a, c.b), std::max(c.a, c.b));
  });
  return {pairs.begin(), pairs.end()};
}

std::vector<int> cluster_sizes(std::size_t n_cell,
                               const std::vector<std::pair<std::size_t, std::size_t>>& touching) {
  std::vector<std::size_t> root(n_cell);
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b] : touching) root[find(b)] = find(a);
  std::vector<int> members(n_cell, 0), size(n_cell, 0);
  for (std::size_t i = 0; i < n_cell; ++i) ++members[find(i)];
  for (std::size_t i = 0; i < n_cell; ++i) size[i] = members[find(i)];
  return size;
}

double interface_residual(const World& world, const Workspace& w) {
  struct Load {
    Vec3 place, force;
  };
  std::vector<Load> loads;
  for (const contact::Contact& k : w.contacts.interface()) {
    const solve::Stencil stencil = stencil_of(world, w, k);
    for (int m = 0; m < stencil.n; ++m)
      loads.push_back({load_point(w.position.data(), stencil.address[m]),
                       stencil.weight[m] * (k.force * k.normal)});
  }
  if (loads.empty()) return 0;
  Vec3 middle = Vec3::Zero(), force = Vec3::Zero(), torque = Vec3::Zero();
  for (const Load& l : loads) middle += l.place / static_cast<double>(loads.size());
  double size = 0, moment = 0;
  for (const Load& l : loads) {
    force += l.force;
    size += l.force.norm();
    torque += (l.place - middle).cross(l.force);
    moment += (l.place - middle).norm() * l.force.norm();
  }
  return size > 0 ? std::max(force.norm() / size, torque.norm() / moment) : 0;
}

}  // namespace acinus::coupling
