#include "contact/maugis_triangles.hpp"

#include <algorithm>
#include <cmath>

#include "contact/maugis_overlap.hpp"
#include "contact/maugis_stress.hpp"

namespace acinus::contact {

namespace {

using Triangle2 = std::array<Vec2, 3>;

/// Cosines between the normals of a triangle and of the contact plane between which its contact
/// fades in. Below, the triangle is seen edge-on, and its projection is unrelated to the surface.
constexpr double kEdgeOn = 0.1, kFacing = 0.4;

/// Curvature up to which caps share the sum of curvatures, fading from halves, 1/um: that of the
/// larger radii of cells. Flat surfaces in a tissue vary by as much about 0.
constexpr double kShared = 0.02;

/// Increment of overlap for the difference quotient of the stress, um. Not smaller: at the rim of
/// the contact the stress rises with an infinite slope.
constexpr double kDeeper = 0.005;

/// Curvature below which a sphere counts as a plane, 1/um; its centre still keeps nine digits of
/// the overlap.
constexpr double kPlaneCurvature = 1e-6;

double cross(const Vec2& u, const Vec2& v) { return u.x() * v.y() - u.y() * v.x(); }

/// Convex polygon shared by two triangles: at most six corners.
struct SharedArea {
  std::array<Vec2, 8> corner;
  int n = 0;
  void add(const Vec2& x) { corner[n++] = x; }
};

/// Part of a polygon to the left of the line from p to q [Sutherland1974].
SharedArea cut(const SharedArea& in, const Vec2& p, const Vec2& q) {
  SharedArea out;
  for (int k = 0; k < in.n; ++k) {
    const Vec2 &x = in.corner[k], &y = in.corner[(k + 1) % in.n];
    const double at_x = cross(q - p, x - p), at_y = cross(q - p, y - p);
    if (at_x >= 0.0) out.add(x);
    if ((at_x >= 0.0) != (at_y >= 0.0)) out.add(x + at_x / (at_x - at_y) * (y - x));
  }
  return out;
}

/// Intersection of two counter-clockwise triangles.
SharedArea intersect(const Triangle2& a, const Triangle2& b) {
  SharedArea shared;
  for (const Vec2& x : a) shared.add(x);
  for (int k = 0; k < 3 && shared.n > 0; ++k) shared = cut(shared, b[k], b[(k + 1) % 3]);
  return shared;
}

/// In-plane coordinates of the contact plane, with the origin at the contact point.
struct PlaneFrame {
  Vec3 origin, u, v;
  Triangle2 project(const CurvedTriangle& t) const {
    Triangle2 out;
    for (int k = 0; k < 3; ++k) out[k] = {u.dot(t.corner[k] - origin), v.dot(t.corner[k] - origin)};
    return out;
  }
};

/// In-plane coordinates with the first axis along the first side of a, so that they rotate with the
/// triangles.
PlaneFrame make_frame(const ContactPlane& plane, const CurvedTriangle& a) {
  const Vec3 side = a.corner[1] - a.corner[0];
  const Vec3 u = (side - plane.normal.dot(side) * plane.normal).normalized();
  return {plane.point, u, plane.normal.cross(u)};
}

std::array<double, 3> barycentric(const Triangle2& t, const Vec2& x) {
  const double whole = cross(t[1] - t[0], t[2] - t[0]);
  const double w1 = cross(x - t[0], t[2] - t[0]) / whole;
  const double w2 = cross(t[1] - t[0], x - t[0]) / whole;
  return {1.0 - w1 - w2, w1, w2};
}

MaugisPair make_pair(const MaugisLaw& law, double radius, double overlap) {
  return {{radius, modulus_at(law, overlap), law.adhesion}, law.cohesive_stress};
}

/// Step from 0 at low to 1 at high with continuous slope.
double fade(double x, double low, double high) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Share with which two caps interact: 1 if their normals face each other across the contact plane.
double facing_share(const SphericalCap& a, const SphericalCap& b, const ContactPlane& plane) {
  return fade(std::min(a.normal.dot(plane.normal), -b.normal.dot(plane.normal)), kEdgeOn, kFacing);
}

/// Share, 0 to 1, in which a cap counts as convex.
double convex_share(const SphericalCap& cap) {
  if (cap.side == CapOf::kObject) return cap.curvature < 0.0 ? 0.0 : 1.0;
  return fade(cap.curvature, 0.0, kShared);
}

/// Curvatures of the spheres of two caps, with their sum, 1/um.
struct SharedCurvature {
  double a, b, sum;
};
SharedCurvature share_curvature(const SphericalCap& a, const SphericalCap& b, double max_radius) {
  const bool meets_object = b.side != CapOf::kCell && b.curvature > 0.0;
  const double bulge = meets_object ? convex_share(b) : 0.0;
  const double k_a = a.curvature + bulge * std::max(0.0, -a.curvature);
  const double sum = std::max(k_a + b.curvature, 1.0 / max_radius), half = 0.5 * sum;
  const double own = std::max(std::min(convex_share(a), convex_share(b)), bulge);
  return {half + own * (k_a - half), half + own * (b.curvature - half), sum};
}

/// States at an overlap and at one larger by kDeeper, with their pairs.
struct Deepening {
  MaugisPair now, then;
  MaugisGrowth state;
};
Deepening deepen(const MaugisLaw& law, const ContactPlane& plane) {
  const double deeper = plane.overlap + kDeeper;
  const MaugisPair now = make_pair(law, plane.radius, plane.overlap),
                   then = make_pair(law, plane.radius, deeper);
  if (now.pair.modulus == then.pair.modulus)
    return {now, then, maugis_growth(now, plane.overlap, kDeeper)};
  return {now, then, {maugis_at_overlap(now, plane.overlap), maugis_at_overlap(then, deeper)}};
}

/// Stress over a polygon, with the growth of its parts for an overlap larger by kDeeper.
StressParts integrate_over(const MaugisLaw& law, const ContactPlane& plane,
                           const SharedArea& area) {
  const auto [now, then, state] = deepen(law, plane);
  if (state.now.cohesive_radius == 0.0) return {};
  const std::span<const Vec2> polygon(area.corner.data(), static_cast<std::size_t>(area.n));
  const double c2 = state.now.cohesive_radius * state.now.cohesive_radius;
  // Most near triangles have no place within c: the polygon lies on one side of a line beyond it.
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &x = polygon[k], side = polygon[(k + 1) % polygon.size()] - x;
    const double beyond = cross(x, side);  // length times distance; negative: outside this edge
    if (beyond < 0.0 && beyond * beyond >= c2 * side.squaredNorm()) return {};
  }
  return integrate_stress(make_maugis_stress(now, state.now), make_maugis_stress(then, state.then),
                          polygon);
}

TrianglePart part_of(const StressPart& stress, const Triangle2& flat) {
  TrianglePart part{stress.force, stress.area, std::max(0.0, stress.growth / kDeeper), {}};
  part.place_a = barycentric(flat, stress.moment / stress.force);
  return part;
}

/// Cap of an object's surface up to a circle as wide as the rim of a triangle, so that both keep
/// their distance there if curvature is shared between them.
SphericalCap widen(const SphericalCap& object, double rim_radius) {
  const double k = object.curvature, rim = std::min(rim_radius, 1.0 / std::abs(k));
  const double below = rim * rim * k / (1.0 + std::sqrt(std::max(0.0, 1.0 - rim * rim * k * k)));
  return {object.middle - below * object.normal, object.normal, rim, k, CapOf::kObject};
}

TriangleContact contact_of(const MaugisLaw& law, const ContactPlane& plane, const SharedArea& area,
                           const Triangle2& flat_a, double share) {
  TriangleContact out;
  StressParts stress = integrate_over(law, plane, area);
  for (StressPart* part : {&stress.push, &stress.pull}) {
    part->force *= share;
    part->area *= share;
    part->moment *= share;
    part->growth *= share;
  }
  out.normal = plane.normal;
  // Smaller parts are rounding of the integrals around areas that the polygon does not reach.
  constexpr double kLeastArea = 1e-9;
  if (stress.push.area > kLeastArea && stress.push.force > 0.0)
    out.push = part_of(stress.push, flat_a);
  if (stress.pull.area > kLeastArea && stress.pull.force < 0.0)
    out.pull = part_of(stress.pull, flat_a);
  return out;
}

}  // namespace

