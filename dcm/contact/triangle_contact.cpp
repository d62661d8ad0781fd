#include "dcm/contact/triangle_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/candidates.hpp"
#include "contact/maugis_overlap.hpp"
#include "contact/maugis_triangles.hpp"
#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/contact_sides.hpp"
#include "geometry/box_pairs.hpp"

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

contact::MaugisLaw law_between(const ContactInput& in, const ContactWorkspace& work, int a, int b) {
  const auto adhesion_of = [&](int body) {
    return in.params[in.state.group[work.lane_of_body[body] / kLanes].type].adhesion;
  };
  const ContactParams& c = in.options;
  const double adhesion = c.adhesion_factor * std::sqrt(adhesion_of(a) * adhesion_of(b));
  return {c.modulus, adhesion, adhesion / c.cohesive_range, c.max_radius};
}

/// Largest gap at which two spheres exert forces on each other, um: it grows with the radius.
double largest_gap(const contact::MaugisLaw& law) {
  if (law.adhesion == 0) return 0;
  return -contact::least_overlap(
      {{law.max_radius, law.modulus, law.adhesion}, law.cohesive_stress});
}

bool are_constrained(const ContactWorkspace& work, int a, int b) {
  return !work.body_constrained.empty() && work.body_constrained[a] != 0 &&
         work.body_constrained[b] != 0;
}

/// Triangles of a body near a box.
std::vector<int> triangles_near(const SurfaceBody& body, const Box& box, double reach) {
  std::vector<int> near;
  const Box around = box.grown(reach + *std::ranges::max_element(body.reach));
  for (std::size_t t = 0; t < body.center.size(); ++t)
    if (around.contains(body.center[t])) near.push_back(static_cast<int>(t));
  return near;
}

/// Search for all contacts of two bodies.
struct BodyPair {
  const ContactWorkspace& work;
  contact::MaugisLaw law;
  int a, b;
  double reach;  ///< um, largest distance of places of two triangles in contact

  void find(std::vector<Contact>& out) const {
    const SurfaceBody &body_a = work.body[a], &body_b = work.body[b];
    const std::vector<int> near_a = triangles_near(body_a, body_b.box, reach),
                           near_b = triangles_near(body_b, body_a.box, reach);
    for (const int s : near_a)
      for (const int t : near_b) {
        const CurvedTriangle &at_a = work.triangles.curved[a][s],
                             &at_b = work.triangles.curved[b][t];
        const double near = at_a.circumradius + at_b.circumradius + reach;
        if ((at_a.circumcenter - at_b.circumcenter).squaredNorm() > near * near) continue;
        const contact::TriangleContact k = contact::compute_triangle_contact(law, at_a, at_b);
        for (const contact::TrianglePart* part : {&k.push, &k.pull})
          if (part->area > 0) out.push_back(record(s, t, k.normal, *part));
      }
  }

  Contact record(int s, int t, const Vec3& normal_a_to_b, const contact::TrianglePart& part) const {
    Contact k;
    k.a = a;
    k.point = s;
    k.b = b;
    k.triangle = t;
    k.partner = contact::Partner::kSurface;
    k.normal = -normal_a_to_b;
    k.place_a = rounded(part.place_a);
    const Corners at_b = corners_of(work.body[b], t);
    const Vec3 x = place_at(corners_of(work.body[a], s), Contact::weights_at(k.place_a));
    const std::array<double, 3> w = contact::weights_along(k.normal, at_b, x);
    k.place = rounded(w);
    k.gap = k.normal.dot(x - place_at(at_b, w));
    k.touching = part.area;
    k.force = part.force;
    k.slope = part.slope;
    return k;
  }
};

/// Search for contacts of each cell with itself, by points.
void find_folds(const contact::SearchOptions& options, ContactWorkspace& work) {
  const std::vector<contact::Candidates>& pair = work.lists.pair;
  for_each_index(pair.size(), true, [&](std::size_t k) {
    if (pair[k].body_a != pair[k].body_b || pair[k].point.empty()) return;
    contact::find_contacts(pair[k], work.body, work.fixed, options, relative_motion(work.lists, k),
                           work.triangles.found[pair[k].body_a]);
  });
}

}  // namespace

void find_triangle_contacts(const ContactInput& in, ContactWorkspace& work,
                            std::vector<Contact>& out) {
  TriangleContactWorkspace& scratch = work.triangles;
  const std::size_t n = work.body.size();
  scratch.curved.resize(n);
  scratch.found.resize(n);
  std::vector<Box> boxes;
  for (const SurfaceBody& b : work.body) boxes.push_back(b.box);
  double gap = 0;
  for (int k = 0; k < static_cast<int>(n); ++k)
    gap = std::max(gap, largest_gap(law_between(in, work, k, k)));
  const double reach = gap + in.options.max_depth;
  auto pairs = contact::find_pairs(boxes, reach);
  if (!work.ghost.empty()) {
    std::erase_if(pairs, [&](const std::pair<int, int>& p) {
      return work.is_ghost_body(p.first) && work.is_ghost_body(p.second);
    });
    std::vector<int> near;
    for (const auto& [a, b] : pairs) near.insert(near.end(), {a, b});
    complete_bodies(in.state, near, work);
  }

  for_each_index(n, true, [&](std::size_t k) {
    scratch.found[k].clear();
    if (work.is_complete[k] == 0) return;
    scratch.curved[k] = contact::make_curved_triangles(work.body[k].node, *work.body[k].triangle);
  });
  find_folds(work.lists.options, work);

  for_each_index(n, true, [&](std::size_t k) {
    const int a = static_cast<int>(k);
    for (const auto& [first, b] :
         std::ranges::equal_range(pairs, a, {}, &std::pair<int, int>::first))
      if (!are_constrained(work, a, b))
        BodyPair{work, law_between(in, work, a, b), a, b, reach}.find(scratch.found[k]);
  });
  out.clear();
  for (const auto& found : scratch.found) out.insert(out.end(), found.begin(), found.end());
}

void add_triangle_shares(const contact::ContactList& contacts, ContactWorkspace& work) {
  const auto add = [&](int body, int triangle, double area) {
    const Corners x = corners_of(work.body[body], triangle);
    const double share = area / (0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm());
    for (int q = 0; q < 3; ++q) work.share[body][3 * triangle + q] += share;
  };
  for (const Contact& k : contacts.surface()) {
    if (k.is_fold()) continue;
    add(k.a, k.point, k.touching);
    add(k.b, k.triangle, k.touching);
  }
}

void complete_triangle_contact(const ContactInput& in, const ContactWorkspace& work, Contact& k,
                               solve::Link& link, solve::LinkLoad& load) {
  const double friction = in.options.friction_factor * in.options.cell_friction * k.touching;
  k.friction = static_cast<float>(friction);
  link.a = side_a(in, work, k);
  link.b = side_b(in, work, k);
  solve::set_law(k.slope, friction, k.gap, k.normal, link);
  load = {k.normal, k.force, 0, 0};
}

void add_place_remainders(const ContactInput& in, const ContactWorkspace& work,
                          const contact::ContactList& contacts, std::vector<double>& force) {
  for (const Contact& k : contacts.surface()) {
    if (k.is_fold()) continue;
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
