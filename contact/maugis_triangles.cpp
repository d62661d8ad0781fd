#include "contact/maugis_triangles.hpp"

#include <algorithm>
#include <optional>

#include "contact/maugis_overlap.hpp"

namespace acinus::contact {

namespace {

using Vec2 = Eigen::Vector2d;
using Triangle2 = std::array<Vec2, 3>;

/// Least cosine between the normals of a triangle and of the contact plane. Below it the triangle
/// is seen edge-on, and its projection is unrelated to the surface.
constexpr double kFacing = 0.2;

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

/// Quadrature rule of six points, exact to degree 4 [Dunavant1985]: barycentric weights (1 - 2 g,
/// g, g).
struct RulePoint {
  double g, weight;
};
constexpr std::array<RulePoint, 2> kRule = {
    {{0.445948490915965, 0.223381589678011}, {0.091576213509771, 0.109951743655322}}};

/// Calls visit(x, area) at the quadrature points of a polygon, cut into triangles about its middle.
template <class Visit>
void for_each_quadrature_point(const SharedArea& polygon, Visit visit) {
  if (polygon.n < 3) return;
  Vec2 middle = Vec2::Zero();
  for (int k = 0; k < polygon.n; ++k) middle += polygon.corner[k] / polygon.n;
  for (int k = 0; k < polygon.n; ++k) {
    const Triangle2 t = {middle, polygon.corner[k], polygon.corner[(k + 1) % polygon.n]};
    const double area = 0.5 * cross(t[1] - t[0], t[2] - t[0]);
    const Vec2 sum = t[0] + t[1] + t[2];
    for (const auto& [g, weight] : kRule)
      for (const Vec2& x : t) visit(Vec2(g * sum + (1.0 - 3.0 * g) * x), weight * area);
  }
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

MaugisPair make_pair(const MaugisLaw& law, double radius) {
  return {{radius, law.modulus, law.adhesion}, law.cohesive_stress};
}

/// Normal stress at radius r, Eq. (14) plus Eq. (17), kPa.
double stress_at(const MaugisPair& pair, const MaugisPoint& state, double r) {
  return hertz_pressure(pair.pair, state.contact_radius, r) +
         (pair.pair.adhesion > 0.0
              ? maugis_adhesive_pressure(pair.cohesive_stress, state.contact_radius,
                                         state.cohesive_radius, r)
              : 0.0);
}

/// Area on the contact plane through which two triangles act on each other.
struct PressedArea {
  ContactPlane plane;
  Triangle2 flat_a, flat_b;
  SharedArea shared;
  MaugisCurve curve;
  MaugisPoint state;
};

/// Area of two triangles in contact; empty where compute_triangle_forces is zero.
std::optional<PressedArea> compute_pressed_area(const MaugisLaw& law, const CurvedTriangle& a,
                                                const CurvedTriangle& b) {
  const ContactPlane plane = compute_contact_plane(a, b, law.max_radius);
  if (!(a.normal.dot(plane.normal) > kFacing && b.normal.dot(plane.normal) < -kFacing)) return {};
  const PlaneFrame frame = make_frame(plane, a);
  const Triangle2 flat_a = frame.project(a), flat_b = frame.project(b);
  // Seen from a, the corners of b run clockwise.
  const SharedArea shared = intersect(flat_a, {flat_b[0], flat_b[2], flat_b[1]});
  if (shared.n < 3) return {};
  const MaugisCurve curve = make_maugis_curve(make_pair(law, plane.radius));
  const MaugisPoint state = maugis_at_overlap(curve, plane.overlap);
  if (state.cohesive_radius == 0.0) return {};
  return PressedArea{plane, flat_a, flat_b, shared, curve, state};
}

/// Calls visit(x, area, stress) at the quadrature points within the radius c, with stress in kPa.
template <class Visit>
void for_each_stress(const PressedArea& pressed, Visit visit) {
  for_each_quadrature_point(pressed.shared, [&](const Vec2& x, double area) {
    const double r = x.norm();
    if (r <= pressed.state.cohesive_radius)
      visit(x, area, stress_at(pressed.curve.pair, pressed.state, r));
  });
}

}  // namespace

ContactPlane compute_contact_plane(const CurvedTriangle& a, const CurvedTriangle& b,
                                   double max_radius) {
  double k_a = a.curvature, k_b = b.curvature;
  const double sum = std::max(k_a + k_b, 1.0 / max_radius);
  if (k_a < 0.0 || k_b < 0.0 || k_a + k_b < sum) k_a = k_b = 0.5 * sum;
  const auto fit = [](const CurvedTriangle& t, double k) {
    return fit_sphere(t, std::min(std::max(k, kPlaneCurvature), 1.0 / t.circumradius));
  };
  const FittedSphere at_a = fit(a, k_a), at_b = fit(b, k_b);
  const Vec3 line = at_b.center - at_a.center;
  const double d = line.norm();
  const Vec3 normal = d > 0.0 ? Vec3(line / d) : Vec3::Zero();
  const double overlap = at_a.radius + at_b.radius - d;
  // From the surface of a inwards to the radical plane; no difference of large squares.
  const double depth = overlap * (d - at_a.radius + at_b.radius) / (2.0 * d);
  return {at_a.center + (at_a.radius - depth) * normal, normal, overlap, 1.0 / sum};
}

TriangleForces compute_triangle_forces(const MaugisLaw& law, const CurvedTriangle& a,
                                       const CurvedTriangle& b) {
  TriangleForces out;
  const std::optional<PressedArea> pressed = compute_pressed_area(law, a, b);
  if (!pressed) return out;
  std::array<double, 3> load_a{}, load_b{};
  for_each_stress(*pressed, [&](const Vec2& x, double area, double stress) {
    const double force = area * stress;
    const auto w_a = barycentric(pressed->flat_a, x), w_b = barycentric(pressed->flat_b, x);
    for (int k = 0; k < 3; ++k) {
      load_a[k] -= force * w_a[k];
      load_b[k] += force * w_b[k];
    }
    out.normal_force += force;
    out.contact_area += area;
  });
  for (int k = 0; k < 3; ++k) {
    out.on_a[k] = load_a[k] * pressed->plane.normal;
    out.on_b[k] = load_b[k] * pressed->plane.normal;
  }
  return out;
}

TriangleContact compute_triangle_contact(const MaugisLaw& law, const CurvedTriangle& a,
                                         const CurvedTriangle& b) {
  TriangleContact out;
  const std::optional<PressedArea> pressed = compute_pressed_area(law, a, b);
  if (!pressed) return out;
  out.normal = pressed->plane.normal;
  const MaugisPoint deeper = maugis_at_overlap(pressed->curve, pressed->plane.overlap + kDeeper);
  for_each_stress(*pressed, [&](const Vec2& x, double area, double stress) {
    TrianglePart& part = stress > 0.0 ? out.push : out.pull;
    const double force = area * stress;
    part.force += force;
    part.area += area;
    part.slope += area * (stress_at(pressed->curve.pair, deeper, x.norm()) - stress) / kDeeper;
    const auto w = barycentric(pressed->flat_a, x);
    for (int k = 0; k < 3; ++k) part.place_a[k] += force * w[k];
  });
  for (TrianglePart* part : {&out.push, &out.pull}) {
    part->slope = std::max(0.0, part->slope);
    if (part->force != 0.0)
      for (double& w : part->place_a) w /= part->force;
  }
  return out;
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
