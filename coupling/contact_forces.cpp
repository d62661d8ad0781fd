#include "coupling/contact_forces.hpp"

#include <algorithm>
#include <numeric>
#include <set>

#include "coupling/step/stages.hpp"

namespace acinus::coupling {
namespace {

/// The links of deformable cells in the order assemble() adds them.
Vec3 link_force(const Workspace& w, std::size_t link) {
  const solve::LinkLoad& load = w.system.links.load[link];
  return load.force * load.normal;
}

Vec3 place_of(const World& world, const Workspace& w, std::size_t body, int point) {
  const contact::SurfaceBody& b = w.dcm.body[body];
  return contact::point_position(
      b, contact::point_stencil(b, world.params.dcm_contact.quadrature, point));
}

/// Area with which a point of a deformable cell touches something at this gap, um^2.
double area_in_touch(const World& world, const Workspace& w, std::size_t body, int point,
                     double gap) {
  const dcm::ContactParams& c = world.params.dcm_contact;
  const double radius = w.lanes.radius[w.dcm.lane_of_body[body]];
  return dcm::point_area(*w.dcm.body[body].topology, c.quadrature, point, radius) *
         dcm::share_scale(w.dcm.share[body][static_cast<std::size_t>(point)]) *
         contact::contact_share(gap, c.friction_range);
}

/// The part of the surroundings a contact is with.
template <class AnyReactions>
auto& part_of(AnyReactions& reactions, const ContactForce& c) {
  const auto i = static_cast<std::size_t>(c.index);
  switch (c.kind) {
    case contact::SurroundingKind::kPlane:
      return reactions.plane[i];
    case contact::SurroundingKind::kCapsule:
      return reactions.capsule[i];
    case contact::SurroundingKind::kMesh:
      return reactions.mesh[i];
    case contact::SurroundingKind::kVessel:
      break;
  }
  return reactions.segment[i];
}

}  // namespace

void visit_contacts(const World& world, const Workspace& w,
                    const std::function<void(const ContactForce&)>& look) {
  const State& s = world.state;
  const std::size_t n_body = w.dcm.body.size();
  std::vector<Vec3> center;
  for (const std::size_t lane : w.dcm.lane_of_body) center.push_back(dcm::cell_center(s.dcm, lane));
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) center.push_back(cbm::center_of(s.cbm, c));

  for (std::size_t k = 0; k < w.dcm.surface.size(); ++k) {
    const contact::SurfaceContact& c = w.dcm.surface[k];
    ContactForce f;
    f.a = static_cast<std::size_t>(c.body_a);
    f.force = link_force(w, k);
    f.normal = c.normal;
    const Vec3 x = place_of(world, w, f.a, c.point);
    f.arm_a = x - center[f.a];
    if (const auto b = static_cast<std::size_t>(c.body_b); b < n_body) {
      f.b = b;
      f.arm_b = x - c.gap * c.normal - center[b];
      f.touching = f.a != b && f.force.squaredNorm() > 0;
    } else {
      f.kind = contact::SurroundingKind::kMesh;
      f.index = static_cast<int>(b - n_body);
      f.area = area_in_touch(world, w, f.a, c.point, c.gap);
    }
    look(f);
  }
  for (std::size_t k = 0; k < w.dcm.obstacle.size(); ++k) {
    const dcm::ObstacleContact& c = w.dcm.obstacle[k];
    ContactForce f;
    f.a = static_cast<std::size_t>(c.body);
    f.kind = c.kind;
    f.index = c.index;
    f.force = link_force(w, w.dcm.surface.size() + k);
    f.normal = c.normal;
    const contact::SurfaceBody& body = w.dcm.body[f.a];
    f.arm_a =
        contact::point_position(body, dcm::obstacle_stencil(world.params.dcm_contact, body, c)) -
        center[f.a];
    if (!c.only_pushes()) f.area = area_in_touch(world, w, f.a, c.point, c.gap);
    look(f);
  }
  for (const cbm::SphereContact& c : sphere_contacts(world, w)) {
    ContactForce f;
    f.a = n_body + static_cast<std::size_t>(c.a);
    f.b = n_body + static_cast<std::size_t>(c.b);
    f.force = c.law.force * c.normal;
    f.normal = c.normal;
    f.arm_a = -(w.cbm_radius[static_cast<std::size_t>(c.a)] - 0.5 * c.overlap) * c.normal;
    f.arm_b = (w.cbm_radius[static_cast<std::size_t>(c.b)] - 0.5 * c.overlap) * c.normal;
    f.touching = true;
    look(f);
  }
  for (const cbm::ObstacleContact& c : w.cbm.obstacle) {
    ContactForce f;
    f.a = n_body + static_cast<std::size_t>(c.cell);
    f.kind = c.kind;
    f.index = c.index;
    f.force = c.law.force * c.normal;
    f.normal = c.normal;
    f.arm_a = -(w.cbm_radius[static_cast<std::size_t>(c.cell)] - c.overlap) * c.normal;
    f.area = kPi * c.law.contact_radius * c.law.contact_radius;
    look(f);
  }
  const std::size_t first = w.dcm.surface.size() + w.dcm.obstacle.size();
  for (std::size_t k = 0; k < w.interface.contact.size(); ++k) {
    const InterfaceContact& c = w.interface.contact[k];
    ContactForce f;
    f.a = static_cast<std::size_t>(c.body);
    f.b = n_body + static_cast<std::size_t>(c.sphere);
    f.force = link_force(w, first + k);
    f.normal = c.normal;
    const Vec3 x = place_of(world, w, f.a, c.point);
    f.arm_a = x - center[f.a];
    f.arm_b = x - center[f.b];
    f.touching = f.force.squaredNorm() > 0;
    look(f);
  }
}

Reactions find_reactions(const World& world, const Workspace& w) {
  const contact::Surroundings& around = world.params.around;
  Reactions r;
  r.plane.resize(around.planes.size());
  r.capsule.resize(around.capsules.size());
  r.mesh.resize(around.meshes.size());
  r.segment.resize(around.vessels.network.segment.size());
  visit_contacts(world, w, [&](const ContactForce& c) {
    if (c.b != kNoCell) return;
    Reaction& part = part_of(r, c);
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

double interface_residual(const Workspace& w) {
  struct Load {
    Vec3 place, force;
  };
  std::vector<Load> loads;
  const std::size_t first = w.dcm.surface.size() + w.dcm.obstacle.size();
  for (std::size_t k = 0; k < w.interface.contact.size(); ++k) {
    const solve::Stencil stencil = solve::stencil_of(w.system.links.link[first + k]);
    for (std::size_t m = 0; m < static_cast<std::size_t>(stencil.n); ++m) {
      loads.push_back({load_point(w.position.data(), stencil.address[m]),
                       stencil.weight[m] * link_force(w, first + k)});
    }
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
