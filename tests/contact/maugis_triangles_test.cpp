#include "contact/maugis_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "contact/maugis_overlap.hpp"
#include "geometry/topology.hpp"
#include "tests/contact/maugis_spheres.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

using reference::kEps;
using test::Body, test::Scatter, test::measure, test::meet;

using Corners = std::array<Vec3, 3>;

/// Equilateral, side l, centroid at (0, 0, z), facing up or down; turned about z by `turn`.
Corners equilateral(double side, double z, bool up, double turn) {
  Corners out;
  for (int k = 0; k < 3; ++k) {
    const double angle = turn + (up ? 1 : -1) * k * 2 * kPi / 3;
    out[k] = {side / std::sqrt(3.0) * std::cos(angle), side / std::sqrt(3.0) * std::sin(angle), z};
  }
  return out;
}

/// Height of the middle of a triangle of this side below the top of its sphere.
double sagitta(double radius, double side) {
  return radius - std::sqrt(radius * radius - side * side / 3);
}

// One small triangle in the middle of a Hertz contact sees its stress at r = 0.
TEST(MaugisTriangles, HandValueAtTheMiddleOfAHertzContact) {
  const double R = 10, side = 0.1, overlap = 0.2, E = 3;
  const double z = 0.5 * overlap - sagitta(R, side);
  const auto a = make_curved_triangle(equilateral(side, z, true, 0), 1 / R);
  const auto b = make_curved_triangle(equilateral(side, -z, false, 0), 1 / R);
  const TriangleForces f = compute_triangle_forces({E, 0, 0}, a, b);
  // a = sqrt(R^ delta) = 1, p(0) = 2 E a/(pi R^); the mean of r^2 over the triangle is side^2/12.
  // The next term is the mean of r^4/8, at most side^4/288 = 3.5e-7, as r^2 is at most side^2/3.
  const double area = std::sqrt(3.0) / 4 * side * side;
  const double expected = area * 2 * E / (kPi * 5) * (1 - side * side / 24);
  EXPECT_NEAR(f.normal_force, expected, 3.5e-7 * expected);
  EXPECT_NEAR(f.contact_area, area, 1e-13 * area);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(f.on_a[k].z(), -expected / 3, 3.5e-7 * expected);
    EXPECT_NEAR(f.on_b[k].z(), expected / 3, 3.5e-7 * expected);
  }
}

// The same triangle: F rises with the root of the overlap, here by 5 nm at once.
TEST(MaugisTriangles, HandValueOfTheSlope) {
  const double R = 10, side = 0.1, overlap = 0.2, E = 3, more = 0.005;
  const double z = 0.5 * overlap - sagitta(R, side);
  const auto a = make_curved_triangle(equilateral(side, z, true, 0), 1 / R);
  const auto b = make_curved_triangle(equilateral(side, -z, false, 0), 1 / R);
  const TriangleContact k = compute_triangle_contact({E, 0, 0}, a, b);
  const double area = std::sqrt(3.0) / 4 * side * side;
  const auto force = [&](double delta) {
    const double radius = std::sqrt(5 * delta);
    return area * 2 * E / (kPi * 5) * (radius - side * side / 24 / radius);
  };
  EXPECT_NEAR(k.push.force, force(overlap), 3.5e-7 * force(overlap));
  // The term left out, as above, grows as slowly as the force itself.
  const double expected = (force(overlap + more) - force(overlap)) / more;
  EXPECT_NEAR(k.push.slope, expected, 1e-6 * expected);
  EXPECT_EQ(k.pull.area, 0.0);
  // The contact point lies 10 um from the centres, along a normal good to 1e-12, in sides of 0.1.
  for (const double w : k.push.place_a) EXPECT_NEAR(w, 1.0 / 3, 1e-10);
  EXPECT_NEAR((k.normal - Vec3::UnitZ()).norm(), 0, 1e-12);
}

