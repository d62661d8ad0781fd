/// Spheres with a law beside vessels and mirror walls.

#include "cbm/vessel_stiffness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cbm/contact.hpp"
#include "contact/hertz.hpp"
#include "contact/jkr.hpp"
#include "tests/cbm/spheres.hpp"

namespace acinus::cbm {
namespace {

/// Sphere with a law of one knot above zero beside a straight vessel along z.
Spheres beside_vessel(double gap, double young_of_wall) {
  Spheres s({sphere({4.7 + gap, 0, 0}, 12, 0.05)});
  s.params[0].poisson = 0.47;
  s.params[0].correction = {{}, {{0.05, 0}, {0.15, 2}, {0.2, 5}}, 0.2, 0.2};
  contact::Vessels& v = s.boundary.vessels;
  v.network.node = {{0, 0, -60}, {0, 0, 60}};
  v.network.segment = {{0, 1}};
  v.network.radius = {{4.7, 4.7}};
  contact::set_network(v, v.network);
  v.material.young = young_of_wall;
  v.material.poisson = 0.4;
  return s;
}

TEST(Vessels, StiffenASphereThatIsPressedInDeeperThanItsLawWasFittedFor) {
  const auto force = [](double gap) {
    Spheres s = beside_vessel(gap, 0.6);
    s.find();
    EXPECT_EQ(s.obstacle().size(), 1u);
    return s.obstacle()[0];
  };
  // At 3 um the overlap is 0.18 of both radii, within the range 0.2: as soft as ever.
  const contact::Contact soft = force(9);
  const double softness = (1 - 0.47 * 0.47) / 0.05, yield = 0.15 * 4.7;
  const double share_of_wall = (0.84 / 0.6) / (softness + 0.84 / 0.6);
  ASSERT_LT(3 * share_of_wall, yield);
  EXPECT_NEAR(
      soft.force,
      contact::hertz_force(contact::vessel_pair({12, 0.05, 0.47}, {4.7, 0.6, 0.4}, 0), 3).force,
      1e-12);
  // At 6 um it is 0.36, where deformable cells flow round a vessel at little pressure.
  EXPECT_NEAR(
      force(6).force,
      contact::hertz_force(contact::vessel_pair({12, 0.05, 0.47}, {4.7, 0.6, 0.4}, 0), 6).force,
      1e-12);
  // With the centre near the wall the overlap is 0.71 of both radii: the cell is at the cap of its
  // law, and the wall has yielded all it can.
  const contact::Contact deep = force(0.1);
  const double end = 5 + 60 * 0.1, modulus = 0.05 + end;
  const double reduced = (1 - yield / 11.9) * modulus / (1 - 0.47 * 0.47);
  const contact::SpherePair pair{contact::vessel_pair({12, 1, 0.47}, {4.7, 0.6, 0.4}, 0).radius,
                                 reduced, 0};
  EXPECT_NEAR(deep.force, contact::hertz_force(pair, 11.9).force, 1e-9);
}

TEST(Vessels, ForceOnASphereWithALawIsContinuousAndItsSlopeIsThatOfTheForce) {
  for (const double wall : {0.6, std::numeric_limits<double>::infinity()})
    for (double gap = 11.5; gap > 0.2; gap -= 0.37) {
      const auto at = [&](double g) {
        Spheres s = beside_vessel(g, wall);
        s.find();
        return s.obstacle()[0];
      };
      constexpr double h = 1e-5;
      const double slope = (at(gap - h).force - at(gap + h).force) / (2 * h);
      // Central difference: h^2 of the third derivative, and round-off of the force over h.
      EXPECT_NEAR(at(gap).slope, slope, 1e-5 * std::max(1.0, slope)) << gap;
    }
}

TEST(Vessels, ASphereWithoutALawMeetsThemAsEver) {
  Spheres s = beside_vessel(2, 0.6);
  s.params[0].correction = {};
  s.find();
  ASSERT_EQ(s.obstacle().size(), 1u);
  const contact::SpherePair pair = contact::vessel_pair({12, 0.05, 0.47}, {4.7, 0.6, 0.4}, 0);
  // Round-off of the gap, which is a difference of lengths of some 10 um.
  EXPECT_NEAR(s.obstacle()[0].force, contact::jkr_force(pair, 10, false).force, 1e-13);
}

TEST(Walls, AMirrorStiffensASphereAsASingleNeighbourDoes) {
  const StiffnessLaw law{{}, {{0.05, 0}, {0.15, 2}, {0.2, 5}}, 0.2, 0.2};
  const auto at = [&](double height) {
    Spheres s({sphere({0, 0, height}, 12, 0.05)});
    s.params[0].poisson = 0.47;
    s.params[0].correction = law;
    contact::Plane p;
    p.material.mirror = true;
    s.boundary.planes = {p};
    s.find();
    return s.obstacle()[0];
  };
  // 8 um: an overlap of 0.33 with the image, where deformable cells flatten at little pressure.
  EXPECT_NEAR(at(8).force,
              contact::mirror_wall_force(
                  {12, corrected_modulus(law, 0.05, 4.0 / 12 / kNeighbours).value, 0.47}, 8)
                  .force,
              1e-9);
  // 6 um: an overlap of 0.5, which is 0.1 beyond twice the range.
  const double modulus = corrected_modulus(law, 0.05, 0.1).value;
  EXPECT_NEAR(at(6).force, contact::mirror_wall_force({12, modulus, 0.47}, 6).force, 1e-9);
  // The force follows from the height alone there, and the slope is its own.
  constexpr double h = 1e-5;
  for (const double height : {6.4, 6.0, 5.0})
    EXPECT_NEAR(at(height).slope, (at(height - h).force - at(height + h).force) / (2 * h),
                1e-5 * at(height).slope)
        << height;
}

}  // namespace
}  // namespace acinus::cbm
