/// Pull-off of two rigid cells against Derjaguin's 2 pi W R^.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "dcm/contact/contact_params.hpp"
#include "tests/dcm/clump.hpp"

namespace acinus::dcm {
namespace {

/// Largest attraction along the axis over all gaps, nN; Rhat = R/2 = 5 um.
double pull_off(const Mat3& turn_a, const Mat3& turn_b, const ContactParams& options,
                double adhesion, int n_node) {
  const double rise =
      geometry::shared_icosphere(n_node).rest[0].norm();  // nodes on the sphere of R = 10
  Clump c;
  c.add_cells({new_cell(0, {0, 0, 0}, 10 / rise, turn_a, n_node),
               new_cell(1, {0, 0, 22}, 10 / rise, turn_b, n_node)});
  c.params[0].adhesion = adhesion;
  const double friction = c.options.cell_friction;
  c.options = options;
  c.options.cell_friction = friction;
  std::vector<double> up(c.state.position.size());
  const HeldRows<double> start = c.state.position;
  for (int i = 0; i < n_node; ++i)
    store_point(up.data(), node_address(c.state, 1, i), Vec3::UnitZ());
  const auto attraction = [&](double apart) {
    c.state.position = start;
    c.shift(up, apart - 22);
    c.find();
    const auto f = c.node_force();
    double pull = 0;
    for (int i = 0; i < n_node; ++i) pull -= load_point(f.data(), node_address(c.state, 1, i)).z();
    return pull;
  };
  // The top is sharp on the side where the first points begin to press: scan finely about it.
  double best = 0, place = 0;
  for (double apart = 19.6; apart < 21; apart += 0.05)
    if (const double pull = attraction(apart); pull > best) best = pull, place = apart;
  EXPECT_GT(place, 19.6);
  EXPECT_LT(place, 20.9);
  for (int k = -9; k <= 9; ++k) best = std::max(best, attraction(place + 0.005 * k));
  return best;
}

struct Statistics {
  double mean = 0, deviation = 0, lowest = 1e300, highest = 0;
};

Statistics statistics(const ContactParams& options, int n_orientation, int n_node) {
  auto random = reference::stream(95);
  std::vector<double> ratio;
  Statistics s;
  for (int k = 0; k < n_orientation; ++k) {
    const Mat3 a = reference::random_rotation(random);
    ratio.push_back(pull_off(a, reference::random_rotation(random), options, 0.01, n_node) /
                    (2 * kPi * 0.01 * 5));
    s.mean += ratio.back() / n_orientation;
    s.lowest = std::min(s.lowest, ratio.back());
    s.highest = std::max(s.highest, ratio.back());
  }
  for (double r : ratio) s.deviation += (r - s.mean) * (r - s.mean) / (n_orientation - 1);
  s.deviation = std::sqrt(s.deviation);
  return s;
}

TEST(RigidPullOff, IsDerjaguinsForAnyOrientation) {
  ContactParams options;
  options.range_factor = 0.3;
  options.repulsion = 5;
  const Statistics s = statistics(options, 24, 162);
  std::printf("pull-off / (2 pi W R^), 162 nodes, 3-point, 0.3 edge: %.3f +- %.3f (%.3f .. %.3f)\n",
              s.mean, s.deviation, s.lowest, s.highest);
  testing::Test::RecordProperty("mean", std::to_string(s.mean));
  testing::Test::RecordProperty("sd", std::to_string(s.deviation));
  EXPECT_NEAR(s.mean, 1, 0.05);
  EXPECT_LT(s.deviation, 0.1);
}

// Nodes sample the narrow rim more coarsely: they need half an edge of range, and scatter more.
TEST(RigidPullOff, NodeQuadratureNeedsHalfAnEdge) {
  ContactParams options;
  options.quadrature = contact::Quadrature::kNodes;
  options.range_factor = 0.5;
  const Statistics wide = statistics(options, 24, 162);
  options.range_factor = 0.1;
  const Statistics narrow = statistics(options, 24, 162);
  std::printf(
      "pull-off / (2 pi W R^), 162 nodes, nodes, 0.5 edge: %.3f +- %.3f; 0.1 edge: %.3f +- %.3f\n",
      wide.mean, wide.deviation, narrow.mean, narrow.deviation);
  EXPECT_NEAR(wide.mean, 1, 0.05);
  EXPECT_LT(2 * wide.deviation, narrow.deviation);
}

// Points half an edge apart: more range than three a face, less than nodes (0.3 edge: 0.947 +-
// 0.075).
TEST(RigidPullOff, NodesAndEdgesNeedLittleMoreThanThreePoints) {
  ContactParams options;
  options.quadrature = contact::Quadrature::kNodesAndEdges;
  options.range_factor = 0.35;
  const Statistics s = statistics(options, 24, 162);
  std::printf("pull-off / (2 pi W R^), 162 nodes, nodes and edges, 0.35 edge: %.3f +- %.3f\n",
              s.mean, s.deviation);
  EXPECT_NEAR(s.mean, 1, 0.05);
  EXPECT_LT(s.deviation, 0.1);
}

TEST(RigidPullOff, FinerMeshScattersLess) {
  const Statistics s = statistics(ContactParams{}, 6, 642);
  std::printf("pull-off / (2 pi W R^), 642 nodes, 3-point, 0.3 edge: %.3f +- %.3f\n", s.mean,
              s.deviation);
  EXPECT_NEAR(s.mean, 1, 0.05);
  EXPECT_LT(s.deviation, 0.03);
}

TEST(RigidPullOff, IsLinearInTheWorkOfAdhesion) {
  auto random = reference::stream(96);
  const Mat3 a = reference::random_rotation(random), b = reference::random_rotation(random);
  ContactParams rigid;
  const double one = pull_off(a, b, rigid, 0.01, 162);
  rigid.repulsion *= 5;  // so that only the scale of the law changes
  EXPECT_NEAR(pull_off(a, b, rigid, 0.05, 162), 5 * one, 1e-10);
}

}  // namespace
}  // namespace acinus::dcm
