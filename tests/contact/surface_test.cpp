#include "contact/candidates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "geometry/closest_point.hpp"
#include "tests/reference/plain_surface.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::contact {
namespace {

constexpr double kFloatEps = static_cast<double>(std::numeric_limits<float>::epsilon());

SurfaceBody make_body(const std::vector<Vec3>& node, int n_node) {
  const geometry::Topology& t = geometry::shared_icosphere(n_node);
  SurfaceBody b;
  b.triangle = &t.triangle;
  b.topology = &t;
  b.node = node;
  refresh_body(b);
  return b;
}

std::vector<Vec3> sphere_nodes(int n_node, double radius, const Vec3& center, const Mat3& turn) {
  std::vector<Vec3> x = geometry::shared_icosphere(n_node).rest;
  for (Vec3& p : x) p = center + radius * (turn * p);
  return x;
}

std::vector<Candidates> find_candidates(const std::vector<SurfaceBody>& bodies,
                                        const std::vector<SurfaceBody>& fixed,
                                        const SearchOptions& o) {
  std::vector<Candidates> lists = list_pairs(bodies, fixed, o, 0);
  std::vector<Candidates*> all;
  for (Candidates& list : lists) all.push_back(&list);
  fill_candidates(bodies, fixed, o, all);
  return lists;
}

Contacts find_all(const std::vector<SurfaceBody>& bodies, const SearchOptions& o,
                  const std::vector<SurfaceBody>& fixed = {}) {
  Contacts out;
  for (const Candidates& c : find_candidates(bodies, fixed, o))
    find_contacts(c, bodies, fixed, o, 0, out);
  return out;
}

constexpr Quadrature kAll[] = {Quadrature::kThreePoint, Quadrature::kNodes,
                               Quadrature::kNodesAndEdges};

Vec3 facing_of(const SurfaceBody& b, Quadrature q, int point) {
  const std::size_t p = point;
  if (q == Quadrature::kThreePoint) return b.normal[p / 3];
  if (p < b.node.size()) return b.node_normal[p];
  Vec3 sum = Vec3::Zero();
  for (int t : b.topology->edge_triangle[p - b.node.size()]) sum += b.normal[t];
  return sum.normalized();
}

TEST(SurfaceBody, NormalsPointOutward) {
  auto random = reference::stream(60);
  const Vec3 center = reference::random_vector(random, 20);
  const SurfaceBody b =
      make_body(sphere_nodes(162, 10, center, reference::random_rotation(random)), 162);
  for (std::size_t i = 0; i < b.node.size(); ++i) {
    EXPECT_GT(b.node_normal[i].dot((b.node[i] - center).normalized()), 0.999);
    EXPECT_TRUE(b.box.contains(b.node[i]));
  }
  for (std::size_t t = 0; t < b.center.size(); ++t) {
    EXPECT_GT(b.normal[t].dot((b.center[t] - center).normalized()), 0.99);
    for (int c : (*b.triangle)[t])
      EXPECT_LE((b.node[c] - b.center[t]).norm(), b.reach[t] * (1 + 1e-14));
  }
}

TEST(PointStencil, PointsShareTheirTriangle) {
  const SurfaceBody b = make_body(geometry::shared_icosphere(42).rest, 42);
  for (int t = 0; t < 80; ++t) {
    Vec3 sum = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const PointStencil s = point_stencil(b, Quadrature::kThreePoint, 3 * t + k);
      EXPECT_DOUBLE_EQ(s.weight[0] + s.weight[1] + s.weight[2], 1);
      EXPECT_NEAR(*std::ranges::max_element(s.weight), 2.0 / 3, kFloatEps);  // see below
      EXPECT_EQ(std::ranges::max_element(s.weight) - s.weight.begin(), k);
      for (std::size_t m : {0, 1})  // what the solver keeps loses nothing
        EXPECT_EQ(s.weight[m], static_cast<double>(static_cast<float>(s.weight[m])));
      sum += point_position(b, s) / 3;
    }
    // two sixths and a third that are float numbers, on edges of 0.6
    EXPECT_LT((sum - b.center[t]).norm(), kFloatEps);
  }
  EXPECT_EQ(point_position(b, point_stencil(b, Quadrature::kNodes, 7)), b.node[7]);
}

