#include "geometry/topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/measures.hpp"
#include "tests/geometry/shapes.hpp"
#include "tests/geometry/temp_folder.hpp"

namespace acinus::geometry {
namespace {

// Rest angle by its definition, from any node positions.
double angle(const std::array<Vec3, 4>& x) {
  const Vec3 edge = x[3] - x[2];
  const Vec3 n1 = (x[0] - x[2]).cross(x[0] - x[3]);
  const Vec3 n2 = (x[1] - x[3]).cross(x[1] - x[2]);
  return -std::atan2(n1.cross(n2).dot(edge) / edge.norm(), n1.dot(n2));
}

void expect_sound(const Topology& mesh) {
  EXPECT_EQ(mesh.n_node - mesh.n_edge + mesh.n_triangle, 2);
  EXPECT_EQ(2 * mesh.n_edge, 3 * mesh.n_triangle);
  const double kRoundOff = 1e-13 * mesh.n_triangle;  // sums of n terms of order 1
  EXPECT_NEAR(compute_volume(mesh.rest, mesh.triangle), 4 * kPi / 3, kRoundOff);
  EXPECT_LT(compute_centroid(mesh.rest, mesh.triangle).norm(), kRoundOff);
  double node_area = 0, length = 0;
  for (const double area : mesh.rest_node_area) node_area += area;
  for (const double l : mesh.rest_length) length += l;
  EXPECT_NEAR(node_area, mesh.rest_area, kRoundOff);
  EXPECT_NEAR(compute_area(mesh.rest, mesh.triangle), mesh.rest_area, kRoundOff);
  EXPECT_NEAR(length / mesh.n_edge, mesh.mean_rest_length, kRoundOff);
  for (int e = 0; e < mesh.n_edge; ++e) {
    const std::size_t s = e;
    const auto [x1, x2, x3, x4] = mesh.hinge[s];
    EXPECT_LT(mesh.edge[s][0], mesh.edge[s][1]);
    EXPECT_EQ(std::minmax(x3, x4), std::minmax(mesh.edge[s][0], mesh.edge[s][1]));
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = mesh.rest[mesh.hinge[s][k]];
    const std::array<Vec3, 2> normal = {(x[0] - x[2]).cross(x[0] - x[3]),
                                        (x[1] - x[3]).cross(x[1] - x[2])};
    for (std::size_t side = 0; side < 2; ++side) {
      const auto& t = mesh.triangle[mesh.edge_triangle[s][side]];
      EXPECT_NE(std::find(t.begin(), t.end(), side == 0 ? x1 : x2), t.end());
      const Vec3 a = mesh.rest[t[0]];
      const Vec3 outward = (mesh.rest[t[1]] - a).cross(mesh.rest[t[2]] - a);
      EXPECT_LT((normal[side] - outward).norm(), 1e-13);
    }
    EXPECT_NEAR(std::remainder(
                    std::atan2(mesh.rest_angle_sin[s], mesh.rest_angle_cos[s]) - angle(x), 2 * kPi),
                0, 1e-13);
  }
}

TEST(Icosphere, HasTheConstantsOfTheMeshTable) {
  struct Row {
    int n_node;
    double mean_edge, node_area, volume_ratio, inflation;
  };
  // From an independent computation at R = 12 um, rounded to the digits given.
  for (const Row& row : {Row{42, 6.98740, 39.99748, 0.873453, 1.046133},
                         Row{162, 3.59198, 10.95987, 0.966161, 1.011541},
                         Row{642, 1.80876, 2.80519, 0.991394, 1.002885}}) {
    const Topology& mesh = shared_icosphere(row.n_node);
    double low = 1e9, high = 0;
    for (const Vec3& x : mesh.rest) {
      low = std::min(low, x.norm());
      high = std::max(high, x.norm());
    }
    const double inflation = high;  // all nodes lie on one sphere
    EXPECT_NEAR(low, high, 1e-13);
    std::printf("n %d: inflation %.5f, V ratio %.5f, mean edge %.4f um, node area %.4f um^2\n",
                row.n_node, inflation, std::pow(inflation, -3),
                12 * mesh.mean_rest_length / inflation,
                144 * mesh.rest_area / mesh.n_node / inflation / inflation);
    EXPECT_NEAR(12 * mesh.mean_rest_length / inflation, row.mean_edge, 5e-6);
    EXPECT_NEAR(144 * mesh.rest_area / mesh.n_node / inflation / inflation, row.node_area, 5e-6);
    EXPECT_NEAR(inflation, row.inflation, 5e-7);
    EXPECT_NEAR(std::pow(inflation, -3), row.volume_ratio, 5e-7);
  }
  const Topology& mesh = shared_icosphere(162);
  const auto [low, high] = std::minmax_element(mesh.rest_length.begin(), mesh.rest_length.end());
  EXPECT_NEAR(12 * *low / mesh.rest[0].norm(), 3.311, 5e-4);
  EXPECT_NEAR(12 * *high / mesh.rest[0].norm(), 3.899, 5e-4);
}

TEST(Icosphere, IsSoundAtEveryLevel) {
  for (const int n_node : {12, 42, 92, 162, 252, 362, 642, 1442, 2562}) {
    const Topology mesh = make_icosphere(n_node);
    EXPECT_EQ(mesh.n_node, n_node);
    EXPECT_EQ(mesh.n_triangle, 2 * n_node - 4);
    expect_sound(mesh);
  }
}

TEST(Icosphere, NeighboursAreCloseInMemory) {
  // A front of the breadth-first order crosses the sphere once: at most about pi sqrt(n) nodes.
  for (const int n_node : {162, 252, 362, 642, 1442, 2562}) {
    const Topology& mesh = shared_icosphere(n_node);
    int widest = 0;
    for (const auto& [i, j] : mesh.edge) widest = std::max(widest, j - i);
    std::printf("n %d: largest index distance along an edge %d\n", n_node, widest);
    EXPECT_LT(widest, kPi * std::sqrt(n_node));
  }
}

TEST(Icosphere, IsMadeOnceAndOnlyInKnownSizes) {
  EXPECT_EQ(&shared_icosphere(162), &shared_icosphere(162));
  EXPECT_NE(&shared_icosphere(42), &shared_icosphere(162));
  const std::string text = test::message_of([] { make_icosphere(100); });
  EXPECT_CONTAINS(text, "100");
  EXPECT_CONTAINS(text, "12, 42, 92, 162, 252, 362, 642, 1442 and 2562");
}

TEST(Hinge, AngleGradientHasTheSignOfTheFormula) {
  // numerics: dth/dx1 = L a1, dth/dx2 = L a2, dth/dx3 = ((x1-x4).E/L) a1 + ((x2-x4).E/L) a2,
  // dth/dx4 = -((x1-x3).E/L) a1 - ((x2-x3).E/L) a2 with a = N / |N|^2.
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 0.05);
  const Topology& mesh = shared_icosphere(42);
  double worst = 0;
  for (const auto& hinge : mesh.hinge) {
    std::array<Vec3, 4> x;
    for (std::size_t k = 0; k < 4; ++k) {
      x[k] = mesh.rest[hinge[k]] + Vec3(noise(random), noise(random), noise(random));
    }
    const Vec3 edge = x[3] - x[2];
    const double length = edge.norm();
    const Vec3 n1 = (x[0] - x[2]).cross(x[0] - x[3]), n2 = (x[1] - x[3]).cross(x[1] - x[2]);
    const Vec3 a1 = n1 / n1.squaredNorm(), a2 = n2 / n2.squaredNorm();
    const std::array<Vec3, 4> gradient = {
        length * a1, length * a2,
        (x[0] - x[3]).dot(edge) / length * a1 + (x[1] - x[3]).dot(edge) / length * a2,
        -(x[0] - x[2]).dot(edge) / length * a1 - (x[1] - x[2]).dot(edge) / length * a2};
    for (std::size_t k = 0; k < 4; ++k) {
      for (int d = 0; d < 3; ++d) {
        const double h = 1e-5;
        auto plus = x, minus = x;
        plus[k][d] += h;
        minus[k][d] -= h;
        const double difference = std::remainder(angle(plus) - angle(minus), 2 * kPi) / (2 * h);
        worst = std::max(worst, std::abs(difference - gradient[k][d]));
      }
    }
  }
  std::printf("worst difference %.2e 1/um\n", worst);
  EXPECT_LT(worst, 1e-8);  // h^2 theta''' + eps / h = 1e-10 * O(30) + 1e-11
}

TEST(Hinge, RestAngleIsNegativeOnAConvexShape) {
  // Moving a corner outward (along N1) raises theta, and flat is 0.
  for (const double sine : shared_icosphere(162).rest_angle_sin) EXPECT_LT(sine, 0);
}

TEST(Topology, TakesAnySphereLikeSurface) {
  expect_sound(make_topology(make_box(Vec3(1, 2, 3))));
  const Surface tetrahedron = {{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)},
                               {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  expect_sound(make_topology(tetrahedron));
  Surface dented = make_sphere(162, 12, Vec3(1e3, -1e3, 5e2));  // not convex, far away
  for (Vec3& x : dented.node) {
    const Vec3 direction = (x - Vec3(1e3, -1e3, 5e2)).normalized();
    x -= 5 * std::exp(-10 * (direction - Vec3::UnitX()).squaredNorm()) * direction;
  }
  Topology mesh = make_topology(dented);
  EXPECT_NEAR(compute_volume(mesh.rest, mesh.triangle), 4 * kPi / 3, 1e-12);
  EXPECT_GT(*std::max_element(mesh.rest_angle_sin.begin(), mesh.rest_angle_sin.end()), 0.1);
}

TEST(Topology, RingsAreSortedAndComplete) {
  const Topology& mesh = shared_icosphere(42);
  EXPECT_EQ(mesh.ring.size(), static_cast<std::size_t>(2 * mesh.n_edge));
  EXPECT_EQ(mesh.node_triangle.size(), static_cast<std::size_t>(3 * mesh.n_triangle));
  for (std::size_t i = 0; i < 42; ++i) {
    EXPECT_TRUE(std::is_sorted(mesh.ring.begin() + mesh.ring_start[i],
                               mesh.ring.begin() + mesh.ring_start[i + 1]));
    for (int k = mesh.node_triangle_start[i]; k < mesh.node_triangle_start[i + 1]; ++k) {
      const auto& t = mesh.triangle[mesh.node_triangle[k]];
      EXPECT_NE(std::find(t.begin(), t.end(), static_cast<int>(i)), t.end());
    }
  }
}

TEST(Topology, RefusesWhatIsNotASphere) {
  Surface open = make_box(Vec3(1, 1, 1));
  open.triangle.pop_back();
  EXPECT_CONTAINS(test::message_of([&] { make_topology(open); }), "3 open edges");

  Surface inward = make_box(Vec3(1, 1, 1));
  for (auto& t : inward.triangle) std::swap(t[0], t[1]);
  EXPECT_CONTAINS(test::message_of([&] { make_topology(inward); }), "inward");

  EXPECT_CONTAINS(test::message_of([] { make_topology(make_torus(8)); }), "1 handles");

  Surface two = make_box(Vec3(1, 1, 1));
  const Surface other = make_box(Vec3(1, 1, 1));
  two.node.insert(two.node.end(), other.node.begin(), other.node.end());
  for (auto t : other.triangle) two.triangle.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  EXPECT_CONTAINS(test::message_of([&] { make_topology(two); }), "node 8 is not connected");

  Surface unused = make_box(Vec3(1, 1, 1));
  unused.node.push_back(Vec3(5, 5, 5));
  EXPECT_CONTAINS(test::message_of([&] { make_topology(unused); }), "node 8 is not connected");

  Surface flat = make_box(Vec3(1, 1, 1));
  flat.node[0] = Vec3(0.5, 0.5, 0);  // on the diagonal 1-2: triangle 0 collapses
  EXPECT_CONTAINS(test::message_of([&] { make_topology(flat); }),
                  "triangle 0 (nodes 0, 2, 1) has no area");

  Surface lost = make_box(Vec3(1, 1, 1));
  lost.node[3].y() = std::nan("");
  EXPECT_CONTAINS(test::message_of([&] { make_topology(lost); }), "not finite");
}

}  // namespace
}  // namespace acinus::geometry
