/// Nucleus of a cell: shell, links and contact.

#include "dcm/nucleus.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "dcm/lane_data.hpp"
#include "dcm/shape/place_nucleus.hpp"
#include "geometry/audit_body.hpp"
#include "geometry/measures.hpp"
#include "tests/dcm/nuclei.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

constexpr Nucleus kLinked{.link_young = 0.7};

/// Nucleus moved against one side of its cell, which it overlaps by some tenths of a um.
NucleatedCells pressed(int n_node = 162) {
  NucleatedCells c = make_deformed_nucleated(with_nucleus({.size = 0.7}), {10, 11}, n_node);
  for (std::size_t l = 0; l < 2; ++l)
    for (int i = c.n_cortex(); i < c.n_point(); ++i)
      c.move(l, i, c.point(l, i) + Vec3(2.2, 0.9, -1.1));
  c.reset();
  return c;
}

/// Adds one of the three kinds of forces; the others stay out of it.
enum class Kind { kShell, kLinks, kContact };

void add(Kind kind, NucleatedCells& c) {
  c.reset();
  if (kind == Kind::kShell)
    add_nucleus_shell(nucleus_shell(c.params), c.view(), &c.system.rank_one[2], nullptr, c.system);
  if (kind == Kind::kLinks) c.add_links();
  if (kind == Kind::kContact) c.add_contacts();
}

double energy(Kind kind, NucleatedCells& c, std::size_t lane) {
  if (kind == Kind::kShell)
    return nucleus_shell_energy(nucleus_shell(c.params), c.view(), static_cast<int>(lane));
  if (kind == Kind::kLinks)
    return nucleus_link_energy(c.state, std::span(&c.params, 1), c.lanes, lane);
  return c.contact_energy();
}

NucleatedCells example(Kind kind, int n_node = 162) {
  return kind == Kind::kContact ? pressed(n_node)
                                : make_deformed_nucleated(with_nucleus(kLinked), {10, 11}, n_node);
}

class Inside : public testing::TestWithParam<Kind> {};

TEST_P(Inside, ForceIsMinusEnergyGradient) {
  NucleatedCells c = example(GetParam(), 42);
  add(GetParam(), c);
  const double scale = c.largest_force(1);
  ASSERT_GT(scale, 0);
  // um: h^2 E''' and kEps E / h are both near 1e-8 of the force. The place of a contact is rounded
  // to a float, 1e-7 of an edge, along which the gap does not change.
  const double h = 1e-4;
  for (int i = 0; i < c.n_point(); ++i)
    for (int k = 0; k < 3; ++k) {
      const Vec3 x = c.point(1, i);
      c.move(1, i, x + h * Vec3::Unit(k));
      const double up = energy(GetParam(), c, 1);
      c.move(1, i, x - h * Vec3::Unit(k));
      const double down = energy(GetParam(), c, 1);
      c.move(1, i, x);
      EXPECT_NEAR(c.force(1, i)[k], -(up - down) / (2 * h), 1e-6 * scale) << i << " " << k;
    }
}

TEST_P(Inside, NetForceAndTorqueVanish) {
  NucleatedCells c = example(GetParam());
  add(GetParam(), c);
  reference::NetForce net;
  for (int i = 0; i < c.n_point(); ++i) net.add(c.force(1, i), c.point(1, i));
  ASSERT_GT(net.force_sizes, 0);
  EXPECT_LE(net.force.norm(), 64 * kEps * net.force_sizes);
  // The normal of a contact is that of the place its float weights name, to the place where the
  // other side's force acts: nothing else is lost.
  EXPECT_LE(net.torque.norm(), 64 * kEps * net.torque_sizes);
}

TEST_P(Inside, TurnsWithTheCell) {
  NucleatedCells c = example(GetParam()), turned = c;
  auto random = reference::stream(4);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 20);
  for (std::size_t l = 0; l < 2; ++l)
    for (int i = 0; i < c.n_point(); ++i) turned.move(l, i, q * c.point(l, i) + shift);
  add(GetParam(), c);
  add(GetParam(), turned);
  // Places 60 um from the origin lose 10 kEps, lengths of edges and depths of contacts 100 times
  // as much; the float place of a contact changes its force by 1e-7 of an edge over its depth.
  const double share = GetParam() == Kind::kContact ? 1e-5 : 1e5 * kEps;
  for (int i = 0; i < c.n_point(); ++i)
    EXPECT_LE((turned.force(1, i) - q * c.force(1, i)).norm(), share * c.largest_force(1));
}

