/// From contacts to links: the force, stiffness and friction each contact adds.

#include <cmath>

#include "dcm/contact.hpp"

namespace acinus::dcm {
namespace {

using contact::SurroundingKind;

const contact::Material& material_of(const contact::Surroundings& around, SurroundingKind kind,
                                     int index) {
  const auto i = static_cast<std::size_t>(index);
  switch (kind) {
    case SurroundingKind::kPlane:
      return around.planes[i].material;
    case SurroundingKind::kCapsule:
      return around.capsules[i].material;
    case SurroundingKind::kMesh:
      return around.meshes[i].material;
    case SurroundingKind::kVessel:
      break;
  }
  return around.vessels.material;
}

/// Force, stiffness and friction of a contact patch of area w.
void close_link(solve::Links& links, const contact::Well& well, double gap, double area,
                const Vec3& normal, double friction, bool external) {
  links.close(-area * contact::well_traction(well, gap) * normal,
              Sym3::outer(area * contact::well_stiffness(well, gap), normal),
              Sym3::identity(area * friction), external, normal, gap);
}

}  // namespace

void add_contact_loads(const State& state, std::span<const Params> params, const ContactParams& c,
                       const LaneData& lanes, const contact::Surroundings& around,
                       const ContactWorkspace& work, solve::Links& links) {
  auto params_of = [&](int body) -> const Params& {
    const std::size_t lane = work.lane_of_body[static_cast<std::size_t>(body)];
    return params[static_cast<std::size_t>(state.group[lane / kLanes].type)];
  };
  auto add_stencil = [&](int body, int point) {
    const std::size_t lane = work.lane_of_body[static_cast<std::size_t>(body)];
    const contact::PointStencil s =
        contact::point_stencil(work.body[static_cast<std::size_t>(body)], c.quadrature, point);
    for (int m = 0; m < s.n; ++m)
      links.add_point(node_address(state, lane, s.node[static_cast<std::size_t>(m)]),
                      s.weight[static_cast<std::size_t>(m)]);
  };
  auto area_and_share = [&](int body, int point) {
    const auto k = static_cast<std::size_t>(body);
    const double area =
        point_area(*work.body[k].topology, c.quadrature, point, lanes.radius[work.lane_of_body[k]]);
    return std::pair(area, share_scale(work.share[k][static_cast<std::size_t>(point)]));
  };
  auto well_of = [&](int body, double adhesion) {
    const auto k = static_cast<std::size_t>(body);
    return contact::Well{c.adhesion_factor * adhesion, c.repulsion,
                         c.range_factor * work.body[k].topology->mean_rest_length *
                             lanes.radius[work.lane_of_body[k]]};
  };

  const int n_body = static_cast<int>(work.body.size());
  for (const contact::SurfaceContact& s : work.surface) {
    const auto [area, scale] = area_and_share(s.body_a, s.point);
    const double chi = scale * contact::contact_share(s.gap, c.friction_range);
    const Params& a = params_of(s.body_a);
    add_stencil(s.body_a, s.point);
    if (s.body_b >= n_body) {  // a static mesh: probed from one side only, no unknowns behind it
      const contact::Material& m =
          around.meshes[static_cast<std::size_t>(s.body_b - n_body)].material;
      close_link(links, well_of(s.body_a, m.adhesion), s.gap, area, s.normal,
                 m.mirror ? 0 : chi * a.vessel_friction, true);
      continue;
    }
    const std::size_t lane_b = work.lane_of_body[static_cast<std::size_t>(s.body_b)];
    const auto& corner = (*work.body[static_cast<std::size_t>(s.body_b)]
                               .triangle)[static_cast<std::size_t>(s.triangle_b)];
    for (int m = 0; m < 3; ++m)
      links.add_point(node_address(state, lane_b, corner[static_cast<std::size_t>(m)]),
                      -s.weight_b[m]);
    if (s.body_a == s.body_b) {
      close_link(links, {0, c.repulsion, 1}, std::min(0.0, s.gap - kSelfGap), area / 2, s.normal, 0,
                 false);
    } else {
      const double adhesion = std::sqrt(a.adhesion * params_of(s.body_b).adhesion);
      close_link(links, well_of(s.body_a, adhesion), s.gap, area / 2, s.normal,
                 c.friction_factor * chi * c.cell_friction, false);
    }
  }
  for (const ObstacleContact& o : work.obstacle) {
    if (o.guard) {
      const auto k = static_cast<std::size_t>(o.body);
      const std::size_t lane = work.lane_of_body[k];
      const contact::PointStencil stencil = obstacle_stencil(c, work.body[k], o);
      for (int m = 0; m < stencil.n; ++m)
        links.add_point(node_address(state, lane, stencil.node[static_cast<std::size_t>(m)]),
                        stencil.weight[static_cast<std::size_t>(m)]);
      close_link(links, {0, c.repulsion, 1}, o.gap,
                 guard_area(*work.body[k].topology, o.point, lanes.radius[lane]), o.normal, 0,
                 true);
      continue;
    }
    const auto [area, scale] = area_and_share(o.body, o.point);
    const double chi = scale * contact::contact_share(o.gap, c.friction_range);
    const contact::Material& m = material_of(around, o.kind, o.index);
    add_stencil(o.body, o.point);
    close_link(links, well_of(o.body, m.adhesion), o.gap, area, o.normal,
               m.mirror ? 0 : chi * params_of(o.body).vessel_friction, true);
  }
}

}  // namespace acinus::dcm
