/// Active tension of the cortex. It pulls at rest, so it is not among the terms of terms_test.cpp.

#include "dcm/terms/cortex_tension.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "dcm/loads/stress.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;

Params contractile() {
  Params p = params_without_terms();
  p.cortex_tension = 0.3;
  return p;
}

void add(Cells& c) { add_cortex_tension(contractile(), c.view(), c.system); }

// E = T A, and the pressure that balances it by virtual work of swelling, sum f . x = -3 p V, is
// 2 T A / (3 V): 2 T / R, but for the facets, whose A / V is larger than that of the sphere.
TEST(CortexTension, GivesTheCellLaplacesPressure) {
  for (const int nodes : {162, 642, 2562}) {
    Cells c = make_rest_cells(geometry::shared_icosphere(nodes), {12});
    add(c);
    double virial = 0, area = 0;
    for (const double a : c.state.group[0].topology->rest_triangle_area) area += 144 * a;
    for (int i = 0; i < nodes; ++i) virial += c.force(0, i).dot(c.node(0, i));
    EXPECT_NEAR(cortex_tension_energy(contractile(), c.view(), 0), 0.3 * area, 1e-12 * area);
    const double pressure = -virial / (3 * compute_volumes(c.view())[0]);
    std::printf("%4d nodes: pressure over 2 T / R is 1 + %.1e\n", nodes,
                pressure / (2 * 0.3 / 12) - 1);
    // Facets stand off the sphere by l^2 / R^2 of order 14 / nodes, with a prefactor below 1/5.
    EXPECT_NEAR(pressure / (2 * 0.3 / 12), 1, 3.0 / nodes);
  }
}

TEST(CortexTension, IsTheTensionOfTheNodes) {
  const Cells c = make_deformed_cells();
  for (const double t : compute_node_tension(contractile(), c.view(), 2)) EXPECT_EQ(t, 0.3);
}

TEST(CortexTension, ForceIsMinusEnergyGradient) {
  Cells c = make_deformed_cells(42);
  add(c);
  for (std::size_t l = 0; l < kLanes; ++l) {
    if (l == kNoCell) continue;
    const auto energy = [&] {
      return cortex_tension_energy(contractile(), c.view(), static_cast<int>(l));
    };
    EXPECT_LT(worst_slope_error(c, l, energy), 1e-6 * c.largest_force(l));
  }
}

TEST(CortexTension, NetForceAndTorqueVanish) {
  Cells c = make_deformed_cells();
  add(c);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const reference::NetForce net = c.net_force(l);
    EXPECT_LE(net.force.norm(), 64 * kEps * net.force_sizes);
    EXPECT_LE(net.torque.norm(), 64 * kEps * net.torque_sizes);
    EXPECT_EQ(net.force_sizes > 0, l != kNoCell) << "an empty lane gets nothing";
  }
}

TEST(CortexTension, TurnsWithTheCell) {
  Cells c = make_deformed_cells(), turned = c;
  auto random = reference::stream(2);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 20);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) turned.move(l, i, q * c.node(l, i) + shift);
  add(c);
  add(turned);
  // As for the other terms (terms_test.cpp).
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i)
      EXPECT_LE((turned.force(l, i) - q * c.force(l, i)).norm(), 1e4 * kEps * c.largest_force(l));
}

/// Ring of three times the tension about an axis askew.
Params ringed() {
  Params p = contractile();
  p.ring = ContractileRing{};
  p.ring->excess = 2;
  p.ring->width = 0.3;
  p.ring->axis = {1, 2, -2};
  return p;
}

// On the equator 1 + ring, at the poles of a narrow band 1; exp(-1/2) one width off the equator.
TEST(ContractileRing, IsAGaussianOfTheCosine) {
  ContractileRing c;
  c.excess = 2;
  c.width = 0.25;
  EXPECT_EQ(ring_factor(c, 0), 3);
  EXPECT_NEAR(ring_factor(c, 0.25), 1 + 2 * std::exp(-0.5), 4 * kEps);
  EXPECT_NEAR(ring_factor(c, -1), 1 + 2 * std::exp(-8.0), 4 * kEps);
}