double modulus_at(const MaugisLaw& law, double overlap) {
  if (!std::isfinite(law.partner_modulus)) return law.modulus;
  const double series = 1.0 / (1.0 / law.modulus + 1.0 / law.partner_modulus);
  const double indentation = overlap * series / law.partner_modulus;
  return indentation > law.most_yield ? law.modulus * (1.0 - law.most_yield / overlap) : series;
}

ContactPlane compute_contact_plane(const SphericalCap& a, const SphericalCap& b,
                                   double max_radius) {
  const auto [k_a, k_b, sum] = share_curvature(a, b, max_radius);
  if (k_a < kPlaneCurvature || k_b < kPlaneCurvature) {
    const bool flat_a = k_a < kPlaneCurvature;
    const SphericalCap &plane = flat_a ? a : b, &ball = flat_a ? b : a;
    const FittedSphere sphere = fit_sphere(ball, flat_a ? k_b : k_a);
    const double height = (sphere.center - plane.middle).dot(plane.normal);
    return {sphere.center - height * plane.normal, flat_a ? plane.normal : Vec3(-plane.normal),
            sphere.radius - height, 1.0 / sum};
  }
  const FittedSphere at_a = fit_sphere(a, k_a), at_b = fit_sphere(b, k_b);
  const Vec3 line = at_b.center - at_a.center;
  const double d = line.norm();
  const Vec3 normal = d > 0.0 ? Vec3(line / d) : Vec3::Zero();
  const double overlap = at_a.radius + at_b.radius - d;
  // From the surface of a inwards to the radical plane; no difference of large squares.
  const double depth = overlap * (d - at_a.radius + at_b.radius) / (2.0 * d);
  return {at_a.center + (at_a.radius - depth) * normal, normal, overlap, 1.0 / sum};
}

