#include "dcm/contact/contact_loads.hpp"

#include <algorithm>
#include <cmath>

#include "contact/cohesive.hpp"
#include "contact/pair_adhesion.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/contact_sides.hpp"
#include "dcm/contact/triangle_contact.hpp"

namespace acinus::dcm {
namespace {

using contact::Contact, contact::Partner;

/// Share of its area with which a point has friction with a partner at this gap.
double touching_share(const ContactParams& c, const ContactWorkspace& work, int body, int point,
                      double gap) {
  const auto& share = work.share[body];
  return share_scale(share[point]) * contact::contact_share(gap, c.friction_range);
}

/// Coefficients of a contact of a point.
struct PointLaw {
  double area = 0;  ///< um^2, of the point
  contact::CohesiveLaw cohesive;
  double friction = 0;   ///< nN s/um^3
  double clearance = 0;  ///< um, distance from its repulsive branch
};

/// Completion of contacts: coefficients, force and friction.
struct Completion {
  const ContactInput& in;
  const ContactWorkspace& work;

  std::size_t lane_of(int body) const { return work.lane_of_body[body]; }
  const contact::SurfaceBody& body(int k) const { return work.body[k]; }
  std::size_t type_of(int body) const { return in.state.group[lane_of(body) / kLanes].type; }
  const Params& params_of(int body) const { return in.params[type_of(body)]; }
  double area(int k, int point) const {
    return point_area(*body(k).topology, in.options.quadrature, point, in.lanes.radius[lane_of(k)]);
  }
  contact::CohesiveLaw cohesive(int k, double adhesion, double repulsion) const {
    return {
        in.options.adhesion_factor * adhesion, repulsion,
        in.options.range_factor * body(k).topology->mean_rest_length * in.lanes.radius[lane_of(k)]};
  }
  contact::CohesiveLaw repulsion(double stiffness) const { return {0, stiffness, 1}; }

  PointLaw surface_law(Contact& k) const {
    const double half = 0.5 * area(k.a, k.point);  // found from both sides
    if (k.is_fold())
      return {half, repulsion(in.options.repulsion), 0, std::min(0.0, k.gap - kSelfGap)};
    const double share = touching_share(in.options, work, k.a, k.point, k.gap);
    k.touching = half * share;
    const double adhesion = contact::scale_adhesion(
        contact::pair_adhesion(params_of(k.a), params_of(k.b), type_of(k.b)), in.adhesion,
        lane_of(k.a), in.adhesion, lane_of(k.b));
    const bool rubs = in.options.friction_form == FrictionForm::kSurface;
    return {half, cohesive(k.a, adhesion, in.options.repulsion),
            rubs ? in.options.friction_factor * share * in.options.cell_friction : 0, k.gap};
  }

  PointLaw obstacle_law(Contact& k) const {
    if (k.only_pushes()) {
      const double pushing =
          k.guard ? guard_area(*body(k.a).topology, k.point, in.lanes.radius[lane_of(k.a)])
                  : area(k.a, k.point);
      return {pushing, repulsion(k.stiffness()), 0, k.gap + k.onset()};
    }
    const double whole = area(k.a, k.point);
    const double share = touching_share(in.options, work, k.a, k.point, k.gap);
    k.touching = whole * share;
    const contact::Material& m = contact::material_of(in.boundary, k.partner, k.b);
    const double stiffness = k.partner == Partner::kMesh ? in.options.repulsion : k.stiffness();
    return {whole, cohesive(k.a, m.adhesion, stiffness),
            m.mirror ? 0 : share * params_of(k.a).vessel_friction, k.gap};
  }

  /// Friction of a contact of a triangle, nN s/um^3.
  double triangle_friction(const Contact& k) const {
    if (k.partner == Partner::kSurface)
      return in.options.friction_form == FrictionForm::kSurface
                 ? in.options.friction_factor * in.options.cell_friction
                 : 0;
    return contact::material_of(in.boundary, k.partner, k.b).mirror
               ? 0
               : params_of(k.a).vessel_friction;
  }

  void complete(Contact& k, solve::Link& link, solve::LinkLaw& closed) const {
    if (is_triangle_contact(in.options, k)) {
      complete_triangle_contact(in, work, triangle_friction(k), k, link, closed);
      link.b = side_b(in, work, k);
      return;
    }
    const PointLaw law = k.partner == Partner::kSurface ? surface_law(k) : obstacle_law(k);
    const double friction = law.area * law.friction;
    k.force = -law.area * contact::cohesive_traction(law.cohesive, law.clearance);
    k.slope = law.area * contact::cohesive_stiffness(law.cohesive, law.clearance);
    k.friction = static_cast<float>(friction);
    link.a = side_at(in.state, lane_of(k.a), probe_stencil(in.options, body(k.a), k));
    link.b = side_b(in, work, k);
    const double gap = k.is_fold() ? law.clearance : k.gap;
    solve::set_law(k.slope, friction, gap, k.normal, link);
    closed.close({law.area * law.cohesive.repulsion, law.clearance});
  }
};

}  // namespace

double cell_friction_at(const ContactParams& c, const ContactWorkspace& work, const Contact& s) {
  return c.friction_factor * touching_share(c, work, s.a, s.point, s.gap) * c.cell_friction;
}

void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       contact::ContactList& contacts, solve::Links& links) {
  const Completion completion{in, work};
  const std::size_t first = links.size(), n = contacts.first(contact::ContactKind::kInterface);
  links.resize(first + n);
  for_each_index(n, worth_threads(in.state.n_row()), [&](std::size_t k) {
    Contact& c = contacts.all[k];
    solve::LinkLaw& law = links.law[first + k];
    completion.complete(c, links.link[first + k], law);
    law.contact = static_cast<std::uint32_t>(k);
  });
}

}  // namespace acinus::dcm