TEST_P(Inside, StiffnessIsSymmetricSemiDefiniteAndBlindToTranslation) {
  NucleatedCells c = example(GetParam(), 42);
  add(GetParam(), c);
  const Eigen::MatrixXd k = matrix_of(c, 1);
  const double scale = k.cwiseAbs().maxCoeff();
  ASSERT_GT(scale, 0);
  EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 16 * kEps * scale);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  // Unit vectors of springs are floats: 1e-7 too long makes as much less than 0.
  EXPECT_GE(values.minCoeff(), -1e-6 * values.maxCoeff());
  for (int m = 0; m < 3; ++m) {
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(k.cols());
    for (int i = m; i < shift.size(); i += 3) shift[i] = 1;
    EXPECT_LT((k * shift).cwiseAbs().maxCoeff(), 64 * kEps * scale * c.n_point());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Inside,
                         testing::Values(Kind::kShell, Kind::kLinks, Kind::kContact));

TEST(Nucleus, HasNoForceAtRest) {
  for (const Kind kind : {Kind::kShell, Kind::kLinks, Kind::kContact}) {
    NucleatedCells c = make_nucleated(with_nucleus(kLinked), {10, 11});
    add(kind, c);
    // 11 um with 16 digits against stiffnesses of some nN/um.
    EXPECT_LT(c.largest_force(1), 1e-12);
  }
}

// Blown up by 1 + e: sum over edges 1/2 k (e l)^2, K_V (V ln(V/V0) - V + V0), no bending.
TEST(Nucleus, ShellIsThatOfACortex) {
  NucleatedCells c = make_nucleated(with_nucleus(), {10});
  const double e = 0.01;
  for (int i = c.n_cortex(); i < c.n_point(); ++i) c.move(0, i, (1 + e) * c.point(0, i));
  c.reset();
  const geometry::Topology& t = geometry::shared_icosphere(42);
  double springs = 0;
  const double k = std::sqrt(3.0) / 2 * 5 * 0.5;
  for (const double l : t.rest_length) springs += 0.5 * k * (e * 5 * l) * (e * 5 * l);
  const double v0 = 4.0 / 3 * kPi * 125, v = v0 * std::pow(1 + e, 3);
  const double expected = springs + 5 * (v * std::log(v / v0) - v + v0);
  // Each part is 1e4 kEps of its stiffness times lengths squared: e^2 = 1e-4 of it is left.
  EXPECT_NEAR(energy(Kind::kShell, c, 0), expected, 1e-9 * expected);
}

// All struts together are the spherical shell between r and R: k = 4 pi E R r / (R - r).
TEST(Nucleus, LinksAreAShellOfThatModulus) {
  NucleatedCells c =
      make_nucleated(with_nucleus({.friction = 0.2, .link_young = 0.7, .link_friction = 3}), {10});
  double stiffness = 0, friction = 0;
  for (int i = 0; i < 42; ++i) {
    const NucleusLink link = nucleus_link(*c.params.nucleus, c.cortex_view(), c.view(), {}, i, 0);
    stiffness += link.stiffness;
    friction += link.friction;
    const Vec3 a = c.point(0, c.n_cortex() + i), b = c.point(0, link.cortex);
    EXPECT_NEAR((b - a).norm(), link.rest_length, 1e-13);
    EXPECT_LT(a.cross(b).norm(), 1e-12) << "the mesh of the nucleus is part of that of the cortex";
  }
  const double form = 4 * kPi * 10 * 5 / (10 - 5);
  EXPECT_NEAR(stiffness, 0.7 * form, 1e-12 * form);
  EXPECT_NEAR(friction, 3 * form + 0.2 * geometry::shared_icosphere(42).rest_area * 25, 1e-10);
}

// A face of the cortex put 0.1 um off a face of the nucleus, 0.2 um nearer than the gap: each of
// its three points pushes with k a / 3 times that.
TEST(Nucleus, ContactPushesWithItsDepth) {
  NucleatedCells c = make_nucleated(with_nucleus({.size = 0.8, .gap = 0.3}), {10});
  const geometry::Topology &cortex = geometry::shared_icosphere(162),
                           &inner = geometry::shared_icosphere(42);
  const auto node = [&](int i) { return c.point(0, c.n_cortex() + i); };
  const auto& corner = inner.triangle[7];
  const Vec3 a = node(corner[0]), b = node(corner[1]), d = node(corner[2]);
  const Vec3 normal = (b - a).cross(d - a).normalized(), middle = (a + b + d) / 3;
  const auto& face = cortex.triangle[3];
  const Vec3 side[3] = {0.3 * (a - middle), 0.3 * (b - middle), 0.3 * (d - middle)};
  for (std::size_t k = 0; k < 3; ++k) c.move(0, face[k], middle + side[k] + 0.1 * normal);
  c.reset();
  c.find_contacts();
  double force = 0;
  int n = 0;
  for (const contact::Contact& k : c.contacts.nucleus()) {
    if (k.point / 3 != 3) continue;
    ++n;
    EXPECT_NEAR(k.gap, -0.2, 1e-6) << "the place is a float";
    EXPECT_LT((k.normal - normal).norm(), 1e-5);
    force += -k.stiffness() * nucleus_contact_area(c.input(), c.cortices, k) * k.gap;
  }
  EXPECT_EQ(n, 3);
  EXPECT_NEAR(force, 5 * cortex.rest_triangle_area[3] * 100 * 0.2, 1e-4);
}