TEST(PointStencil, NodesThenMidpointsOfEdges) {
  const Quadrature q = Quadrature::kNodesAndEdges;
  const SurfaceBody b = make_body(geometry::shared_icosphere(42).rest, 42);
  ASSERT_EQ(n_points(b, q), 42u + 120u);
  for (int p = 0; p < 42; ++p) {
    EXPECT_EQ(point_position(b, point_stencil(b, q, p)), b.node[p]);
    EXPECT_EQ(site_normal(b, q, p), facing_of(b, q, p));
  }
  for (int p = 42; p < 162; ++p) {
    const std::size_t edge = p - 42;
    const auto [i, j] = b.topology->edge[edge];
    const Vec3 middle = 0.5 * (b.node[i] + b.node[j]);
    const PointStencil s = point_stencil(b, q, p);
    EXPECT_EQ(point_position(b, s), middle);
    EXPECT_EQ(site_place(b, q, p), middle);
    EXPECT_EQ(site_normal(b, q, p), facing_of(b, q, p));
    EXPECT_EQ(s.weight[2], 0);
    // The solver takes the three for the corners of a face.
    std::array<int, 3> corners = s.node;
    std::ranges::sort(corners);
    int faces = 0;
    for (int t : b.topology->edge_triangle[edge]) {
      std::array<int, 3> face = b.topology->triangle[t];
      std::ranges::sort(face);
      faces += face == corners ? 1 : 0;
    }
    EXPECT_EQ(faces, 1);
  }
}

// Every gap is the distance to the closest of all triangles, negative inside; and nothing is
// missed.
TEST(FindContacts, GapsAreThoseOfTryingEveryTriangle) {
  auto random = reference::stream(61);
  double worst = 0;
  int n_contact = 0, n_inside = 0;
  for (const Quadrature q : kAll)
    for (int k = 0; k < 8; ++k) {
      const double apart = random.uniform(18.8, 20.8);
      const std::vector<SurfaceBody> bodies{
          make_body(sphere_nodes(162, 10, {5, -3, 8}, reference::random_rotation(random)), 162),
          make_body(sphere_nodes(162, 10, Vec3(5, -3, 8) + apart * random.unit_vector(),
                                 reference::random_rotation(random)),
                    162)};
      const SearchOptions o{q, 0.9, 1.5, 0.3, 0};
      const auto contacts = find_all(bodies, o);
      std::vector<std::vector<int>> seen(
          2, std::vector<int>(n_sites(bodies[0], q) * static_cast<std::size_t>(points_per_site(q)),
                              0));
      for (const Contact& c : contacts) {
        const SurfaceBody& a = bodies[c.a];
        const SurfaceBody& b = bodies[c.b];
        const Vec3 x = point_position(a, point_stencil(a, q, c.point));
        worst = std::max(
            worst, std::abs(c.gap - reference::plain_signed_distance(x, b.node, *b.triangle)));
        const auto& corner = (*b.triangle)[c.triangle];
        const auto weight = c.weights();
        Vec3 closest = Vec3::Zero();
        for (std::size_t m = 0; m < 3; ++m) closest += weight[m] * b.node[corner[m]];
        EXPECT_EQ(weight[0], static_cast<double>(c.place[0]));
        EXPECT_EQ(weight[1], static_cast<double>(c.place[1]));
        EXPECT_NEAR(weight[0] + weight[1] + weight[2], 1, 1e-14);
        // gap and normal are exact for the place that the rounded weights name
        EXPECT_LT((closest + c.gap * c.normal - x).norm(), 1e-12);
        EXPECT_NEAR(c.normal.norm(), 1, 1e-14);
        ++seen[c.a][c.point];
        ++n_contact;
        n_inside += c.gap < 0 ? 1 : 0;
      }
      for (int body : {0, 1})
        for (std::size_t p = 0; p < seen[0].size(); ++p) {
          const SurfaceBody& a = bodies[body];
          const SurfaceBody& b = bodies[1 - body];
          const int times = seen[body][p];
          EXPECT_LE(times, 1);
          const Vec3 x = point_position(a, point_stencil(a, q, static_cast<int>(p)));
          const Vec3 toward = ((b.box.low + b.box.high) / 2 - x).normalized();
          if (facing_of(a, q, static_cast<int>(p)).dot(toward) < 0.2) continue;  // faces away
          const double gap = reference::plain_signed_distance(x, b.node, *b.triangle);
          EXPECT_EQ(times, gap > -1.5 && gap < 0.9 ? 1 : 0) << gap;
        }
    }
  std::printf("surface contacts: %d gaps (%d inside) against every triangle %.1e um\n", n_contact,
              n_inside, worst);
  EXPECT_GT(n_inside, 100);
  EXPECT_LT(worst, 2 * kFloatEps);  // two weights, half a unit off at most, times edges of 3 um
}

