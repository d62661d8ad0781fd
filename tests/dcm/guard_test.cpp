/// Vessels thinner than the distance of contact points.

#include <gtest/gtest.h>

#include <algorithm>

#include "dcm/contact/contact_bodies.hpp"
#include "tests/dcm/clump.hpp"
#include "tests/dcm/quadratures.hpp"

namespace acinus::dcm {
namespace {

// The contact points of a coarse mesh are farther apart than a thin vessel is thick.
TEST(ObstacleContacts, AVesselTipInTheMiddleOfAFaceIsPushedOut) {
  for (const auto q : kAll) {
    Clump c;
    c.add_cells({{0, 0, &geometry::shared_icosphere(42), Vec3::Zero(), 12, Vec3::Zero(),
                  Mat3::Identity()}});
    c.options.quadrature = q;
    refresh_bodies(c.state, c.work);
    const Vec3 middle = contact::triangle_center(c.work.body[0], 7), out = middle.normalized();
    const double radius = 0.8, depth = 0.5;
    geometry::Network n;
    n.node = {middle + (radius - depth) * out, middle + 40 * out};
    n.segment = {{0, 1}};
    n.radius = {{radius, radius}};
    contact::set_network(c.boundary.vessels, n);
    c.boundary.vessels.material = {};
    c.find_afresh();
    for (const Vec3& x : c.work.body[0].node)
      EXPECT_GT(contact::gap_to_segment(n, 0, x).gap, 1) << "the nodes must not see the tip";
    Vec3 push = Vec3::Zero();
    double deepest = 0;
    for (std::size_t l = 0; l < c.links.size(); ++l) {
      push += c.force(l);
      deepest = std::min(deepest, c.obstacle()[l].gap);
    }
    EXPECT_NEAR(deepest, -depth, 1e-12);
    EXPECT_LT(push.dot(out), -0.1) << "nN, away from the vessel";
  }
}

}  // namespace
}  // namespace acinus::dcm