// A ring of no width beyond the mesh pulls at the equator only; one far wider than the cell is the
// same as three times the tension, but for exp(-1 / (2 width^2)) = 1 - 5e-7.
TEST(ContractileRing, WideIsUniform) {
  Cells ring = make_deformed_cells(), uniform = ring;
  Params p = ringed(), q = contractile();
  p.ring->width = 1000;
  q.cortex_tension *= 3;
  add_cortex_tension(p, ring.view(), ring.system);
  add_cortex_tension(q, uniform.view(), uniform.system);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < ring.n_node(); ++i)
      EXPECT_LE((ring.force(l, i) - uniform.force(l, i)).norm(), 1e-5 * uniform.largest_force(l));
}

TEST(ContractileRing, NetForceAndTorqueVanish) {
  Cells c = make_deformed_cells();
  add_cortex_tension(ringed(), c.view(), c.system);
  for (std::size_t l = 0; l < kLanes; ++l) {
    const reference::NetForce net = c.net_force(l);
    EXPECT_LE(net.force.norm(), 64 * kEps * net.force_sizes);
    EXPECT_LE(net.torque.norm(), 64 * kEps * net.torque_sizes);
  }
}

// Cell and axis turned and shifted together: as without a ring, and three digits more are lost in
// the cosines of places that are 20 um from the origin.
TEST(ContractileRing, TurnsWithCellAndAxis) {
  Cells c = make_deformed_cells(), turned = c;
  auto random = reference::stream(2);
  const Mat3 q = reference::random_rotation(random);
  const Vec3 shift = reference::random_vector(random, 20);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i) turned.move(l, i, q * c.node(l, i) + shift);
  const Params p = ringed();
  Params r = p;
  r.ring->axis = q * p.ring->axis;
  add_cortex_tension(p, c.view(), c.system);
  add_cortex_tension(r, turned.view(), turned.system);
  for (std::size_t l = 0; l < kLanes; ++l)
    for (int i = 0; i < c.n_node(); ++i)
      EXPECT_LE((turned.force(l, i) - q * c.force(l, i)).norm(), 1e5 * kEps * c.largest_force(l));
}

// At constant factors the force is the gradient of sum T_f A_f: of each triangle alone, here by the
// work of a small move, which changes the factors' sum by what they themselves change.
TEST(ContractileRing, DoesTheWorkOfItsTensions) {
  const Params p = ringed();
  Cells c = make_rest_cells(geometry::shared_icosphere(162), {10});
  add_cortex_tension(p, c.view(), c.system);
  // Uniform swelling keeps all angles and so all factors: dE/dR = 2 E / R, and E is quadratic.
  double virial = 0;
  for (int i = 0; i < c.n_node(); ++i) virial += c.force(0, i).dot(c.node(0, i));
  const double energy = cortex_tension_energy(p, c.view(), 0);
  EXPECT_NEAR(-virial, 2 * energy, 1e-12 * energy);
  EXPECT_GT(energy, cortex_tension_energy(contractile(), c.view(), 0));
}

TEST(ContractileRing, IsTheTensionOfTheNodes) {
  const Cells c = make_rest_cells(geometry::shared_icosphere(162), {10});
  const Params p = ringed();
  const auto tension = compute_node_tension(p, c.view(), 0);
  const Vec3 axis = p.ring->axis.normalized();
  for (int i = 0; i < c.n_node(); ++i) {
    const Vec3& x = c.state.group[0].topology->rest[i];
    // Springs at rest pull by rounding only.
    EXPECT_NEAR(tension[i], 0.3 * ring_factor(*p.ring, axis.dot(x) / x.norm()), 1e-12);
  }
}

TEST(CortexTension, StiffnessIsSymmetricAndSemiDefinite) {
  for (const Params& p : {contractile(), ringed()}) {
    Cells c = make_deformed_cells();
    add_cortex_tension(p, c.view(), c.system);
    const Eigen::MatrixXd k = lane_matrices(c)[6];
    const double scale = k.cwiseAbs().maxCoeff();
    EXPECT_GT(scale, 0);
    EXPECT_LT((k - k.transpose()).cwiseAbs().maxCoeff(), 16 * kEps * scale);
    const Eigen::VectorXd values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
    EXPECT_GE(values.minCoeff(), -1e-12 * values.maxCoeff());
  }
}

}  // namespace
}  // namespace acinus::dcm
