#include "coupling/interface/interface.hpp"

#include <algorithm>
#include <cmath>

#include "contact/cohesive.hpp"
#include "contact/pair_adhesion.hpp"
#include "core/parallel/append_in_order.hpp"
#include "dcm/contact/contact.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_loads.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/contact_sides.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/triangle_contact.hpp"
#include "geometry/box_pairs.hpp"

namespace acinus::coupling {
namespace {

using contact::Contact;

/// Deformable surface and sphere of a pair.
struct PairLaw {
  contact::CohesiveLaw cohesive;
  double hardening = 0;  ///< nN/um^4, derivative of the stiffness with respect to indentation
};

/// Adhesion energy of a deformable cell and a sphere in this step, nN/um.
double pair_adhesion(const InterfaceInput& in, std::size_t lane, std::size_t sphere) {
  const std::size_t type = in.cbm.state.type[sphere];
  const dcm::Params& a = in.dcm.params[in.dcm.state.group[lane / kLanes].type];
  return in.dcm.options.adhesion_factor *
         contact::scale_adhesion(contact::pair_adhesion(a, in.cbm.params[type], type),
                                 in.dcm.adhesion, lane, in.cbm.cells.adhesion, sphere);
}

PairLaw law_of(const InterfaceInput& in, const dcm::ContactWorkspace& dcm_work,
               std::span<const cbm::Modulus> modulus, const Contact& k) {
  const std::size_t body = k.a, sphere = k.b;
  const std::size_t lane = dcm_work.lane_of_body[body];
  const cbm::Params& b = in.cbm.params[in.cbm.state.type[sphere]];
  const Compliance under =
      compute_compliance(in.dcm.options.repulsion,
                         {in.cbm.cells.radius[sphere], in.cbm.state.young[sphere], b.poisson,
                          modulus[sphere], b.correction.corrects() ? &b.correction : nullptr},
                         k.depth());
  return {{pair_adhesion(in, lane, sphere), under.stiffness,
           in.dcm.options.range_factor * dcm_work.body[body].topology->mean_rest_length *
               in.dcm.lanes.radius[lane]},
          k.gap < 0 ? under.slope * k.depth() : 0};
}

/// Contacts of one surface with one sphere.
void find_pair(const InterfaceInput& in, const dcm::ContactWorkspace& dcm_work,
               std::pair<int, int> pair, double range, contact::Contacts& found) {
  const contact::SurfaceBody& b = dcm_work.body[pair.first];
  const contact::Quadrature q = in.dcm.options.quadrature;
  const std::size_t sphere = pair.second;
  const Vec3 center = cbm::center_of(in.cbm.state, sphere);
  const double radius = in.cbm.cells.radius[sphere];
  const int per_site = contact::points_per_site(q);
  const std::size_t first = found.size();
  for (std::size_t site = 0; site < contact::n_sites(b, q); ++site) {
    const Vec3 at = contact::site_place(b, q, site);
    const double far = radius + range + contact::site_reach(b, q, site);
    if ((at - center).squaredNorm() > far * far) continue;
    const Vec3 outward = contact::site_normal(b, q, site);
    for (int n = 0; n < per_site; ++n) {
      const int point = static_cast<int>(site) * per_site + n;
      const Vec3 d = contact::point_position(b, contact::point_stencil(b, q, point)) - center;
      const double distance = d.norm(), gap = distance - radius;
      if (gap < range && distance > 0 && contact::are_facing(outward, d / distance))
        found.push_back({.a = pair.first,
                         .point = point,
                         .b = pair.second,
                         .partner = contact::Partner::kSphere,
                         .normal = d / distance,
                         .gap = gap});
    }
  }
  const std::span<Contact> own = std::span(found).subspan(first);
  double depth = 0;
  for (const Contact& k : own) depth = std::max(depth, -k.gap);
  for (Contact& k : own) k.place_a = Contact::pack(depth);
}

/// Contacts of the triangles of one surface with one sphere.
void find_triangle_pair(const InterfaceInput& in, const dcm::ContactWorkspace& dcm_work,
                        const cbm::ContactWorkspace& cbm_work, std::pair<int, int> pair,
                        double reach, contact::Contacts& found) {
  const std::size_t body = pair.first, sphere = pair.second;
  const std::size_t lane = dcm_work.lane_of_body[body];
  const Vec3 center = cbm::center_of(in.cbm.state, sphere);
  const double radius = in.cbm.cells.radius[sphere];
  const contact::MaugisLaw law = dcm::maugis_law(
      in.dcm.options, {pair_adhesion(in, lane, sphere), surface_modulus(in.cbm, cbm_work, sphere)});
  const Contact like{.a = pair.first, .b = pair.second, .partner = contact::Partner::kSphere};
  const std::vector<contact::CurvedTriangle>& triangle = dcm_work.triangles.curved[body];
  for (std::size_t t = 0; t < triangle.size(); ++t) {
    const Vec3 d = triangle[t].circumcenter - center;
    const double distance = d.norm();
    if (!(distance > 0) || distance > radius + triangle[t].circumradius + reach) continue;
    const Vec3 outward = d / distance;
    Contact k = like;
    k.point = static_cast<int>(t);
    dcm::add_object_contacts(law, triangle[t], {center + radius * outward, outward, 0, 1 / radius},
                             k, &center, found);
  }
}

/// Finds the contacts of all pairs and notes the area of each pair.
/// @param find      appends those of pair p: (p, contacts)
/// @param touching  contact -> um^2
template <class Find, class Touching>
void find_of_pairs(InterfaceWorkspace& work, contact::ContactList& contacts, const Find& find,
                   const Touching& touching) {
  append_in_order(work.near.size(), true, contacts.all, find);
  contacts.close(contact::ContactKind::kInterface);
  const std::span<const Contact> all = contacts.interface();
  for (std::size_t k = 0, n = 0; n < work.near.size(); ++n) {
    const auto [body, sphere] = work.near[n];
    double area = 0;
    for (; k < all.size() && all[k].a == body && all[k].b == sphere; ++k) area += touching(all[k]);
    if (area > 0) work.area.emplace_back(sphere, area);
  }
}

/// Candidate pairs of surfaces and spheres (broad phase).
void find_near(const InterfaceInput& in, double range, dcm::ContactWorkspace& dcm_work,
               cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work) {
  work.body.clear();
  work.sphere.clear();
  work.number.clear();
  for (const contact::SurfaceBody& b : dcm_work.body) work.body.push_back(b.box);
  for (std::size_t i = 0; i < in.cbm.state.n_cell(); ++i) {
    if (cbm_work.is_absent(i)) continue;
    work.sphere.push_back(sphere_box(cbm::center_of(in.cbm.state, i), in.cbm.cells.radius[i]));
    work.number.push_back(static_cast<int>(i));
  }
  geometry::find_pairs_between(work.body, work.sphere, range, work.near);
  for (std::pair<int, int>& p : work.near) p.second = work.number[p.second];
  if (dcm_work.ghost.empty() && cbm_work.ghost.empty()) return;
  std::erase_if(work.near, [&](const std::pair<int, int>& p) {
    return dcm_work.is_ghost_body(p.first) && cbm_work.is_ghost(p.second);
  });
  std::vector<int> bodies;
  for (const auto& [body, sphere] : work.near) {
    bodies.push_back(body);
    cbm_work.come_near(static_cast<std::size_t>(sphere));
  }
  complete_bodies(in.dcm.state, bodies, dcm_work);
  for (const int b : bodies)
    dcm_work.share[b].resize(contact::n_points(dcm_work.body[b], in.dcm.options.quadrature));
}

}  // namespace

Compliance compute_compliance(double repulsion, const SphereSurface& sphere, double depth) {
  const double d = depth / sphere.radius;
  cbm::Modulus modulus{sphere.modulus.value, 0};
  if (sphere.law) {
    const cbm::Modulus here = cbm::corrected_modulus(*sphere.law, sphere.young, d);
    if (here.value > modulus.value) modulus = here;
  }
  const double per_modulus = 4 / (3 * kPi * sphere.radius * (1 - sphere.poisson * sphere.poisson) *
                                  std::sqrt(std::clamp(d, kLeastDepth, kMostDepth)));
  const double winkler = per_modulus * modulus.value, together = 1 / (1 / repulsion + 1 / winkler);
  // The softening by a growing contact area is left out; the matrix may be too stiff.
  const double yields = together / winkler;
  return {together, yields * yields * per_modulus * modulus.slope / sphere.radius};
}

void find_interface(const InterfaceInput& in, dcm::ContactWorkspace& dcm_work,
                    cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work,
                    contact::ContactList& contacts) {
  work.area.clear();
  work.near.clear();
  contacts.close(contact::ContactKind::kInterface);
  if (dcm_work.body.empty() || in.cbm.state.n_cell() == 0) return;
  const dcm::ContactParams& c = in.dcm.options;
  const std::span<const double> radius = in.dcm.lanes.radius, sphere_radius = in.cbm.cells.radius;
  const bool triangles = c.law == dcm::ContactLaw::kMaugisDugdale;
  double range = triangles ? dcm::triangle_reach(in.dcm) : 0;
  const dcm::State& shells = in.dcm.state;  // absent ones too: the range is that of all processes
  for (std::size_t l = 0; l < shells.n_lane(); ++l)
    if (shells.active(l))
      range = std::max(range, dcm::contact_range(c, *shells.group[l / kLanes].topology, radius[l]));
  find_near(in, range, dcm_work, cbm_work, work);
  for (const auto& [body, sphere] : work.near) {
    const std::size_t lane = dcm_work.lane_of_body[body], i = sphere;
    // A deformable neighbour counts in the sphere's overlap with its reference radius, by the
    // distance of the centres alone: whether surfaces touch changes from step to step, and with it
    // the modulus would.
    if (!cbm_work.overlap_sum.empty()) {
      const double reach = radius[lane] + sphere_radius[i];
      const double relative =
          1 -
          (dcm::cell_center(in.dcm.state, lane) - cbm::center_of(in.cbm.state, i)).norm() / reach;
      cbm::count_overlap(cbm_work, i, std::max(relative, 0.0), 1);
    }
  }
  std::erase_if(work.near, [&](const std::pair<int, int>& p) {
    return dcm_work.is_constrained_body(static_cast<std::size_t>(p.first)) &&
           cbm_work.is_constrained(static_cast<std::size_t>(p.second));
  });
  if (triangles) return;
  const auto find = [&](std::size_t p, contact::Contacts& found) {
    find_pair(in, dcm_work, work.near[p], range, found);
  };
  find_of_pairs(work, contacts, find, [&](const Contact& m) {
    const std::size_t k = m.a;
    const double share = contact::contact_share(m.gap, c.friction_range);
    dcm_work.share[k][m.point] += share;
    return share * dcm::point_area(*dcm_work.body[k].topology, c.quadrature, m.point,
                                   radius[dcm_work.lane_of_body[k]]);
  });
}

void find_triangle_interface(const InterfaceInput& in, dcm::ContactWorkspace& dcm_work,
                             const cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work,
                             contact::ContactList& contacts) {
  if (dcm_work.body.empty() || in.cbm.state.n_cell() == 0) return;
  const double reach = dcm::triangle_reach(in.dcm);
  dcm::refresh_curved_triangles(dcm_work);
  const auto find = [&](std::size_t p, contact::Contacts& found) {
    find_triangle_pair(in, dcm_work, cbm_work, work.near[p], reach, found);
  };
  find_of_pairs(work, contacts, find, [](const Contact& m) { return m.touching; });
  dcm::add_triangle_shares(contacts.interface(), dcm_work);
}

double surface_modulus(const cbm::ContactInput& in, const cbm::ContactWorkspace& work,
                       std::size_t sphere) {
  const cbm::Params& p = in.params[in.state.type[sphere]];
  double young = in.state.young[sphere];
  if (p.correction.corrects())
    young = cbm::corrected_modulus(p.correction, young,
                                   cbm::relative_overlap(work, sphere, p.correction))
                .value;
  return young / (1 - p.poisson * p.poisson);
}

void add_interface_areas(const InterfaceWorkspace& work, cbm::ContactWorkspace& cbm_work) {
  for (const auto& [sphere, area] : work.area) cbm_work.contact_area[sphere] += area;
}

solve::Side sphere_side(const InterfaceInput& in, const Contact& k) {
  return solve::Side::at(cbm::cell_point(in.cbm.first_row, k.b));
}

void add_interface_loads(const InterfaceInput& in, const dcm::ContactWorkspace& dcm_work,
                         std::span<const cbm::Modulus> modulus, contact::ContactList& contacts,
                         solve::Links& links) {
  std::size_t at = links.size();
  links.resize(at + contacts.interface().size());
  std::size_t number = contacts.first(contact::ContactKind::kInterface);
  for (Contact& k : contacts.of(contact::ContactKind::kInterface)) {
    solve::Link& link = links.link[at];
    link.b = sphere_side(in, k);
    const auto contact_number = static_cast<std::uint32_t>(number++);
    if (dcm::is_triangle_contact(in.dcm.options, k)) {
      dcm::complete_triangle_contact(
          in.dcm, dcm_work, in.params.friction_factor * in.params.friction, k, link, links.law[at]);
      links.law[at++].contact = contact_number;
      continue;
    }
    const contact::SurfaceBody& body = dcm_work.body[k.a];
    const double radius = in.dcm.lanes.radius[dcm_work.lane_of_body[k.a]];
    const contact::Quadrature quadrature = in.dcm.options.quadrature;
    PairLaw law = law_of(in, dcm_work, modulus, k);
    // The bed under a stretched surface is as wide as that is now: with its area at rest a tongue
    // of a deformable cell would find a sphere the softer the farther it flows.
    const double stretch = dcm::point_stretch(body, quadrature, k.point, radius);
    law.cohesive.repulsion *= stretch;
    law.hardening *= stretch;
    const double area = dcm::point_area(*body.topology, quadrature, k.point, radius);
    const double share = dcm::share_scale(dcm_work.share[k.a][k.point]) *
                         contact::contact_share(k.gap, in.dcm.options.friction_range);
    const double friction = in.params.friction_factor * in.params.friction * area * share;
    k.touching = area * share;
    k.force = -area * contact::cohesive_traction(law.cohesive, k.gap);
    k.slope = area * (contact::cohesive_stiffness(law.cohesive, k.gap) + law.hardening);
    k.friction = static_cast<float>(friction);
    link.a = dcm::side_a(in.dcm, dcm_work, k);
    solve::set_law(k.slope, friction, k.gap, k.normal, link);
    links.law[at].close({area * law.cohesive.repulsion, k.gap});
    links.law[at++].contact = contact_number;
  }
}

std::vector<InterfaceForce> compute_interface_forces(const InterfaceInput& in,
                                                     const dcm::ContactWorkspace& dcm_work,
                                                     const contact::ContactList& contacts) {
  std::vector<InterfaceForce> forces;
  int body = -1, sphere = -1;
  for (const Contact& k : contacts.interface()) {
    if (k.a != body || k.b != sphere) {
      body = k.a;
      sphere = k.b;
      forces.push_back({in.dcm.state.lineage[dcm_work.lane_of_body[body]],
                        in.cbm.state.lineage[sphere], Vec3::Zero(), 0, k.gap});
    }
    InterfaceForce& f = forces.back();
    f.force += k.force * k.normal;
    f.area += k.touching;
    f.gap = std::min(f.gap, k.gap);
  }
  return forces;
}

}  // namespace acinus::coupling
