/// Values computed by hand on a regular tetrahedron of edge a: circumradius sqrt(3/8) a,
/// dihedral arccos(1/3), height sqrt(2/3) a, volume a^3/(6 sqrt 2).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "dcm/terms/body_load.hpp"
#include "dcm/terms/medium.hpp"
#include "tests/contact/reference_table.hpp"
#include "tests/dcm/cells.hpp"

namespace acinus::dcm {
namespace {

using reference::kEps;
using test::number, test::relative;

const geometry::Topology& tetrahedron() {
  static const geometry::Topology t =
      geometry::make_topology({{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                               {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}});
  return t;
}

/// Tetrahedron cell of radius 1 blown up by a factor; rest edge and circumradius.
struct BlownTetrahedron {
  Cells c = make_rest_cells(tetrahedron(), {1, 2});
  double edge = std::cbrt(4.0 / 3 * kPi * 6 * std::sqrt(2.0)), around = std::sqrt(3.0 / 8) * edge;
  explicit BlownTetrahedron(double factor) {
    for (int i = 0; i < 4; ++i) c.move(0, i, factor * c.node(0, i));
  }
  /// Outward force on every node must be the given number.
  void expect_outward(double expected) const {
    for (int i = 0; i < 4; ++i) {
      const Vec3 out = c.node(0, i).normalized();
      EXPECT_NEAR(c.force(0, i).dot(out), expected, 1e-13 * std::abs(expected));
      EXPECT_LT(c.force(0, i).cross(out).norm(), 1e-13 * std::abs(expected));
    }
  }
};

TEST(Topology, TetrahedronIsInflatedToTheUnitCell) {
  const BlownTetrahedron b(1);
  EXPECT_NEAR(tetrahedron().mean_rest_length, b.edge, 1e-14 * b.edge);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(b.c.node(1, i).norm(), 2 * b.around, 1e-14 * b.around);
}

// Three springs meet at a corner, each sqrt(2/3) along the axis: F = 3 sqrt(2/3) k (s - 1) a.
TEST(Cortex, ForceOfABlownTetrahedron) {
  BlownTetrahedron b(1.2);
  Params p = params_without_terms();
  p.spring_stiffness = 0.5;
  add_cortex(p, b.c.view(), b.c.system);
  b.expect_outward(-std::sqrt(6.0) * 0.5 * 0.2 * b.edge);
  EXPECT_NEAR(cortex_energy(p, b.c.view(), 0), 6 * 0.5 * 0.5 * std::pow(0.2 * b.edge, 2), 1e-12);
}

// dV/dx_i is a third of the opposite face: sqrt(3)/4 a^2 / 3.
TEST(Volume, ForceOfABlownTetrahedron) {
  BlownTetrahedron b(1.1);
  Params p = params_without_terms();
  p.bulk_modulus = 2.5;
  add_volume(p, b.c.view(), b.c.system, b.c.system.rank_one[0]);
  const double edge = 1.1 * b.edge, pressure = -2.5 * 3 * std::log(1.1);
  b.expect_outward(pressure * std::sqrt(3.0) / 12 * edge * edge);
  EXPECT_NEAR(compute_volumes(b.c.view())[0], 4.0 / 3 * kPi * 1.331, 1e-13);
  EXPECT_NEAR(b.c.system.rank_one[0].coefficient[0], 2.5 / (4.0 / 3 * kPi * 1.331), 1e-13);
}

// x . dA/dx summed over nodes is 2 A: outward dA/dx = 2 A / (4 circumradius).
TEST(Area, ForceOfABlownTetrahedron) {
  const double s = 1.1;
  Params p = params_without_terms();
  p.area_modulus = p.local_area_modulus = 0.8;
  BlownTetrahedron global(s), local(s);
  add_area(p, global.c.view(), global.c.system, global.c.system.rank_one[1]);
  add_local_area(p, local.c.view(), local.c.system);
  const double area = std::sqrt(3.0) * std::pow(s * global.edge, 2);
  const double expected = -0.8 * (s * s - 1) * 2 * area / (4 * s * global.around);
  global.expect_outward(expected);
  local.expect_outward(expected);  // equal triangles: the same thing
}

// The corner of a cube: three right angles and three of arccos(1/sqrt 3) inside, against
// arccos(1/3); the three are folds, beyond a half of cosine.
TEST(Bending, EnergyOfACubeCorner) {
  BlownTetrahedron b(1);
  const Vec3 corner[4] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  for (int i = 0; i < 4; ++i) b.c.move(0, i, corner[i]);
  ASSERT_GT(compute_volumes(b.c.view())[0], 0) << "corners must be in outward order";
  Params p = params_without_terms();
  p.bending_stiffness = 0.02;
  const double root = std::sqrt(3.0), fold = (1 / root - 0.5) / (1 - 1 / root);
  const double expected = 3 * 0.02 * (2 - std::sqrt(8.0) / 3 - 5 / (3 * root) + fold * fold);
  EXPECT_NEAR(bending_energy(p, b.c.view(), 0), expected, 1e-13 * expected);
}

// A corner turned about one edge by a small angle strains that hinge by the angle and its
// neighbours by less than twice that; the hinge's own restoring force is k_b angle / height,
// outward again.
TEST(Bending, PushedInCornerIsPushedOut) {
  const geometry::Topology& t = geometry::shared_icosphere(42);
  Cells c = make_rest_cells(t, {10});
  const auto& h = t.hinge[7];
  const Vec3 x3 = c.node(0, h[2]), x4 = c.node(0, h[3]), x1 = c.node(0, h[0]);
  const Vec3 e = (x4 - x3).normalized(), arm = (x1 - x3) - (x1 - x3).dot(e) * e;
  const double angle = 1e-3;  // turned about the edge, towards the inside
  const Vec3 n = c.node(0, h[2]).normalized();
  Vec3 turned = Eigen::AngleAxisd(angle, e) * arm;
  if (turned.dot(n) > arm.dot(n)) turned = Eigen::AngleAxisd(-angle, e) * arm;
  c.move(0, h[0], x1 - arm + turned);
  Params p = params_without_terms();
  p.bending_stiffness = 0.0139;
  const double own = p.bending_stiffness * (1 - std::cos(angle));
  double hinges = 0;
  for (const auto& k : t.hinge)
    hinges += k[0] == h[0] || k[1] == h[0] || k[2] == h[0] || k[3] == h[0] ? 1 : 0;
  const double energy = bending_energy(p, c.view(), 0);
  EXPECT_GT(energy, own);
  EXPECT_LT(energy, own * hinges * 4);
  add_bending(p, c.view(), c.system);
  EXPECT_GT(c.force(0, h[0]).dot(n), 0.5 * p.bending_stiffness * angle / arm.norm());
}

TEST(Cortex, IsotropicDashpotsResistAllRelativeMotion) {
  BlownTetrahedron b(1);
  Params p = params_without_terms();
  p.nodal_friction = 0.1;
  b.c.system.friction_scale = 0.25;
  add_cortex(p, b.c.view(), b.c.system);
  const auto k = lane_matrices(b.c)[0];
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const double expected = i % 3 != j % 3 ? 0 : 0.1 * 0.25 * (i == j ? 3 : -1);
      EXPECT_NEAR(k(i, j), expected, 1e-7 * std::abs(expected));  // the coefficient is a float
    }
  for (int i = 0; i < 4; ++i) EXPECT_EQ(b.c.force(0, i).norm(), 0);
}

TEST(Cortex, AxialDashpotsResistStretchOnly) {
  BlownTetrahedron b(1);
  Params p = params_without_terms();
  p.nodal_friction = 0.1;
  p.friction_across = 0;
  add_cortex(p, b.c.view(), b.c.system);
  const auto k = lane_matrices(b.c)[0];
  const Vec3 u = (b.c.node(0, 1) - b.c.node(0, 0)).normalized();
  const Mat3 expected = -0.1 * u * u.transpose();
  EXPECT_LT((k.block<3, 3>(0, 3) - expected).norm(), 0.1 * 2e-7);  // a u u^T of floats
}

TEST(Cortex, FrictionAcrossAnEdgeIsAShareOfThatAlongIt) {
  BlownTetrahedron b(1);
  Params p = params_without_terms();
  p.nodal_friction = 0.1;
  p.friction_across = 0.3;
  add_cortex(p, b.c.view(), b.c.system);
  const auto k = lane_matrices(b.c)[0];
  const Vec3 u = (b.c.node(0, 1) - b.c.node(0, 0)).normalized();
  const Mat3 along = u * u.transpose();
  const Mat3 expected = -0.1 * (along + 0.3 * (Mat3::Identity() - along));
  EXPECT_LT((k.block<3, 3>(0, 3) - expected).norm(), 0.1 * 2e-7);
}

// Rotational drag 4.1e-13 N m s of a free cell (R 12 um, nodes on the sphere, 1e-4 N s/m): what
// makes isotropic dashpots not objective.
TEST(Cortex, OnlyIsotropicDashpotsResistRigidRotation) {
  const double radius = 12 / 1.01153;
  for (bool is_axial : {false, true}) {
    Cells c = make_rest_cells(geometry::shared_icosphere(162), {radius});
    Params p = params_without_terms();
    p.nodal_friction = 0.1;
    p.friction_across = is_axial ? 0 : 1;
    add_cortex(p, c.view(), c.system);
    solve::Operator op;
    op.prepare(c.system);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> v(c.system.n_dof()), f(v.size());
      for (int i = 0; i < c.n_node(); ++i)
        store_point(v.data(), make_address(i, 0), Vec3::Unit(axis).cross(c.node(0, i)));
      op.apply(v, f);
      const double drag = op.dot(v, f);  // nN um s
      if (is_axial)
        EXPECT_LT(std::abs(drag), 1e-12 * 410);
      else
        EXPECT_NEAR(drag, 410, 10);
      std::printf("rotational drag, %s: %.4g nN um s\n", is_axial ? "axial" : "isotropic", drag);
    }
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> v(c.system.n_dof()), f(v.size());
      for (int i = 0; i < c.n_node(); ++i)
        store_point(v.data(), make_address(i, 0), Vec3::Unit(axis));
      op.apply(v, f);
      EXPECT_LT(std::abs(op.dot(v, f)), 1e-12);
    }
  }
}

