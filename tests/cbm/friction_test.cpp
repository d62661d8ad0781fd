/// Friction of spheres with each other and with the medium.

#include "cbm/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/jkr.hpp"
#include "solve/operator.hpp"
#include "tests/cbm/spheres.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::cbm {
namespace {

TEST(SpherePairs, FrictionOfTwoTypesIsTheGeometricMean) {
  std::vector<NewCell> cells{sphere({0, 0, 0}), sphere({20, 0, 0}), sphere({40, 0, 0})};
  cells[2].type = 1;
  Spheres s(cells);
  s.params.push_back(s.params[0]);
  s.params[1].cell_friction = 40;
  s.find();
  ASSERT_EQ(s.sphere().size(), 2u);
  EXPECT_FLOAT_EQ(s.sphere()[0].friction, static_cast<float>(10 * s.sphere()[0].touching));
  EXPECT_FLOAT_EQ(s.sphere()[1].friction, static_cast<float>(20 * s.sphere()[1].touching));
  s.options.friction_factor = 0;
  s.find();
  for (const contact::Contact& c : s.sphere()) EXPECT_EQ(c.friction, 0);
}

TEST(MediumFriction, ActsOnWhatTouchesNothing) {
  Spheres s = random_spheres(20, 11, 20);
  s.find();
  solve::System system;
  solve::set_blocks(system, blocks_of(s.state));
  system.friction_scale = 0.1;
  std::vector<Vec3> pull(11, Vec3(0, 0, 0.3));
  const std::vector<double> radius = s.radius();
  add_cell_loads({s.state, s.params, s.options, {radius}, s.boundary}, s.work, pull, system);
  solve::Operator op;
  op.prepare(system);
  const std::vector<double> one(system.n_dof(), 1.0);
  std::vector<double> drag(one.size());
  op.apply(one, drag);
  std::vector<double> area(11);
  for (const contact::Contact& c : s.sphere())
    for (int k : {c.a, c.b}) area[k] += c.touching;
  const auto r = s.radius();
  for (std::size_t i = 0; i < 16; ++i) {
    const double medium = system.medium[i / kLanes * kLanes + i % kLanes];
    for (Address c = 0; c < 3; ++c)
      EXPECT_DOUBLE_EQ(drag[cell_address(0, i) + c * kLanes], 0.1 * medium);
    if (i >= 11) {
      EXPECT_EQ(medium, 1);  // an empty lane keeps the matrix regular
      continue;
    }
    const double surface = 4 * kPi * r[i] * r[i];
    EXPECT_NEAR(s.work.contact_area[i], area[i], 1e-12 * surface);
    EXPECT_NEAR(medium / 0.5 + std::min(area[i], surface), surface, 1e-12 * surface);
    EXPECT_EQ(load_point(system.external_force.data(), cell_address(0, i)), pull[i]);
  }
  EXPECT_NEAR(medium_friction(s.params[0], 12, 1e9), 0.01 * medium_friction(s.params[0], 12, 0),
              1e-12)
      << "never without friction";
  Params liquid;
  liquid.viscosity = 1e-6;
  EXPECT_NEAR(medium_friction(liquid, 12, 0), 6 * kPi * 1e-6 * 12, 1e-18);
  EXPECT_NEAR(medium_friction(liquid, 12, 2 * kPi * 144), 3 * kPi * 1e-6 * 12, 1e-18);
}

// Whole-cell figures of Table 1: 0.905 N s/m of a cell in the matrix.
TEST(MediumFriction, OfALoneCellInTheMatrix) {
  Params p;
  p.medium_friction = 0.5;
  EXPECT_NEAR(medium_friction(p, 12, 0), 905, 1);  // nN s/um
}

TEST(MediumFriction, OnTheWholeSurfaceDoesNotMindNeighbours) {
  Params p;
  p.medium_friction = 0.5;
  p.whole_medium_area = true;
  EXPECT_EQ(medium_friction(p, 12, 1500), medium_friction(p, 12, 0));
}

}  // namespace
}  // namespace acinus::cbm