TriangleContact compute_triangle_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                         const CurvedTriangle& b, CapOf b_side) {
  const SphericalCap cap_a = cap_of(a);
  SphericalCap cap_b = cap_of(b);
  cap_b.side = b_side;
  const ContactPlane plane = compute_contact_plane(cap_a, cap_b, law.max_radius);
  if (plane.overlap < -law.farthest) return {};
  const double share = facing_share(cap_a, cap_b, plane);
  if (share == 0.0) return {};
  // Most near triangles lie beside each other.
  const Vec3 apart = b.circumcenter - a.circumcenter;
  const double along = apart.dot(plane.normal), wide = a.circumradius + b.circumradius;
  if (apart.squaredNorm() - along * along >= wide * wide) return {};
  const PlaneFrame frame = make_frame(plane, a);
  const Triangle2 flat_a = frame.project(a), flat_b = frame.project(b);
  // Seen from a, the corners of b run clockwise.
  const SharedArea shared = intersect(flat_a, {flat_b[0], flat_b[2], flat_b[1]});
  if (shared.n < 3) return {};
  return contact_of(law, plane, shared, flat_a, share);
}

TriangleContact compute_object_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                       const SphericalCap& b) {
  const SphericalCap cap_a = cap_of(a), cap_b = widen(b, a.circumradius);
  const ContactPlane plane = compute_contact_plane(cap_a, cap_b, law.max_radius);
  if (plane.overlap < -law.farthest) return {};
  const double share = facing_share(cap_a, cap_b, plane);
  if (share == 0.0) return {};
  const Triangle2 flat = make_frame(plane, a).project(a);
  SharedArea area;
  for (const Vec2& x : flat) area.add(x);
  return contact_of(law, plane, area, flat, share);
}

TriangleForces compute_triangle_forces(const MaugisLaw& law, const CurvedTriangle& a,
                                       const CurvedTriangle& b) {
  TriangleForces out;
  const TriangleContact contact = compute_triangle_contact(law, a, b);
  for (const TrianglePart* part : {&contact.push, &contact.pull}) {
    if (part->area == 0.0) continue;
    Vec3 x = Vec3::Zero();
    for (int k = 0; k < 3; ++k) x += part->place_a[k] * a.corner[k];
    const std::array<double, 3> place_b = weights_along(contact.normal, b.corner, x);
    for (int k = 0; k < 3; ++k) {
      out.on_a[k] -= part->place_a[k] * part->force * contact.normal;
      out.on_b[k] += place_b[k] * part->force * contact.normal;
    }
    out.normal_force += part->force;
    out.contact_area += part->area;
  }
  return out;
}

std::array<double, 3> weights_along(const Vec3& normal, const std::array<Vec3, 3>& corner,
                                    const Vec3& x) {
  const Vec3 u = corner[1] - corner[0], v = corner[2] - corner[0], d = x - corner[0];
  const double whole = normal.dot(u.cross(v));
  const double w1 = normal.dot(d.cross(v)) / whole, w2 = normal.dot(u.cross(d)) / whole;
  return {1.0 - w1 - w2, w1, w2};
}

SurfaceForces compute_surface_forces(const MaugisLaw& law, const CurvedSurface& a,
                                     const CurvedSurface& b, double reach) {
  SurfaceForces out;
  out.on_a.assign(a.n_node, Vec3::Zero());
  out.on_b.assign(b.n_node, Vec3::Zero());
  for (std::size_t i = 0; i < a.curved.size(); ++i)
    for (std::size_t j = 0; j < b.curved.size(); ++j) {
      const CurvedTriangle &s = a.curved[i], &t = b.curved[j];
      const double near = s.circumradius + t.circumradius + reach;
      if ((s.circumcenter - t.circumcenter).squaredNorm() > near * near) continue;
      const TriangleForces f = compute_triangle_forces(law, s, t);
      for (int k = 0; k < 3; ++k) {
        out.on_a[a.triangle[i][k]] += f.on_a[k];
        out.on_b[b.triangle[j][k]] += f.on_b[k];
      }
      out.contact_area += f.contact_area;
    }
  return out;
}

}  // namespace acinus::contact
