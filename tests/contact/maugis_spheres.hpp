#pragma once
/// Two icospheres that meet by the paper's law between triangles, beside the curve of exact
/// spheres.

#include <algorithm>
#include <cmath>
#include <vector>

#include "contact/maugis_overlap.hpp"
#include "contact/maugis_triangles.hpp"
#include "geometry/topology.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::test {

using namespace contact;

struct Body {
  std::vector<Vec3> node;
  std::vector<CurvedTriangle> curved;
};

/// W = 10 uJ/m^2 and h0 = 20 nm between two spheres of 10 um: lambda = 0.0045, 0.96, 4.5 and 45.
inline constexpr double kModuli[] = {3e4, 10.0, 1.0, 0.03};
inline MaugisPair pair_of(double modulus) { return {{5.0, modulus, 0.01}, 0.5}; }

/// Icosphere whose nodes are on a sphere, turned, with the exact curvature or the estimated one.
inline Body make_sphere(const geometry::Topology& t, double radius, const Vec3& center,
                        const Mat3& turn, bool exact) {
  Body out;
  for (const Vec3& x : t.rest) out.node.push_back(center + turn * (radius * x.normalized()));
  if (!exact) {
    out.curved = make_curved_triangles(out.node, t.triangle);
    return out;
  }
  for (const auto& c : t.triangle)
    out.curved.push_back(
        make_curved_triangle({out.node[c[0]], out.node[c[1]], out.node[c[2]]}, 1 / radius));
  return out;
}

inline SurfaceForces meet(const MaugisLaw& law, const geometry::Topology& t, const Body& a,
                          const Body& b) {
  return compute_surface_forces(law, {t.n_node, t.triangle, a.curved},
                                {t.n_node, t.triangle, b.curved}, 1.0);
}

inline Vec3 sum(const std::vector<Vec3>& v) {
  Vec3 out = Vec3::Zero();
  for (const Vec3& x : v) out += x;
  return out;
}

/// Mean and spread over orientations of force / exact force.
struct Scatter {
  double mean = 0, deviation = 0;
};
inline Scatter scatter_of(const std::vector<double>& value) {
  Scatter out;
  double squares = 0;
  for (const double x : value) {
    out.mean += x / static_cast<double>(value.size());
    squares += x * x / static_cast<double>(value.size());
  }
  out.deviation = std::sqrt(std::max(0.0, squares - out.mean * out.mean));
  return out;
}

struct Setting {
  int nodes;
  double modulus;
  bool exact;
  int orientations;
};

/// Two spheres of this radius, um; W = 1e-5 J/m^2, h0 = 20 nm.
inline constexpr double kSphereRadius = 10;
inline MaugisLaw law_of(const Setting& s) { return {s.modulus, 0.01, 0.5}; }
inline MaugisPair pair_of(const Setting& s) { return {{kSphereRadius / 2, s.modulus, 0.01}, 0.5}; }

/// Push of a on b, nN, with these orientations.
inline double push(const Setting& s, double overlap, const Mat3& turn_a, const Mat3& turn_b) {
  const geometry::Topology& t = geometry::shared_icosphere(s.nodes);
  const Body a = make_sphere(t, kSphereRadius, Vec3::Zero(), turn_a, s.exact);
  const Vec3 center(0, 0, 2 * kSphereRadius - overlap);
  const Body b = make_sphere(t, kSphereRadius, center, turn_b, s.exact);
  return sum(meet(law_of(s), t, a, b).on_b).z();
}

/// Force over that of the curve.
inline Scatter measure(const Setting& s, double overlap) {
  auto random = reference::stream(s.nodes);
  const double exact = maugis_at_overlap(pair_of(s), overlap).force;
  std::vector<double> ratio;
  for (int k = 0; k < s.orientations; ++k) {
    const Mat3 turn_a = reference::random_rotation(random);
    ratio.push_back(push(s, overlap, turn_a, reference::random_rotation(random)) / exact);
  }
  return scatter_of(ratio);
}

}  // namespace acinus::test
