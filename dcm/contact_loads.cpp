/// From contacts to links: the force, stiffness and friction each contact adds.

#include <algorithm>
#include <cmath>

#include "core/threads.hpp"
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

/// Share of its area with which a point rubs on a partner at this gap.
double touching_share(const ContactParams& c, const ContactWorkspace& work, int body, int point,
                      double gap) {
  const auto& share = work.share[static_cast<std::size_t>(body)];
  return share_scale(share[static_cast<std::size_t>(point)]) *
         contact::contact_share(gap, c.friction_range);
}

/// What a contact patch of this area does.
struct Patch {
  contact::Well well;
  double area = 0, friction = 0;
  double depth = 0;  ///< um, how deep inside the law begins
};

/// Everything that turns a contact into a link.
struct Builder {
  const State& state;
  std::span<const Params> params;
  const ContactParams& c;
  const LaneData& lanes;
  const contact::Surroundings& around;
  const ContactWorkspace& work;

  std::size_t lane_of(int body) const { return work.lane_of_body[static_cast<std::size_t>(body)]; }
  const contact::SurfaceBody& body(int k) const { return work.body[static_cast<std::size_t>(k)]; }
  const Params& params_of(int body) const {
    return params[static_cast<std::size_t>(state.group[lane_of(body) / kLanes].type)];
  }
  solve::Side side(int body, const contact::PointStencil& s) const {
    return side_at(state, lane_of(body), s);
  }
  double area(int k, int point) const {
    return point_area(*body(k).topology, c.quadrature, point, lanes.radius[lane_of(k)]);
  }
  double touching(int k, int point, double gap) const {
    return touching_share(c, work, k, point, gap);
  }
  contact::Well well(int k, double adhesion) const {
    return {c.adhesion_factor * adhesion, c.repulsion,
            c.range_factor * body(k).topology->mean_rest_length * lanes.radius[lane_of(k)]};
  }
  contact::Well repulsion() const { return {0, c.repulsion, 1}; }

  void surface_link(const contact::SurfaceContact& s, solve::Link& link,
                    solve::LinkLoad& load) const {
    link.a = side(s.body_a, contact::point_stencil(body(s.body_a), c.quadrature, s.point));
    const Params& a = params_of(s.body_a);
    const auto b = static_cast<std::size_t>(s.body_b);
    if (b >= work.body.size()) {  // a static mesh: probed from one side, no unknowns behind it
      const contact::Material& m = around.meshes[b - work.body.size()].material;
      link.b = solve::Side::nowhere();
      const double friction = m.mirror ? 0 : touching(s.body_a, s.point, s.gap) * a.vessel_friction;
      fill({well(s.body_a, m.adhesion), area(s.body_a, s.point), friction}, s.gap, s.normal, link,
           load);
      return;
    }
    const auto weight = s.weights();
    link.b = side(s.body_b,
                  {3, (*body(s.body_b).triangle)[static_cast<std::size_t>(s.triangle_b)], weight});
    const double half = 0.5 * area(s.body_a, s.point);  // seen from both sides
    if (s.body_a == s.body_b) {
      fill({repulsion(), half, 0}, std::min(0.0, s.gap - kSelfGap), s.normal, link, load);
      return;
    }
    const double adhesion = std::sqrt(a.adhesion * params_of(s.body_b).adhesion);
    const double friction =
        c.friction_form == FrictionForm::kSurface ? cell_friction_at(c, work, s) : 0;
    fill({well(s.body_a, adhesion), half, friction}, s.gap, s.normal, link, load);
  }

  void obstacle_link(const ObstacleContact& o, solve::Link& link, solve::LinkLoad& load) const {
    link.a = side(o.body, obstacle_stencil(c, body(o.body), o));
    link.b = solve::Side::nowhere();
    if (o.only_pushes()) {
      const double pushing =
          o.guard ? guard_area(*body(o.body).topology, o.point, lanes.radius[lane_of(o.body)])
                  : area(o.body, o.point);
      fill({{0, o.stiffness, 1}, pushing, 0, o.onset}, o.gap, o.normal, link, load);
      return;
    }
    const contact::Material& m = material_of(around, o.kind, o.index);
    const double friction =
        m.mirror ? 0 : touching(o.body, o.point, o.gap) * params_of(o.body).vessel_friction;
    contact::Well law = well(o.body, m.adhesion);
    law.repulsion = o.stiffness;
    fill({law, area(o.body, o.point), friction}, o.gap, o.normal, link, load);
  }

  static void fill(const Patch& p, double gap, const Vec3& normal, solve::Link& link,
                   solve::LinkLoad& load) {
    const double at = gap + p.depth;
    solve::set_law(p.area * contact::well_stiffness(p.well, at), p.area * p.friction, gap, normal,
                   link);
    load = {normal, -p.area * contact::well_traction(p.well, at), p.area * p.well.repulsion, at};
  }
};

}  // namespace

double cell_friction_at(const ContactParams& c, const ContactWorkspace& work,
                        const contact::SurfaceContact& s) {
  return c.friction_factor * touching_share(c, work, s.body_a, s.point, s.gap) * c.cell_friction;
}

solve::Side side_at(const State& state, std::size_t lane, const contact::PointStencil& s) {
  auto point = [&](int m) {
    return static_cast<solve::Point>(
        (state.group[lane / kLanes].first_row +
         static_cast<std::size_t>(s.node[static_cast<std::size_t>(m)])) *
            kLanes +
        lane % kLanes);
  };
  if (s.n == 1) return solve::Side::at(point(0));
  return {{point(0), point(1), point(2)},
          {static_cast<float>(s.weight[0]), static_cast<float>(s.weight[1])}};
}

void add_contact_loads(const State& state, std::span<const Params> params, const ContactParams& c,
                       const LaneData& lanes, const contact::Surroundings& around,
                       const ContactWorkspace& work, solve::Links& links) {
  const Builder build{state, params, c, lanes, around, work};
  const std::size_t first = links.size(), n = work.surface.size();
  links.resize(first + n + work.obstacle.size());
#pragma omp parallel for schedule(static) if (worth_threads(state.n_row()))
  for (std::size_t k = 0; k < n + work.obstacle.size(); ++k) {
    solve::Link& link = links.link[first + k];
    solve::LinkLoad& load = links.load[first + k];
    if (k < n)
      build.surface_link(work.surface[k], link, load);
    else
      build.obstacle_link(work.obstacle[k - n], link, load);
  }
}

}  // namespace acinus::dcm
