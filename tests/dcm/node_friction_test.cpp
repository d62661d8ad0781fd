/// Friction from node to node: whom it joins, what it holds back and what not.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "core/parallel/threads.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/contact/node_friction.hpp"
#include "tests/dcm/bounded_clump.hpp"
#include "tests/dcm/quadratures.hpp"
#include "tests/reference/dense_system.hpp"

namespace acinus::dcm {
namespace {

solve::PointLinks node_links(const Clump& c) {
  solve::PointLinks links;
  add_node_friction(c.input(), c.work, c.contacts, links);
  return links;
}

/// Friction of every pair of points; the lower one first.
using Pairs = std::map<std::pair<solve::Point, solve::Point>, double>;
void add(Pairs& pairs, solve::Point a, solve::Point b, double friction) {
  pairs[{std::min(a, b), std::max(a, b)}] += friction;
}

/// Every contact between cells spreads the friction it has in the other form: evenly over the nodes
/// that weigh something in its point, times the three of the face it meets.
Pairs expected_pairs(const Clump& c) {
  Pairs pairs;
  for (const solve::Link& l : c.links.link) {
    if (!l.b.exists() || l.friction == 0) continue;
    std::vector<solve::Point> own{l.a.point.begin(), l.a.point.end()};
    if (l.a.is_single())
      own.resize(1);
    else if (c.options.quadrature == contact::Quadrature::kNodesAndEdges)
      own.resize(2);  // an edge: the third weighs nothing
    for (const solve::Point i : own)
      for (const solve::Point j : l.b.point)
        add(pairs, i, j, static_cast<double>(l.friction) / (3 * static_cast<double>(own.size())));
  }
  return pairs;
}

TEST(NodeFriction, JoinsEveryNodeOfAFaceWithEveryNodeOfTheFaceItMeets) {
  for (const auto q : kAll) {
    Clump c = make_bounded_clump(97);
    c.options.quadrature = q;
    c.find();
    const Pairs expected = expected_pairs(c);
    Pairs found;
    const auto links = node_links(c);
    for (const solve::PointLink& l : links) {
      EXPECT_EQ(l.stiffness, 0);
      add(found, l.a, l.b, static_cast<double>(l.friction));
    }
    EXPECT_EQ(found.size(), links.size()) << "each pair once";
    ASSERT_EQ(found.size(), expected.size());
    double worst = 0;
    for (const auto& [pair, friction] : expected) {
      ASSERT_TRUE(found.contains(pair));
      worst = std::max(worst, std::abs(found.at(pair) / friction - 1));
    }
    std::printf("%zu pairs of nodes for %zu contacts, off by %.1e\n", links.size(), c.links.size(),
                worst);
    EXPECT_GT(links.size(), 100u);
    EXPECT_LT(worst, 2e-7);  // floats, once here and once there
  }
}

TEST(NodeFriction, TakesTheFrictionOutOfTheSurfaceContacts) {
  Clump c = make_bounded_clump(97);
  c.find();
  const solve::Links before = c.links;
  std::vector<Vec3> force;
  for (std::size_t l = 0; l < before.size(); ++l) force.push_back(c.force(l));
  c.options.friction_form = FrictionForm::kNodes;
  c.find();
  ASSERT_EQ(c.links.size(), before.size());
  int rubbing = 0;
  for (std::size_t l = 0; l < before.size(); ++l) {
    const solve::Link &a = before.link[l], &b = c.links.link[l];
    EXPECT_EQ(a.stiffness, b.stiffness);
    EXPECT_EQ(force[l], c.force(l));
    EXPECT_EQ(b.friction, b.b.exists() ? 0 : a.friction) << "vessels and walls have no nodes";
    rubbing += b.friction > 0 ? 1 : 0;
  }
  EXPECT_GT(rubbing, 0);
  c.options.friction_factor = 0;
  EXPECT_TRUE(node_links(c).empty());
}

// Two cells that slide as wholes cannot tell the forms apart.
TEST(NodeFriction, HoldsCellsAsTheOtherFormDoes) {
  for (const auto q : kAll) {
    Clump c = make_clump(98);
    c.options.quadrature = q;
    c.find();
    double surface = 0, nodes = 0;
    for (const solve::Link& l : c.links.link) surface += static_cast<double>(l.friction);
    for (const solve::PointLink& l : node_links(c)) nodes += static_cast<double>(l.friction);
    EXPECT_GT(surface, 0);
    EXPECT_NEAR(nodes, surface, 1e-6 * surface);  // floats
  }
}

TEST(NodeFriction, IsSymmetricSemiDefiniteAndBlindToTranslation) {
  Clump c;
  auto random = reference::stream(99);
  std::vector<NewCell> cells;
  for (int k = 0; k < 3; ++k)
    cells.push_back(new_cell(k, Vec3(19.5 * (k % 2), 17.0 * (k / 2), 4 * k), 10,
                             reference::random_rotation(random), 42));
  c.add_cells(cells);
  c.find();
  solve::System s;
  solve::set_blocks(s, make_blocks(c.state, c.params));
  s.point_links = node_links(c);
  ASSERT_GT(s.point_links.size(), 20u);
  const Eigen::MatrixXd a = reference::make_dense_elements(s);
  const double size = a.cwiseAbs().maxCoeff();
  EXPECT_EQ((a - a.transpose()).cwiseAbs().maxCoeff(), 0);
  const Eigen::VectorXd value = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(a).eigenvalues();
  EXPECT_GT(value.minCoeff(), -1e-12 * size);  // round-off of the eigenvalues
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(a.rows());
  c.for_each_node([&](Address at) { shift(static_cast<Eigen::Index>(at)) = 1; });
  EXPECT_LT((a * shift).cwiseAbs().maxCoeff(), 1e-12 * size);  // of sums over 20 pairs
}

/// Dissipation while all cells grow about one point with the rate 1, nN um/s, over their friction.
double damping_of_stretch(int n_node, bool nodes) {
  double sum = 0, friction = 0;
  for (int k = 0; k < 6; ++k) {
    auto random = reference::stream(100 + static_cast<std::uint64_t>(k));
    Clump c;
    // Pressed flat on each other by 1 um: many faces touch.
    c.add_cells({new_cell(0, {0, 0, 0}, 10, reference::random_rotation(random), n_node),
                 new_cell(1, {19, 0, 0}, 10, reference::random_rotation(random), n_node)});
    c.options.friction_range = 1;
    c.find();
    const auto& x = c.state.position;
    auto take = [&](double f, const Vec3& r) {
      sum += f * r.squaredNorm();
      friction += f;
    };
    if (nodes) {
      for (const solve::PointLink& l : node_links(c))
        take(static_cast<double>(l.friction), load_point(x.data(), solve::address_of(l.a)) -
                                                  load_point(x.data(), solve::address_of(l.b)));
      continue;
    }
    for (const solve::Link& l : c.links.link) {
      const solve::Stencil s = solve::stencil_of(l);
      Vec3 r = Vec3::Zero();
      for (std::size_t m = 0; m < static_cast<std::size_t>(s.n); ++m)
        r += s.weight[m] * load_point(x.data(), s.address[m]);
      take(static_cast<double>(l.friction), r);
    }
  }
  return sum / friction;
}

// Two faces with nodes at the distance d of their middles, in no fixed place to each other: the
// mean of |x_i - y_j|^2 is 2 d^2 and the middles' distance squared. d^2 of an equilateral face is a
// third of its edge squared.
TEST(NodeFriction, HoldsBackSurfacesThatStretchTogetherAsTheEdgeSquared) {
  const double edge = 10 * geometry::shared_icosphere(162).mean_rest_length,
               fine = 10 * geometry::shared_icosphere(642).mean_rest_length;
  const double one = damping_of_stretch(162, true), half = damping_of_stretch(642, true),
               surface = damping_of_stretch(162, false);
  std::printf(
      "damping of stretch over friction: nodes %.3f, %.3f um^2 (%.3f, %.3f edges^2), "
      "surface %.3f um^2\n",
      one, half, one / (edge * edge), half / (fine * fine), surface);
  EXPECT_GT(one, 2.0 / 3 * edge * edge);
  EXPECT_LT(one, 1.2 * edge * edge);
  EXPECT_GT(half, 2.0 / 3 * fine * fine);
  EXPECT_LT(half, 1.2 * fine * fine);
  EXPECT_LT(surface, 1);  // gaps are up to 1 um
  EXPECT_NEAR(one / half, edge * edge / (fine * fine), 0.6);
}

TEST(NodeFriction, SameBitsForAnyNumberOfThreads) {
  const int before = thread_count();
  std::vector<solve::PointLinks> links;
  for (int threads : {1, 2, 3}) {
    set_threads(threads);
    Clump c = make_bounded_clump(91);
    c.find();
    links.push_back(node_links(c));
  }
  set_threads(before);
  for (const std::size_t k : {1u, 2u}) {
    ASSERT_EQ(links[k].size(), links[0].size());
    for (std::size_t l = 0; l < links[0].size(); ++l) {
      EXPECT_EQ(links[k][l].a, links[0][l].a);
      EXPECT_EQ(links[k][l].b, links[0][l].b);
      EXPECT_EQ(links[k][l].friction, links[0][l].friction);
    }
  }
}

}  // namespace
}  // namespace acinus::dcm