// What find_contacts relies on: no triangle is missing that may be closest after a movement by the
// skin, and no bound is more than the distance.
TEST(FindCandidates, HoldEveryTriangleThatMayBecomeTheClosest) {
  auto random = reference::stream(65);
  int n_point = 0, n_triangle = 0;
  for (const Quadrature q : kAll) {
    const std::vector<SurfaceBody> bodies{
        make_body(sphere_nodes(162, 10, {5, -3, 8}, reference::random_rotation(random)), 162),
        make_body(sphere_nodes(162, 10, Vec3(5, -3, 8) + 19 * random.unit_vector(),
                               reference::random_rotation(random)),
                  162)};
    const SearchOptions o{q, 0.9, 1.5, 0.3, 0};
    for (const Candidates& c : find_candidates(bodies, {}, o)) {
      const SurfaceBody& a = bodies[c.body_a];
      const SurfaceBody& b = bodies[c.body_b];
      const CandidateList& list = c.list;
      for (std::size_t p = 0; p < list.n_point(); ++p) {
        EXPECT_TRUE(p == 0 || list.point_at(p - 1) < list.point_at(p));
        const Vec3 x = point_position(a, point_stencil(a, q, list.point_at(p)));
        const double gap = reference::plain_signed_distance(x, b.node, *b.triangle);
        EXPECT_NEAR(static_cast<double>(list.gap_at(p)), gap, std::abs(gap) / 128 + 1e-6);
        EXPECT_LE(std::abs(static_cast<double>(list.gap_at(p))), std::abs(gap) + 1e-6);
        std::vector<double> listed(b.triangle->size(), -1);
        for (std::uint32_t k = list.begin_of(p); k < list.end_of(p); ++k) {
          EXPECT_GE(list.bound_at(k), list.bound_at(list.begin_of(p)));
          listed[list.triangle_at(k)] = static_cast<double>(list.bound_at(k));
        }
        EXPECT_NEAR(static_cast<double>(list.bound_at(list.begin_of(p))), std::abs(gap),
                    std::abs(gap) / 128 + 1e-6);
        for (std::size_t t = 0; t < listed.size(); ++t) {
          const auto& corner = (*b.triangle)[t];
          const double distance =
              std::sqrt(geometry::find_closest_point(x, b.node[corner[0]], b.node[corner[1]],
                                                     b.node[corner[2]])
                            .squared_distance);
          EXPECT_LT(listed[t], distance + 1e-6);
          if (distance < std::abs(gap) + 2 * o.skin) {
            EXPECT_GE(listed[t], 0);
          }
          n_triangle += listed[t] >= 0 ? 1 : 0;
        }
        ++n_point;
      }
    }
  }
  std::printf("candidates: %d points, %d triangles\n", n_point, n_triangle);
  EXPECT_GT(n_point, 100);
}

TEST(FindContacts, OldListsFindWhatNewListsFind) {
  auto random = reference::stream(62);
  int compared = 0;
  for (int k = 0; k < 10; ++k) {
    std::vector<SurfaceBody> bodies;
    for (int b = 0; b < 4; ++b)
      bodies.push_back(
          make_body(sphere_nodes(162, 10,
                                 Vec3(b % 2 == 0 ? 0 : 19.4, b / 2 == 0 ? 0 : 19.7, 0) +
                                     reference::random_vector(random, 0.3),
                                 reference::random_rotation(random)),
                    162));
    const SearchOptions o{kAll[k % 3], 0.9, 1.5, 0.3, 0.3};
    const auto lists = find_candidates(bodies, {}, o);
    for (SurfaceBody& b : bodies) {
      for (Vec3& x : b.node) x += random.uniform(0, 0.15) * random.unit_vector();
      refresh_body(b);
    }
    Contacts old;
    for (const Candidates& c : lists) find_contacts(c, bodies, {}, o, 0.3, old);
    const auto fresh = find_all(bodies, o);
    ASSERT_EQ(old.size(), fresh.size());
    for (std::size_t i = 0; i < old.size(); ++i) {
      EXPECT_EQ(old[i].a, fresh[i].a);
      EXPECT_EQ(old[i].point, fresh[i].point);
      EXPECT_EQ(old[i].b, fresh[i].b);
      EXPECT_EQ(old[i].triangle, fresh[i].triangle);
      EXPECT_EQ(old[i].gap, fresh[i].gap);
      EXPECT_EQ(old[i].normal, fresh[i].normal);
    }
    compared += static_cast<int>(old.size());
  }
  std::printf("lists: %d contacts equal\n", compared);
}

