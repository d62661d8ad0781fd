#include "coupling/measure/adhesion.hpp"

#include <algorithm>
#include <limits>

#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_points.hpp"

namespace acinus::coupling {
namespace {

/// Range of the cohesive potential of the probing cell, um.
double range_of(const World& world, const Workspace& w, int body) {
  const std::size_t b = body;
  return world.params.dcm_contact.range_factor * w.dcm.body[b].topology->mean_rest_length *
         w.lanes.radius[w.dcm.lane_of_body[b]];
}

bool adheres(const World& world, const Workspace& w, const contact::Contact& k) {
  if (k.partner != contact::Partner::kSurface || k.is_fold()) return false;
  return dcm::is_triangle_contact(world.params.dcm_contact, k) || k.gap < range_of(world, w, k.a);
}

/// Adhering area of a contact, um^2.
double area_of(const World& world, const Workspace& w, const contact::Contact& k) {
  const dcm::ContactParams& options = world.params.dcm_contact;
  if (dcm::is_triangle_contact(options, k)) return k.touching;
  const std::size_t a = k.a;
  return 0.5 * dcm::point_area(*w.dcm.body[a].topology, options.quadrature, k.point,
                               w.lanes.radius[w.dcm.lane_of_body[a]]);
}

}  // namespace

Adhesion measure_adhesion(const World& world, const Workspace& w) {
  const dcm::ContactParams& options = world.params.dcm_contact;
  std::vector<std::size_t> first{0};
  for (const contact::SurfaceBody& b : w.dcm.body) first.push_back(first.back() + b.node.size());
  Adhesion adhesion;
  adhesion.node.assign(first.back(), 0);
  for (const contact::Contact& k : w.contacts.surface()) {
    if (!adheres(world, w, k)) continue;
    const std::size_t a = k.a;
    const contact::SurfaceBody& body = w.dcm.body[a];
    adhesion.area += area_of(world, w, k);
    const contact::PointStencil stencil = dcm::stencil_of(options, body, k);
    for (int m = 0; m < stencil.n; ++m)
      if (stencil.weight[m] > 0) adhesion.node[first[a] + stencil.node[m]] = 1;
    if (!dcm::is_triangle_contact(options, k)) continue;  // points of b are seen from b
    const std::size_t b = k.b;
    for (const int node : (*w.dcm.body[b].triangle)[k.triangle]) adhesion.node[first[b] + node] = 1;
  }
  return adhesion;
}

bool any_adhesion(const World& world, const Workspace& w) {
  return std::ranges::any_of(w.contacts.surface(),
                             [&](const contact::Contact& k) { return adheres(world, w, k); });
}

ContactTensions compute_contact_tensions(const std::vector<double>& tension,
                                         const Adhesion& adhesion) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double sum[2] = {0, 0};
  int n[2] = {0, 0};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < tension.size(); ++i) {
    const int side = adhesion.node[i] != 0 ? 1 : 0;
    sum[side] += tension[i];
    ++n[side];
    if (side == 1) least = std::min(least, tension[i]);
  }
  return {n[0] > 0 ? sum[0] / n[0] : kNone, n[1] > 0 ? sum[1] / n[1] : kNone,
          n[1] > 0 ? least : kNone};
}

}  // namespace acinus::coupling
