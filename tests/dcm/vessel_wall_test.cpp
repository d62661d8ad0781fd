/// Vessel walls that yield under deformable cells.

#include "dcm/contact/vessel_wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "contact/cohesive.hpp"
#include "dcm/contact/contact_bodies.hpp"
#include "dcm/contact/contact_points.hpp"
#include "tests/dcm/bounded_clump.hpp"

namespace acinus::dcm {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

contact::Material wall(double young) { return {0, young, 0.4, false}; }

/// One cell of 162 nodes whose lowest point stands about `depth` deep in a horizontal vessel.
Clump cell_on_vessel(double young, double depth, double adhesion = 0) {
  Clump c;
  c.add_cells({new_cell(0, Vec3(0, 0, 12 + 4.7 - depth), 12, Mat3::Identity())});
  geometry::Network n;
  n.node = {{-30, 0, 0}, {1, 0, 0}, {30, 0, 0}};
  n.segment = {{0, 1}, {1, 2}};
  n.radius = {{4.7, 4.7}, {4.7, 4.7}};
  contact::set_network(c.boundary.vessels, n);
  c.boundary.vessels.material = wall(young);
  c.boundary.vessels.material.adhesion = adhesion;
  c.find();
  return c;
}

double lift(const Clump& c) {
  double sum = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) sum += c.force(l).z();
  return sum;
}

TEST(VesselWall, StiffnessHasTheHandComputedValue) {
  // E* = 0.6 / 0.84 kPa, d = 0.188 / 4.7 = 0.04: k_w = 4 E* / (3 pi 4.7 0.2) = 0.322502 kPa/um.
  const double winkler = 4 * 0.6 / 0.84 / (3 * kPi * 4.7 * 0.2);
  EXPECT_NEAR(winkler, 0.322502, 1e-6);
  EXPECT_NEAR(wall_stiffness(5, wall(0.6), 4.7, 0.188), 5 * winkler / (5 + winkler), 1e-14);
}

TEST(VesselWall, LimitsOfTheStiffness) {
  EXPECT_EQ(wall_stiffness(5, wall(kInfinite), 4.7, 0.3), 5) << "to the bit";
  EXPECT_NEAR(wall_stiffness(5, wall(1e12), 4.7, 0.3), 5, 1e-9);
  const double soft = wall_stiffness(5, wall(1e-9), 4.7, 0.3);
  EXPECT_NEAR(wall_stiffness(5, wall(2e-9), 4.7, 0.3) / soft, 2, 1e-8) << "the wall alone";
  EXPECT_EQ(wall_stiffness(5, wall(0.6), 4.7, 0), wall_stiffness(5, wall(0.6), 4.7, 0.047));
  EXPECT_EQ(wall_stiffness(5, wall(0.6), 4.7, 2), wall_stiffness(5, wall(0.6), 4.7, 0.15 * 4.7));
  EXPECT_GT(wall_stiffness(5, wall(0.6), 4.7, 0.1), wall_stiffness(5, wall(0.6), 4.7, 0.2));
}

TEST(VesselWall, MatrixIsOnceToTwiceAsStiffAsTheContact) {
  const double h = 1e-6;
  for (double g = 0.01; g < 1; g += 0.0137) {
    const auto pressure = [](double x) { return wall_stiffness(5, wall(0.6), 4.7, x) * x; };
    const double slope = (pressure(g + h) - pressure(g - h)) / (2 * h),
                 frozen = wall_stiffness(5, wall(0.6), 4.7, g);
    EXPECT_LE(slope, frozen * (1 + 1e-8)) << g;
    EXPECT_GE(slope, 0.5 * frozen) << g;
  }
}

TEST(VesselWall, ForceIsThatOfTheBedUnderEveryPoint) {
  const Clump c = cell_on_vessel(0.6, 0.4);
  ASSERT_EQ(c.links.size(), c.obstacle().size());
  std::vector<double> deepest(2, 0.0);
  for (const contact::Contact& o : c.obstacle()) deepest[o.b] = std::max(deepest[o.b], -o.gap);
  EXPECT_GT(std::max(deepest[0], deepest[1]), 0.1);
  int pressed = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const contact::Contact& o = c.obstacle()[l];
    const double k = wall_stiffness(5, wall(0.6), 4.7, deepest[o.b]);
    if (o.only_pushes()) continue;
    EXPECT_EQ(o.stiffness(), k);
    if (o.gap >= 0) continue;
    const double area =
        point_area(geometry::shared_icosphere(162), c.options.quadrature, o.point, 12);
    EXPECT_NEAR(o.force, -area * k * o.gap, 1e-13 * area * k);
    EXPECT_NEAR(c.links.link[l].stiffness, area * k, 1e-6 * area * k);  // kept in floats
    ++pressed;
  }
  EXPECT_GT(pressed, 5);
}