// The ring pulls with sigma0 wherever a < r < c: here everywhere, with stiff spheres apart.
TEST(MaugisTriangles, HandValueOfTheRing) {
  const double R = 10, side = 0.1, gap = 0.01, sigma0 = 0.5;
  const double z = -0.5 * gap - sagitta(R, side);
  const auto a = make_curved_triangle(equilateral(side, z, true, 0), 1 / R);
  const auto b = make_curved_triangle(equilateral(side, -z, false, 0), 1 / R);
  const TriangleForces f = compute_triangle_forces({3e4, 0.01, sigma0}, a, b);
  const double expected = -sigma0 * std::sqrt(3.0) / 4 * side * side;
  EXPECT_NEAR(f.normal_force, expected, 1e-13 * -expected);
}

// An equilateral triangle and the same turned by 60 degrees share a hexagon of two thirds.
TEST(MaugisTriangles, SharedAreaOfAHexagonAndOfAShiftedTriangle) {
  const double R = 10, side = 0.3, z = 0.1 - sagitta(R, side);
  const double area = std::sqrt(3.0) / 4 * side * side;
  const auto a = make_curved_triangle(equilateral(side, z, true, 0), 1 / R);
  const auto b = make_curved_triangle(equilateral(side, -z, false, kPi / 3), 1 / R);
  EXPECT_NEAR(compute_triangle_forces({3, 0, 0}, a, b).contact_area, 2.0 / 3.0 * area,
              1e-13 * area);
  // Half as large, inside: all of the smaller one.
  const double small_z = 0.1 - sagitta(R, side / 2);
  const auto c = make_curved_triangle(equilateral(side / 2, -small_z, false, 0), 1 / R);
  EXPECT_NEAR(compute_triangle_forces({3, 0, 0}, a, c).contact_area, area / 4, 1e-13 * area);
}

TEST(MaugisTriangles, UnequalSpheresPlaneAndHollow) {
  const Corners low = equilateral(0.1, 0, true, 0), high = equilateral(0.1, 0, false, 0);
  const auto contact_plane = [&](double k_a, double k_b) {
    return compute_contact_plane(cap_of(make_curved_triangle(low, k_a)),
                                 cap_of(make_curved_triangle(high, k_b)), 1e3);
  };
  // Both triangles lie in one plane: the spheres overlap by both sagittas.
  const ContactPlane unequal = contact_plane(0.1, 0.05);
  EXPECT_NEAR(unequal.radius, 1 / 0.15, 1e-13);
  EXPECT_NEAR(unequal.overlap, sagitta(10, 0.1) + sagitta(20, 0.1), 1e-13);
  EXPECT_NEAR(unequal.point.norm(), 0.0, 1e-13);  // the radical plane is that of the common circle
  EXPECT_NEAR((unequal.normal - Vec3::UnitZ()).norm(), 0.0, 1e-12);
  // A flat triangle shares the curvature by halves: two spheres of 20.
  const ContactPlane flat = contact_plane(0.1, 0);
  EXPECT_NEAR(flat.radius, 10, 1e-13);
  EXPECT_NEAR(flat.overlap, 2 * sagitta(20, 0.1), 1e-13);
  // A plane is met as it is.
  const ContactPlane plane =
      compute_contact_plane(cap_of(make_curved_triangle(low, 0.1)),
                            {Vec3::Zero(), -Vec3::UnitZ(), 0, 0, CapOf::kObject}, 1e3);
  EXPECT_NEAR(plane.radius, 10, 1e-13);
  EXPECT_NEAR(plane.overlap, sagitta(10, 0.1), 1e-13);
  // A ball of 10 in a hollow of 20: 1/R^ = 0.05, as two equal spheres of 40.
  const ContactPlane hollow = contact_plane(0.1, -0.05);
  EXPECT_NEAR(hollow.radius, 20, 1e-12);
  EXPECT_NEAR(hollow.overlap, 2 * sagitta(40, 0.1), 1e-12);
  // Flat on both sides, and a hollow tighter than the ball: the largest radius.
  EXPECT_EQ(contact_plane(0, 0).radius, 1e3);
  EXPECT_EQ(contact_plane(0.05, -0.1).radius, 1e3);
}