TEST(FindContacts, SameFacingSheetsAreNotContacts) {
  // A small sphere inside a large one, just below its wall: normals agree, nothing opposes.
  auto random = reference::stream(63);
  const std::vector<SurfaceBody> bodies{
      make_body(sphere_nodes(162, 10, {0, 0, 0}, reference::random_rotation(random)), 162),
      make_body(sphere_nodes(162, 9.7, {0, 0, 0}, reference::random_rotation(random)), 162)};
  EXPECT_TRUE(find_all(bodies, {Quadrature::kThreePoint, 0.9, 1.5, 0.3, 0}).empty());
}

TEST(FindContacts, FixedBodiesAreProbedButDoNotProbe) {
  const Mat3 one = Mat3::Identity();
  const std::vector<SurfaceBody> bodies{make_body(sphere_nodes(162, 10, {0, 0, 0}, one), 162)};
  const std::vector<SurfaceBody> fixed{make_body(sphere_nodes(162, 10, {0, 0, 20.1}, one), 162)};
  const auto contacts = find_all(bodies, {Quadrature::kThreePoint, 0.9, 1.5, 0.3, 0}, fixed);
  EXPECT_FALSE(contacts.empty());
  for (const Contact& c : contacts) {
    EXPECT_EQ(c.a, 0);
    EXPECT_EQ(c.b, 0);
  }
}

/// Unit sphere drawn out to a rod with flat ends along x, half length a and half width b, then
/// bent round until its two ends face each other at the given distance.
std::vector<Vec3> horseshoe(double a, double b, double opening) {
  const double round = (2 * a + opening) / (2 * kPi);  // radius of the middle line
  const std::vector<Vec3>& rest = geometry::shared_icosphere(162).rest;
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(rest[0], Vec3::UnitX());
  std::vector<Vec3> out;
  for (const Vec3& p : rest) {
    const Vec3 n = turn * p.normalized();
    const double u = n.x(), across = std::sqrt(std::max(1e-30, 1 - u * u));
    const double width = b * std::sqrt(std::max(0.0, 1 - std::pow(u, 8))) / across;
    const double angle = a * (1.5 * u - 0.5 * u * u * u) / round, y = round + width * n.y();
    out.emplace_back(y * std::sin(angle), y * std::cos(angle), width * n.z());
  }
  return out;
}

TEST(SelfContact, HorseshoeMeetsItself) {
  for (double opening : {0.03, 0.1})
    for (const Quadrature q : {Quadrature::kThreePoint, Quadrature::kNodesAndEdges}) {
      const std::vector<SurfaceBody> bodies{make_body(horseshoe(30, 5, opening), 162)};
      const auto contacts = find_all(bodies, {q, 0.9, 1.5, 0.3, 0.3});
      std::printf("horseshoe open by %.2f um: %zu self contacts\n", opening, contacts.size());
      EXPECT_GT(contacts.size(), 10u);
      for (const Contact& c : contacts) {
        EXPECT_EQ(c.a, c.b);
        EXPECT_GT(c.gap, 0);
        EXPECT_LT(c.gap, 0.3);
        const Vec3 x = point_position(bodies[0], point_stencil(bodies[0], q, c.point));
        EXPECT_LT(x.y(), 0) << "only the ends meet";
        EXPECT_LT(facing_of(bodies[0], q, c.point).dot(bodies[0].normal[c.triangle]), 0.2);
      }
    }
  const std::vector<SurfaceBody> open{make_body(horseshoe(30, 5, 2), 162)};
  EXPECT_TRUE(find_all(open, {Quadrature::kThreePoint, 0.9, 1.5, 0.3, 0.3}).empty());
}

TEST(SelfContact, SpheresAndPancakesDoNotMeetThemselves) {
  auto random = reference::stream(64);
  for (int n : {42, 162, 642})
    for (const Vec3& axes :
         {Vec3(10, 10, 10), Vec3(14, 14, 0.5), Vec3(14, 5, 0.5), Vec3(20, 1, 1), Vec3(14, 14, 0.1)})
      for (const Quadrature q : kAll) {
        std::vector<Vec3> x;
        const Mat3 turn = reference::random_rotation(random);
        for (const Vec3& p : geometry::shared_icosphere(n).rest)
          x.push_back(turn * axes.cwiseProduct(p));
        const std::vector<SurfaceBody> bodies{make_body(x, n)};
        EXPECT_TRUE(find_all(bodies, {q, 0.9, 1.5, 0.3, 0.3}).empty())
            << n << ": " << axes.transpose();
      }
}

}  // namespace
}  // namespace acinus::contact
