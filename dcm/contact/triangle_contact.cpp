#include "dcm/contact/triangle_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "contact/candidates.hpp"
#include "contact/maugis_overlap.hpp"
#include "contact/pair_adhesion.hpp"
#include "contact/vessel_yield.hpp"
#include "core/parallel/append_in_order.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_points.hpp"
#include "dcm/contact/contact_sides.hpp"

namespace acinus::dcm {
namespace {

using contact::Contact, contact::CurvedTriangle, contact::SurfaceBody;
using Corners = std::array<Vec3, 3>;

Corners corners_of(const SurfaceBody& body, int triangle) {
  const auto& t = (*body.triangle)[triangle];
  return {body.node[t[0]], body.node[t[1]], body.node[t[2]]};
}

Vec3 place_at(const Corners& x, const std::array<double, 3>& w) {
  return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

std::array<float, 2> rounded(const std::array<double, 3>& w) {
  return {static_cast<float>(w[0]), static_cast<float>(w[1])};
}

/// Number of places at which the force of a part acts.
constexpr int kPlaces = 3;

/// Places of equal forces that replace that of a part, weights on its triangle. Their mean is the
/// centre of the part, so the forces on the corners are the same. The distance from the centre
/// gives the matrix the stiffness of the contact against a tilt of the triangle: F R of a Hertz
/// contact of radius a is 2/3 a^2 dF/d(delta), so three places belong at 1.15 a. A facet that lies
/// wholly within its contact has its places at 1.1 sqrt(area/pi). Places may lie outside.
std::array<std::array<double, 3>, kPlaces> spread(const CurvedTriangle& triangle,
                                                  const contact::TrianglePart& part) {
  constexpr double kDistance = 1.1 / 1.7724538509055160;  // over the root of the area
  const double s = kDistance * std::sqrt(part.area) / triangle.circumradius;
  std::array<std::array<double, 3>, kPlaces> place;
  for (int q = 0; q < kPlaces; ++q)
    for (int m = 0; m < 3; ++m)
      place[q][m] = part.place_a[m] + s * ((m == q ? 1.0 : 0.0) - 1.0 / 3);
  return place;
}

/// Writes the share of one place.
void share_out(const contact::TrianglePart& part, Contact& k) {
  k.touching = part.area / kPlaces;
  k.force = part.force / kPlaces;
  k.slope = part.slope / kPlaces;
}

std::size_t type_of(const ContactInput& in, const ContactWorkspace& work, int body) {
  return in.state.group[work.lane_of_body[body] / kLanes].type;
}

PartnerSurface surface_of(const ContactParams& c, const contact::Material& m) {
  return {c.adhesion_factor * m.adhesion, m.young / (1 - m.poisson * m.poisson)};
}

/// Largest indentation of a vessel's wall, um, as with points.
double wall_yield(const ContactParams& c, const contact::Material& wall, double radius) {
  return std::min(contact::yield_limit(wall, radius), c.max_depth / 2);
}

contact::MaugisLaw law_between(const ContactInput& in, const ContactWorkspace& work, int a, int b,
                               double reach) {
  const std::size_t n = work.body.size(), k = b;
  if (k >= n)  // the mesh about the vessels comes last
    return maugis_law(in.options, surface_of(in.options, k - n < in.boundary.meshes.size()
                                                             ? in.boundary.meshes[k - n].material
                                                             : in.boundary.vessels.material));
  const std::size_t type_a = type_of(in, work, a), type_b = type_of(in, work, b);
  const double adhesion =
      contact::scale_adhesion(contact::pair_adhesion(in.params[type_a], in.params[type_b], type_b),
                              in.adhesion, work.lane_of_body[a], in.adhesion, work.lane_of_body[b]);
  contact::MaugisLaw law = maugis_law(
      in.options, {in.options.adhesion_factor * adhesion, std::numeric_limits<double>::infinity()});
  law.farthest = reach - in.options.max_depth;  // triangle_reach
  return law;
}

/// Search for all contacts of two bodies.
struct BodyPair {
  const ContactInput& in;
  const ContactWorkspace& work;
  contact::MaugisLaw law;
  const contact::Candidates& pair;
  double reach;  ///< um

  bool is_fixed() const { return static_cast<std::size_t>(pair.body_b) >= work.body.size(); }
  const std::vector<CurvedTriangle>& curved_b() const {
    const std::size_t k = pair.body_b;
    return is_fixed() ? work.triangles.fixed[k - work.body.size()] : work.triangles.curved[k];
  }

  /// Law at a triangle of body b: the wall of a vessel yields in proportion to its radius.
  contact::MaugisLaw law_at(int triangle) const {
    contact::MaugisLaw at = law;
    const contact::Vessels& v = in.boundary.vessels;
    const std::size_t first = work.body.size() + in.boundary.meshes.size();
    if (v.wall == nullptr || static_cast<std::size_t>(pair.body_b) < first) return at;
    const auto& radius = v.network.radius[v.wall->segment[triangle]];
    at.most_yield = wall_yield(in.options, v.material, 0.5 * (radius[0] + radius[1]));
    return at;
  }

  void find(contact::Contacts& out) const {
    const std::vector<CurvedTriangle>&a = work.triangles.curved[pair.body_a], &b = curved_b();
    const contact::CapOf side = is_fixed() ? contact::CapOf::kObjectMesh : contact::CapOf::kCell;
    for (std::size_t n = 0; n < pair.list.n_point(); ++n) {
      const CurvedTriangle& at_a = a[pair.list.point_at(n)];
      for (std::uint32_t e = pair.list.begin_of(n); e < pair.list.end_of(n); ++e) {
        const int t = pair.list.triangle_at(e);
        const CurvedTriangle& at_b = b[t];
        const double near = at_a.circumradius + at_b.circumradius + reach;
        if ((at_a.circumcenter - at_b.circumcenter).squaredNorm() > near * near) continue;
        const contact::TriangleContact k =
            contact::compute_triangle_contact(law_at(t), at_a, at_b, side);
        for (const contact::TrianglePart* part : {&k.push, &k.pull})
          if (part->area > 0)
            for (const std::array<double, 3>& place : spread(at_a, *part))
              out.push_back(record(pair.list.point_at(n), t, k.normal, *part, place));
      }
    }
  }

  Contact record(int s, int t, const Vec3& normal_a_to_b, const contact::TrianglePart& part,
                 const std::array<double, 3>& place) const {
    Contact k;
    k.a = pair.body_a;
    k.point = s;
    k.b = is_fixed() ? pair.body_b - static_cast<int>(work.body.size()) : pair.body_b;
    k.triangle = t;
    k.partner = is_fixed() ? contact::Partner::kMesh : contact::Partner::kSurface;
    k.normal = -normal_a_to_b;
    k.place_a = rounded(place);
    const Corners& at_b = curved_b()[t].corner;
    const Vec3 x = place_at(work.triangles.curved[k.a][s].corner, Contact::weights_at(k.place_a));
    const std::array<double, 3> w = contact::weights_along(k.normal, at_b, x);
    k.place = rounded(w);
    k.gap = k.normal.dot(x - place_at(at_b, w));
    share_out(part, k);
    return k;
  }
};

/// Triangles of a body and the search for their contacts with objects.
struct ObjectSearch {
  const std::vector<CurvedTriangle>& triangle;
  int body;
  double reach;  ///< um
  contact::Contacts& out;

  void find(int t, const contact::Gap& at, double curvature, const contact::MaugisLaw& law,
            const Contact& like) const {
    const CurvedTriangle& s = triangle[t];
    if (at.gap > s.circumradius + reach) return;
    Contact k = like;
    k.a = body;
    k.point = t;
    add_object_contacts(law, s, {s.circumcenter - at.gap * at.normal, at.normal, 0, curvature}, k,
                        nullptr, out);
  }
};

/// Search for the contacts with the nearest segment of the network of vessels.
void find_at_vessels(const ContactInput& in, const SegmentCandidates& list,
                     const ObjectSearch& search) {
  const contact::Vessels& vessels = in.boundary.vessels;
  contact::MaugisLaw law = maugis_law(in.options, surface_of(in.options, vessels.material));
  for (std::size_t s = 0; s < list.site.size(); ++s) {
    const int t = list.site[s];
    contact::Gap nearest;
    int segment = -1;
    for (std::uint32_t e = list.start[s]; e < list.start[s + 1]; ++e) {
      const contact::Gap g = contact::gap_to_segment(vessels.network, list.segment[e],
                                                     search.triangle[t].circumcenter);
      if (segment >= 0 && g.gap >= nearest.gap) continue;
      nearest = g;
      segment = list.segment[e];
    }
    if (segment < 0) continue;
    law.most_yield = wall_yield(in.options, vessels.material, nearest.radius);
    // The mean curvature of a tube, as that of the triangles.
    search.find(t, nearest, 0.5 / nearest.radius, law,
                {.b = segment, .partner = contact::Partner::kVessel});
  }
}

}  // namespace

contact::MaugisLaw maugis_law(const ContactParams& c, const PartnerSurface& partner) {
  contact::MaugisLaw law;
  law.modulus = c.modulus;
  law.partner_modulus = partner.modulus;
  law.most_yield = partner.most_yield;
  law.adhesion = partner.adhesion;
  law.cohesive_stress = partner.adhesion / c.cohesive_range;
  law.max_radius = c.max_radius;
  return law;
}

double maugis_reach(const contact::MaugisLaw& law, double max_depth) {
  if (law.adhesion == 0) return max_depth;
  // The range grows with the radius.
  return max_depth -
         contact::least_overlap({{law.max_radius, law.modulus, law.adhesion}, law.cohesive_stress});
}

double triangle_reach(const ContactInput& in) {
  double adhesion =
      std::max(in.boundary.vessels.material.adhesion, contact::largest_adhesion(in.params));
  for (const auto& m : in.boundary.meshes) adhesion = std::max(adhesion, m.material.adhesion);
  contact::for_each_wall(in.boundary, [&](auto, auto, const auto& wall) {
    adhesion = std::max(adhesion, wall.material.adhesion);
  });
  const PartnerSurface most{in.options.adhesion_factor * adhesion,
                            std::numeric_limits<double>::infinity()};
  return maugis_reach(maugis_law(in.options, most), in.options.max_depth);
}

void refresh_curved_triangles(ContactWorkspace& work) {
  std::vector<std::vector<CurvedTriangle>>& curved = work.triangles.curved;
  for_each_index(curved.size(), true, [&](std::size_t k) {
    if (work.is_complete[k] != 0 && curved[k].empty())
      curved[k] = contact::make_curved_triangles(work.body[k].node, *work.body[k].triangle);
  });
}

void find_triangle_contacts(const ContactInput& in, ContactWorkspace& work, double reach,
                            contact::Contacts& out) {
  TriangleContactWorkspace& scratch = work.triangles;
  const std::size_t n = work.body.size();
  scratch.curved.resize(n);
  if (scratch.fixed.size() != work.fixed.size()) {
    scratch.fixed.clear();
    for (const SurfaceBody& b : work.fixed)
      scratch.fixed.push_back(contact::make_curved_triangles(b.node, *b.triangle));
  }
  for (std::vector<CurvedTriangle>& t : scratch.curved) t.clear();
  refresh_curved_triangles(work);

  const std::vector<contact::Candidates>& pairs = work.lists.pair;
  clear_to_refill(out);
  append_in_order(pairs.size(), true, out, [&](std::size_t k, contact::Contacts& found) {
    const contact::Candidates& pair = pairs[k];
    if (pair.list.empty()) return;
    if (pair.body_a == pair.body_b)
      contact::find_contacts(pair, work.body, work.fixed, work.lists.options,
                             relative_motion(work.lists, k), found);
    else
      BodyPair{in, work, law_between(in, work, pair.body_a, pair.body_b, reach), pair, reach}.find(
          found);
  });
}

void find_triangle_obstacles(const ContactInput& in, const ContactWorkspace& work, int body,
                             double reach, contact::Contacts& out) {
  const ObjectSearch search{work.triangles.curved[body], body, reach, out};
  const SurfaceBody& b = work.body[body];
  const Vec3 middle = 0.5 * (b.box.low + b.box.high);
  const double half = 0.5 * (b.box.high - b.box.low).norm();
  contact::for_each_wall(in.boundary, [&](contact::Partner kind, int index, const auto& wall) {
    const contact::MaugisLaw law = maugis_law(in.options, surface_of(in.options, wall.material));
    if (contact::gap_to_wall(wall, middle, in.time).gap - half >= reach) return;
    const double curvature = 1 / contact::shape_radius(wall, in.time);
    for (std::size_t t = 0; t < search.triangle.size(); ++t)
      search.find(static_cast<int>(t),
                  contact::gap_to_wall(wall, search.triangle[t].circumcenter, in.time), curvature,
                  law, {.b = index, .partner = kind});
  });
  if (!work.wall.empty())
    out.insert(out.end(), work.wall[body].begin(), work.wall[body].end());
  else if (!work.lists.segment[body].site.empty())
    find_at_vessels(in, work.lists.segment[body], search);
}

void add_object_contacts(const contact::MaugisLaw& law, const CurvedTriangle& triangle,
                         const contact::SphericalCap& object, const Contact& like,
                         const Vec3* center, contact::Contacts& out) {
  const contact::TriangleContact found = contact::compute_object_contact(law, triangle, object);
  for (const contact::TrianglePart* part : {&found.push, &found.pull}) {
    if (!(part->area > 0)) continue;
    Contact k = like;
    share_out(*part, k);
    std::array<Vec3, kPlaces> place;  // as rounded in the record, so that no moment is left
    std::array<std::array<float, 2>, kPlaces> weights;
    Vec3 middle = Vec3::Zero();
    const auto exact = spread(triangle, *part);
    for (int q = 0; q < kPlaces; ++q) {
      weights[q] = rounded(exact[q]);
      place[q] = place_at(triangle.corner, Contact::weights_at(weights[q]));
      middle += place[q] / kPlaces;
    }
    k.normal = center == nullptr ? Vec3(-found.normal) : Vec3((middle - *center).normalized());
    for (int q = 0; q < kPlaces; ++q) {
      k.place_a = weights[q];
      k.gap = k.normal.dot(place[q] - object.middle);
      out.push_back(k);
    }
  }
}

void add_triangle_shares(std::span<const Contact> contacts, ContactWorkspace& work) {
  const auto add = [&](int body, int triangle, double area) {
    if (work.is_complete[body] == 0) return;
    const Corners x = corners_of(work.body[body], triangle);
    const double share = area / (0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm());
    for (int q = 0; q < 3; ++q) work.share[body][3 * triangle + q] += share;
  };
  for (const Contact& k : contacts) {
    if (k.is_fold()) continue;
    add(k.a, k.point, k.touching);
    if (k.partner == contact::Partner::kSurface) add(k.b, k.triangle, k.touching);
  }
}

void complete_triangle_contact(const ContactInput& in, const ContactWorkspace& work,
                               double friction, Contact& k, solve::Link& link,
                               solve::LinkLaw& law) {
  k.friction = static_cast<float>(friction * k.touching);
  link.a = side_a(in, work, k);
  solve::set_law(k.slope, friction * k.touching, k.gap, k.normal, link);
  law = {};
}

void add_place_remainders(const ContactInput& in, const ContactWorkspace& work,
                          const contact::ContactList& contacts, std::span<double> force) {
  for (const Contact& k : contacts.surface()) {
    if (!is_triangle_contact(in.options, k) || k.partner != contact::Partner::kSurface) continue;
    const Vec3 x = place_at(corners_of(work.body[k.a], k.point), Contact::weights_at(k.place_a));
    const std::array<double, 3> exact =
        contact::weights_along(k.normal, corners_of(work.body[k.b], k.triangle), x);
    const std::array<double, 3> kept = k.weights();
    const std::size_t lane = work.lane_of_body[k.b];
    const auto& t = (*work.body[k.b].triangle)[k.triangle];
    for (int m = 0; m < 3; ++m)
      add_point(force.data(), node_address(in.state, lane, t[m]),
                -(exact[m] - kept[m]) * k.force * k.normal);
  }
}

}  // namespace acinus::dcm