// No force jumps where a curvature changes its sign or a triangle turns its edge to the other.
TEST(MaugisTriangles, ForcesAreContinuous) {
  const MaugisLaw law = {10, 0.01, 0.5};
  const auto force = [&](double curvature, double tilt) {
    Corners low = equilateral(3, -0.05, true, 0);
    for (Vec3& x : low) x = Eigen::AngleAxisd(tilt, Vec3::UnitX()) * x;
    return compute_triangle_forces(law, make_curved_triangle(low, curvature),
                                   make_curved_triangle(equilateral(3, 0, false, 0.4), 0.08))
        .on_b[0];
  };
  constexpr int kSteps = 2000;
  double most = 0;
  for (int k = 0; k < kSteps; ++k) {
    const auto curvature = [](int n) { return -0.06 + 0.12 * n / kSteps; };
    const auto tilt = [](int n) { return 1.5 * n / kSteps; };
    EXPECT_LT((force(curvature(k + 1), 0.1) - force(curvature(k), 0.1)).norm(), 0.01) << k;
    EXPECT_LT((force(0.05, tilt(k + 1)) - force(0.05, tilt(k))).norm(), 0.05) << k;
    most = std::max(most, force(0.05, tilt(k)).norm());
  }
  EXPECT_GT(most, 0.5);  // tens of such steps at least
}

TEST(MaugisTriangles, NothingWithoutSharedAreaOrOutOfReach) {
  const MaugisLaw law = {10, 0.01, 0.5};
  const double R = 10, side = 0.3, top = sagitta(R, side);
  const auto pair = [&](double gap, double shift, bool up) {
    Corners b = equilateral(side, gap / 2 + top, up, 0);
    for (Vec3& x : b) x.x() += shift;
    return compute_triangle_forces(
        law, make_curved_triangle(equilateral(side, -gap / 2 - top, true, 0), 1 / R),
        make_curved_triangle(b, 1 / R));
  };
  EXPECT_NE(pair(0.0, 0, false).normal_force, 0.0);
  for (const TriangleForces& f :
       {pair(0.06, 0, false), pair(0.0, 1.0, false), pair(0.0, 0, true)}) {
    EXPECT_EQ(f.normal_force, 0.0);
    EXPECT_EQ(f.contact_area, 0.0);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(f.on_a[k].norm() + f.on_b[k].norm(), 0.0);
  }
}

/// Two bodies with bumps of both signs, overlapping.
struct RoughPair {
  const geometry::Topology& topology = geometry::shared_icosphere(162);
  std::vector<Vec3> a, b;
  explicit RoughPair(std::uint64_t test) {
    auto random = reference::stream(test);
    for (const Vec3& x : topology.rest) {
      a.push_back(10 * x + reference::random_vector(random, 0.25));
      b.push_back(10 * x + reference::random_vector(random, 0.25) + Vec3(12, 13, 8));
    }
  }
  SurfaceForces forces(const MaugisLaw& law, const Mat3& turn, const Vec3& shift) const {
    const auto place = [&](const std::vector<Vec3>& x) {
      Body out;
      for (const Vec3& y : x) out.node.push_back(turn * y + shift);
      out.curved = make_curved_triangles(out.node, topology.triangle);
      return out;
    };
    return meet(law, topology, place(a), place(b));
  }
};

TEST(MaugisTriangles, ForceAndMomentAreInBalance) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RoughPair pair(seed);
    const SurfaceForces f = pair.forces({10, 0.01, 0.5}, Mat3::Identity(), Vec3::Zero());
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    double total = 0, total_moment = 0;
    for (int k = 0; k < pair.topology.n_node; ++k) {
      force += f.on_a[k] + f.on_b[k];
      moment += pair.a[k].cross(f.on_a[k]) + pair.b[k].cross(f.on_b[k]);
      total += f.on_a[k].norm() + f.on_b[k].norm();
      total_moment += pair.a[k].cross(f.on_a[k]).norm() + pair.b[k].cross(f.on_b[k]).norm();
    }
    ASSERT_GT(total, 0.1);
    std::printf("rough pair: force %.1e, moment %.1e of their magnitudes\n", force.norm() / total,
                moment.norm() / total_moment);
    EXPECT_LT(force.norm(), 1e-12 * total);
    EXPECT_LT(moment.norm(), 1e-12 * total_moment);
  }
}