TEST(Nucleus, InTheMiddleTouchesNothing) {
  NucleatedCells c = make_nucleated(with_nucleus(), {10, 12});
  c.find_contacts();
  EXPECT_TRUE(c.contacts.nucleus().empty());
}

TEST(Nucleus, WithoutAnyModulusDoesNotResist) {
  Nucleus n{.young = 0, .bulk_modulus = 0};
  EXPECT_FALSE(n.resists());
  n.link_friction = 1;
  EXPECT_TRUE(n.resists());
}

TEST(Nucleus, CellsWithoutOneHaveNoRowsForIt) {
  Params p = table_one();
  State s = make_state({{0, 0, &geometry::shared_icosphere(42), Vec3::Zero(), 10}});
  EXPECT_FALSE(has_nuclei(s));
  EXPECT_EQ(s.n_row(), 42u);
  EXPECT_TRUE(make_lane_data(s, 0).nucleus.radius.empty());
  EXPECT_EQ(make_blocks(s, std::span(&p, 1))[0].pattern->n_point, 42);
}

// Half a ball of 12 um holds a ball of 6 um less what a mesh cuts off; a nucleus of half the
// daughter's radius is 4.8 um.
TEST(Nucleus, IsPlacedInsideWithItsLinksOutward) {
  const State s = make_state({{0,
                               0,
                               &geometry::shared_icosphere(162),
                               Vec3::Zero(),
                               12,
                               Vec3::Zero(),
                               Mat3::Identity(),
                               {&geometry::shared_icosphere(42), 0.5}}});
  std::vector<Vec3> node;
  copy_nodes(s, 0, node);
  auto random = reference::stream(5);
  const Mat3 q = reference::random_rotation(random);
  for (Vec3& x : node) x = q * Vec3(x.x(), x.y(), x.z() > 0 ? x.z() : 0.02 * x.z());
  const double radius = 0.5 * 12 / std::cbrt(2.0);
  const std::vector<Vec3> nucleus = place_nucleus(s.group[0], node, radius, 0.3);
  const geometry::AuditBody body(node, s.group[0].topology->triangle);
  for (const Vec3& x : nucleus) {
    EXPECT_EQ(body.locate(x), geometry::Location::kInside);
    EXPECT_GT(body.distance(x), 0.3);
  }
  EXPECT_NEAR(geometry::compute_volume(nucleus, geometry::shared_icosphere(42).triangle),
              4.0 / 3 * kPi * radius * radius * radius, 1e-9);
  // No link passes through the nucleus: its end is on the outer side of its own node.
  const auto& end = shared_link_ends(*s.group[0].topology, geometry::shared_icosphere(42));
  const Vec3 center = geometry::compute_centroid(nucleus, geometry::shared_icosphere(42).triangle);
  for (std::size_t i = 0; i < nucleus.size(); ++i)
    EXPECT_GT((node[static_cast<std::size_t>(end[i])] - nucleus[i]).dot(nucleus[i] - center), 0);
}

TEST(Nucleus, IsTurnedOnItsOwnSurface) {
  const State s = make_state({{0,
                               0,
                               &geometry::shared_icosphere(162),
                               Vec3::Zero(),
                               12,
                               Vec3::Zero(),
                               Mat3::Identity(),
                               {&geometry::shared_icosphere(162), 0.5}}});
  std::vector<Vec3> node, old;
  copy_nodes(s, 0, node);
  copy_nucleus(s, 0, old);
  const Mat3 q = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  for (Vec3& x : node) x = q * x;
  const std::vector<Vec3> turned = turn_nucleus(s.group[0], node, old);
  ASSERT_EQ(turned.size(), old.size());
  const geometry::AuditBody body(old, geometry::shared_icosphere(162).triangle);
  for (std::size_t i = 0; i < old.size(); ++i) {
    EXPECT_LT(body.distance(turned[i]), 1e-12);
    EXPECT_LT(turned[i].cross(node[i]).norm() / (turned[i].norm() * node[i].norm()), 1e-12);
  }
}

}  // namespace
}  // namespace acinus::dcm