TEST(Volume, PressureMatchesReference) {
  const auto rows = test::read_reference("volume_pressure.csv");
  double worst = 0;
  for (const auto& row : rows)
    for (const auto& [modulus, column] : {std::pair(2.5, 1u), std::pair(0.75, 3u)}) {
      const double ratio = number(row, 0), expected = number(row, column) * test::kPascal;
      Cells c = make_rest_cells(geometry::shared_icosphere(162), {12});
      for (int i = 0; i < c.n_node(); ++i) c.move(0, i, std::cbrt(ratio) * c.node(0, i));
      Params p = params_without_terms();
      p.bulk_modulus = modulus;
      add_volume(p, c.view(), c.system, c.system.rank_one[0]);
      double virial = 0;  // sum f . x = 3 p V
      for (int i = 0; i < c.n_node(); ++i) virial += c.force(0, i).dot(c.node(0, i));
      const double pressure = virial / (3 * ratio * 4.0 / 3 * kPi * 1728);
      const double error =
          std::abs(pressure - expected) / (modulus * std::max(0.01, std::abs(ratio - 1)));
      worst = std::max(
          {worst, error, std::abs(cytosol_pressure(modulus, ratio, 1) - expected) / modulus});
    }
  std::printf("volume_pressure: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);
}

TEST(Volume, CollapsedOrInvertedCellsGiveFiniteNumbers) {
  for (double size : {0.05, 1e-3, 0.0, -0.01, -1.0}) {
    Cells c = make_rest_cells(geometry::shared_icosphere(42), {12, 12});
    for (int i = 0; i < c.n_node(); ++i) c.move(0, i, size * c.node(0, i));
    Params p = params_without_terms();
    p.bulk_modulus = 2.5;
    add_volume(p, c.view(), c.system, c.system.rank_one[0]);
    for (int i = 0; i < c.n_node(); ++i) ASSERT_TRUE(c.force(0, i).allFinite()) << size;
    ASSERT_TRUE(std::isfinite(c.system.rank_one[0].coefficient[0])) << size;
    ASSERT_GT(c.system.rank_one[0].coefficient[0], 0) << size;
    ASSERT_TRUE(std::isfinite(volume_energy(p, c.view(), 0))) << size;
    // The pressure stops rising at V0 / 1000, and the energy agrees.
    const double volume = 4.0 / 3 * kPi * 1728 * size * size * size;
    if (volume == 0) continue;
    double virial = 0;
    for (int i = 0; i < c.n_node(); ++i) virial += c.force(0, i).dot(c.node(0, i));
    EXPECT_NEAR(virial / (3 * volume), 2.5 * std::log(1e3), 1e-9) << size;
    const double before = volume_energy(p, c.view(), 0);
    for (int i = 0; i < c.n_node(); ++i) c.move(0, i, 1.001 * c.node(0, i));
    EXPECT_NEAR((volume_energy(p, c.view(), 0) - before) / (0.001 * virial), -1, 0.0011) << size;
  }
}

TEST(Params, CortexConstantsMatchReference) {
  const auto rows = test::read_reference("cortex_ks_kb.csv");
  double worst = 0;
  for (const auto& row : rows) {
    const double young = number(row, 0) * test::kPascal, thickness = number(row, 1) * test::kMetre;
    worst =
        std::max({worst, relative(cortex_spring_stiffness(young, thickness), number(row, 3) * 1e3),
                  relative(cortex_bending_stiffness(young, thickness, number(row, 2)),
                           number(row, 5) * 1e15)});
  }
  std::printf("cortex_ks_kb: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);
  EXPECT_NEAR(cortex_spring_stiffness(1, 0.5), 0.4330127, 1e-7);
}

TEST(Medium, StokesDragMatchesReference) {
  const auto rows = test::read_reference("stokes.csv");
  double worst = 0;
  for (const auto& row : rows) {
    const int n = std::stoi(row[0]);
    const double radius = number(row, 1) * test::kMetre;
    const double viscosity = number(row, 2) * 1e-3;  // Pa s -> nN s/um^2
    const geometry::Topology& t = geometry::shared_icosphere(n);
    Cells c = make_rest_cells(t, {radius, 2 * radius});
    Params p = params_without_terms();
    p.viscosity = viscosity;
    p.medium_friction = 1e9;  // must not matter
    std::vector<double> free_area(c.state.n_row() * kLanes, 0.0);
    for (int i = 0; i < n; ++i)
      free_area[static_cast<std::size_t>(i) * kLanes] = t.rest_node_area[i] * radius * radius;
    c.system.friction_scale = 1.0 / 60;
    add_medium(p, c.view(), free_area.data(), c.system);
    solve::Operator op;
    op.prepare(c.system);
    const std::vector<double> one(c.system.n_dof(), 1.0);
    std::vector<double> drag(one.size());
    op.apply(one, drag);
    double total = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(n); ++i) {
      total += c.system.medium[i * kLanes];
      EXPECT_EQ(c.system.medium[i * kLanes + 1], 0);  // touches everywhere: no free area
      EXPECT_EQ(c.system.medium[i * kLanes + 5], 1);  // empty lane
      for (std::size_t k : {0, kLanes, 2 * kLanes})
        EXPECT_DOUBLE_EQ(drag[i * kPointStride + k], c.system.medium[i * kLanes] / 60);
      // A node's drag is its share of the surface.
      EXPECT_NEAR(c.system.medium[i * kLanes],
                  number(row, 3) * 1e3 * t.rest_node_area[i] / t.rest_area,
                  1e-9 * number(row, 4) * 1e3);
    }
    worst = std::max(
        {worst, relative(total, number(row, 3) * 1e3), relative(total / n, number(row, 4) * 1e3)});
    // 500 N s/m^3 per surface area instead, on the smooth sphere's area in the table.
    p.viscosity = 0;
    p.medium_friction = 500e-9;
    EXPECT_EQ(medium_friction_per_area(p, radius, t.rest_area), 500e-9);
    worst = std::max(worst, relative(500e-9 * 4 * kPi * radius * radius, number(row, 6) * 1e3));
  }
  std::printf("stokes: %zu rows, worst %.1e\n", rows.size(), worst);
  EXPECT_LT(worst, 1e-9);
}

TEST(BodyLoad, MovesTheCellWithoutDistortion) {
  Cells c = make_deformed_cells();
  std::vector<Vec3> force(kLanes);
  for (int l = 0; l < kLanes; ++l) force[l] = Vec3(1, -l, 0.5 * l);
  add_body_load(c.view(), force, c.system);
  const geometry::Topology& t = *c.state.group[0].topology;
  for (std::size_t l = 0; l < kLanes; ++l) {
    Vec3 total = Vec3::Zero();
    for (int i = 0; i < c.n_node(); ++i) {
      const Vec3 f = load_point(c.system.external_force.data(), node_address(c.state, l, i));
      // Friction is per rest area too, so every node gets the same speed.
      const Vec3 speed = f / t.rest_node_area[i] * t.rest_area;
      EXPECT_LT((speed - (l == kNoCell ? Vec3::Zero() : Vec3(force[l]))).norm(), 64 * kEps * 10);
      total += f;
    }
    EXPECT_LT((total - (l == kNoCell ? Vec3::Zero() : Vec3(force[l]))).norm(), 256 * kEps * 10);
  }
}

}  // namespace
}  // namespace acinus::dcm