TEST(MaugisTriangles, TurnsAndShiftsWithTheBodies) {
  const RoughPair pair(4);
  const MaugisLaw law = {10, 0.01, 0.5};
  auto random = reference::stream(5);
  const Mat3 turn = reference::random_rotation(random);
  const SurfaceForces f = pair.forces(law, Mat3::Identity(), Vec3::Zero());
  const SurfaceForces g = pair.forces(law, turn, Vec3(3, -20, 7));
  double total = 0, worst = 0;
  for (int k = 0; k < pair.topology.n_node; ++k) {
    total += f.on_a[k].norm();
    worst = std::max(
        {worst, (turn * f.on_a[k] - g.on_a[k]).norm(), (turn * f.on_b[k] - g.on_b[k]).norm()});
  }
  // An overlap from radii up to max_radius has an error of 1e3 um x eps, and the stress a slope of
  // sigma0/h0 by it; with a hundred pairs that is 1e-11 nN of some nN.
  EXPECT_LT(worst, 1e-10 * total);
  EXPECT_NEAR(g.contact_area, f.contact_area, 1e-9 * f.contact_area);
}

// What pushes and what pulls make up the whole, each at a place within the triangle.
TEST(MaugisTriangles, PartsMakeUpTheForces) {
  const RoughPair pair(7);
  const auto a = make_curved_triangles(pair.a, pair.topology.triangle);
  const auto b = make_curved_triangles(pair.b, pair.topology.triangle);
  int both = 0;
  for (const CurvedTriangle& s : a)
    for (const CurvedTriangle& t : b) {
      if ((s.circumcenter - t.circumcenter).norm() > 4) continue;
      const TriangleForces f = compute_triangle_forces({10, 0.01, 0.5}, s, t);
      const TriangleContact k = compute_triangle_contact({10, 0.01, 0.5}, s, t);
      const double size = k.push.force - k.pull.force;  // a hundred points, kEps each
      EXPECT_GE(k.push.force, 0);
      EXPECT_LE(k.pull.force, 0);
      EXPECT_NEAR(k.push.force + k.pull.force, f.normal_force, 1e-13 * size);
      EXPECT_NEAR(k.push.area + k.pull.area, f.contact_area, 1e-13 * f.contact_area);
      for (int i = 0; i < 3; ++i) {
        const double load = k.push.force * k.push.place_a[i] + k.pull.force * k.pull.place_a[i];
        EXPECT_LE((f.on_a[i] + load * k.normal).norm(), 1e-13 * size);
        for (const TrianglePart* part : {&k.push, &k.pull}) {
          EXPECT_GE(part->place_a[i], -1e-13);
          EXPECT_GE(part->slope, 0);
        }
      }
      both += k.push.area > 0 && k.pull.area > 0 ? 1 : 0;
    }
  EXPECT_GT(both, 10);
}

TEST(MaugisTriangles, ChangingSidesChangesSigns) {
  const RoughPair pair(6);
  const auto a = make_curved_triangles(pair.a, pair.topology.triangle);
  const auto b = make_curved_triangles(pair.b, pair.topology.triangle);
  int met = 0;
  for (const CurvedTriangle& s : a)
    for (const CurvedTriangle& t : b) {
      if ((s.circumcenter - t.circumcenter).norm() > 4) continue;
      const TriangleForces f = compute_triangle_forces({10, 0.01, 0.5}, s, t);
      const TriangleForces g = compute_triangle_forces({10, 0.01, 0.5}, t, s);
      // The polygon is cut in another order and its stress integrated from the same points.
      EXPECT_NEAR(f.normal_force, g.normal_force, 1e-9 * (1e-3 + std::abs(f.normal_force)));
      for (int k = 0; k < 3; ++k) EXPECT_LT((f.on_a[k] - g.on_b[k]).norm(), 1e-9);
      met += f.contact_area > 0 ? 1 : 0;
    }
  EXPECT_GT(met, 10);
}