// At the stiffness of the start of the step, with adhesion: -F . dx = E(x + dx) - E(x - dx).
void expect_energy_gradient(double deepest) {
  Clump c = cell_on_vessel(0.6, deepest, 0.01);
  const contact::Contacts start = c.contacts.all;
  const solve::Links links = c.links;
  const geometry::Topology& t = geometry::shared_icosphere(162);
  const auto energy = [&](std::size_t l) {
    const contact::Contact& o = start[l];
    const Vec3 x =
        contact::point_position(c.work.body[0], stencil_of(c.options, c.work.body[0], o));
    const double gap = contact::gap_to_segment(c.boundary.vessels.network, o.b, x).gap;
    if (o.only_pushes()) {
      const double depth = std::max(0.0, -gap - o.onset());
      const double area =
          o.guard ? guard_area(t, o.point, 12) : point_area(t, c.options.quadrature, o.point, 12);
      return area * 0.5 * o.stiffness() * depth * depth;
    }
    return point_area(t, c.options.quadrature, o.point, 12) *
           contact::cohesive_energy({0.01, o.stiffness(), 0.3 * t.mean_rest_length * 12}, gap);
  };
  auto random = reference::stream(3);
  std::vector<double> direction(c.state.position.size());
  for (double& d : direction) d = random.uniform(-1, 1);
  const double h = 1e-5;
  std::vector<double> more, less;
  c.shift(direction, h);
  refresh_bodies(c.state, c.work);
  for (std::size_t l = 0; l < start.size(); ++l) more.push_back(energy(l));
  c.shift(direction, -2 * h);
  refresh_bodies(c.state, c.work);
  for (std::size_t l = 0; l < start.size(); ++l) less.push_back(energy(l));
  double scale = 0, worst = 0;
  for (std::size_t l = 0; l < start.size(); ++l) {
    const solve::Stencil stencil = solve::stencil_of(links.link[l]);
    double work = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(stencil.n); ++k)
      work += stencil.weight[k] * start[l].force *
              start[l].normal.dot(load_point(direction.data(), stencil.address[k]));
    scale = std::max(scale, std::abs(start[l].force));
    worst = std::max(worst, std::abs(work + (more[l] - less[l]) / (2 * h)));
  }
  EXPECT_GT(scale, 0.1);
  // h^2 times the third derivative, some 1/um^2, and kEps E / h; weights are floats.
  EXPECT_LT(worst, 1e-6 * scale);
}

TEST(VesselWall, ForceIsMinusEnergyGradientAtFrozenStiffness) {
  expect_energy_gradient(0.3);
  expect_energy_gradient(1.2);  // deeper than the wall yields
}

TEST(VesselWall, YieldsBy15PercentOfItsRadiusAndNoMore) {
  const double limit = 0.15 * 4.7;
  EXPECT_EQ(contact::yield_limit(wall(0.6), 4.7), limit);
  EXPECT_EQ(contact::yield_limit(wall(kInfinite), 4.7), 0);
  const Clump c = cell_on_vessel(0.6, 1.2);
  int stops = 0;
  for (std::size_t l = 0; l < c.links.size(); ++l) {
    const contact::Contact& o = c.obstacle()[l];
    if (o.guard || o.onset() == 0) continue;
    ++stops;
    const double area =
        point_area(geometry::shared_icosphere(162), c.options.quadrature, o.point, 12);
    const double beyond = std::max(0.0, -o.gap - limit);
    EXPECT_NEAR(o.stiffness() + wall_stiffness(5, wall(0.6), 4.7, 1.2), 5, 1e-12);
    EXPECT_NEAR(o.force, area * o.stiffness() * beyond, 1e-12 * area * 5);
    EXPECT_EQ(c.links.link[l].friction, 0);
  }
  EXPECT_GT(stops, 0);
  // Half a micrometre more beyond the limit takes what k_rep gives, up to it what the bed gives.
  const double soft = lift(cell_on_vessel(0.6, 0.6)) - lift(cell_on_vessel(0.6, 0.5)),
               hard = lift(cell_on_vessel(0.6, 1.3)) - lift(cell_on_vessel(0.6, 1.2));
  EXPECT_GT(hard, 5 * soft);
}

TEST(VesselWall, ARigidOneIsTheLawWithoutAWall) {
  const Clump rigid = cell_on_vessel(kInfinite, 0.4), stiff = cell_on_vessel(1e9, 0.4);
  for (std::size_t l = 0; l < rigid.links.size(); ++l)
    EXPECT_EQ(rigid.obstacle()[l].stiffness(), rigid.options.repulsion);
  EXPECT_NEAR(lift(stiff) / lift(rigid), 1, 1e-6);
}

TEST(VesselWall, SofterOnesPushLessAtTheSameDepth) {
  double before = 1e300;
  for (const double young : {kInfinite, 60.0, 6.0, 0.6, 0.06}) {
    const double now = lift(cell_on_vessel(young, 0.4));
    EXPECT_GT(now, 0);
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(VesselWall, PullsAsARigidOne) {
  // Nothing is pressed: all points stand off within the range of adhesion.
  const Clump soft = cell_on_vessel(0.6, -0.2, 0.01), rigid = cell_on_vessel(kInfinite, -0.2, 0.01);
  EXPECT_LT(lift(rigid), 0);
  EXPECT_EQ(lift(soft), lift(rigid));
}

}  // namespace
}  // namespace acinus::dcm