// Polygons tile the contact without gaps if all triangles share one sphere, and the stress is
// integrated exactly: meshes of any orientation and size push as the spheres do.
TEST(MaugisTriangles, IcospheresFollowTheCurveOfSpheres) {
  const MaugisPair pair = {{5, 10, 0.01}, 0.5};
  const double end = maugis_at_radius(pair, maugis_turning_radius(pair)).overlap;
  for (const double overlap : {0.5, 0.05, end + 1e-3})
    for (const int nodes : {162, 642}) {
      const Scatter r = measure({nodes, 10, true, 12}, overlap);
      std::printf("%d nodes, overlap %.4f um: 1 %+.1e +- %.1e of the curve\n", nodes, overlap,
                  r.mean - 1, r.deviation);
      EXPECT_NEAR(r.mean, 1.0, 1e-8);
      EXPECT_LT(r.deviation, 1e-7);
    }
}

// Estimated curvatures differ by 1.4e-4 (curved_triangle_test.cpp), overlaps by up to 2.8 nm,
// forces of Hertz by 1.5 x 2.8/500 = 0.9 %.
TEST(MaugisTriangles, EstimatedCurvatureServesUnderPressure) {
  const Scatter r = measure({162, 10, false, 24}, 0.5);
  std::printf("162 nodes, estimated curvature: %.4f +- %.4f of the curve\n", r.mean, r.deviation);
  EXPECT_NEAR(r.mean, 1.0, 0.009);
}

// A ball that rests on a plane, a larger ball, and in a hollow: the sum over its triangles is the
// force of the curve with R^ of the two.
TEST(MaugisTriangles, ObjectsFollowTheCurveOfSpheres) {
  const MaugisLaw law = {10, 0.01, 0.5};
  const geometry::Topology& t = geometry::shared_icosphere(162);
  auto random = reference::stream(12);
  for (const double curvature : {0.0, 1 / 25.0})
    for (const double overlap : {0.5, 0.02, -0.01}) {
      const double radius = 1 / (0.1 + curvature);
      const MaugisPair pair = {{radius, law.modulus, law.adhesion}, law.cohesive_stress};
      const double exact = maugis_at_overlap(pair, overlap).force;
      const Body ball = test::make_sphere(t, 10, Vec3(0, 0, 10 - overlap),
                                          reference::random_rotation(random), true);
      double force = 0, across = 0;
      for (const CurvedTriangle& s : ball.curved) {
        // The place of the object nearest to the triangle: of the ball, towards its middle.
        const Vec3 center(0, 0, curvature > 0 ? -1 / curvature : 0);
        const Vec3 normal =
            curvature > 0 ? Vec3((s.circumcenter - center).normalized()) : Vec3(Vec3::UnitZ());
        const Vec3 place = curvature > 0 ? Vec3(center + normal / curvature)
                                         : Vec3(s.circumcenter.x(), s.circumcenter.y(), 0);
        const TriangleContact k = compute_object_contact(law, s, {place, normal, 0, curvature});
        for (const TrianglePart* part : {&k.push, &k.pull}) {
          force -= part->force * k.normal.z();
          across += std::abs(part->force) * k.normal.cross(Vec3::UnitZ()).norm();
        }
      }
      EXPECT_NEAR(force, exact, 1e-8 * std::abs(exact) + 1e-10) << curvature << " " << overlap;
      EXPECT_LT(across, 1e-8);
    }
}

// A ball in a hollow of 30 um, R^ = 15: to the order of Hertz, with the spheres shared by halves.
TEST(MaugisTriangles, ABallInAHollowFollowsHertz) {
  const MaugisLaw law = {10, 0, 0};
  const Body ball =
      test::make_sphere(geometry::shared_icosphere(642), 10, Vec3::Zero(), Mat3::Identity(), true);
  const double overlap = 0.1;
  const Vec3 center(0, 0, 20 + overlap);  // of the hollow, which the ball meets at z = -10
  double force = 0;
  for (const CurvedTriangle& s : ball.curved) {
    const Vec3 away = (s.circumcenter - center).normalized();
    const TriangleContact k =
        compute_object_contact(law, s, {center + 30 * away, -away, 0, -1 / 30.0});
    force -= (k.push.force + k.pull.force) * k.normal.z();
  }
  const double exact = maugis_at_overlap({{15, law.modulus, 0}, 0}, overlap).force;
  EXPECT_NEAR(force, exact, 0.03 * exact);
}

}  // namespace
}  // namespace acinus::contact
