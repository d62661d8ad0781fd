/// Daughters of dcm/shape/split judged by exact predicates that share no code with it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "dcm/shape/split.hpp"
#include "geometry/audit_body.hpp"
#include "tests/reference/cell_shapes.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::coupling {
namespace {

/// Depth of the nodes of one daughter outside the mother, um.
double compute_outside(const geometry::AuditBody& mother, std::span<const Vec3> node) {
  double worst = 0;
  for (const Vec3& x : node)
    if (mother.locate(x) == geometry::Location::kOutside)
      worst = std::max(worst, mother.distance(x));
  return worst;
}

TEST(SplitAudit, DaughtersDoNotCrossThemselvesAndStayWithinTheMother) {
  const geometry::Topology& topology = geometry::shared_icosphere(162);
  int n_daughter = 0;
  for (const auto& shape : reference::cell_shapes()) {
    if (!shape.always_splits) continue;
    UniformStream random = reference::stream(4);
    double worst = 0, mean = 0;
    for (int n = 0; n < 40; ++n) {
      const geometry::Surface mother = reference::make_cell(
          shape, topology, 15.1, reference::random_rotation(random), Vec3(100, -50, 30));
      const geometry::AuditBody body(mother.node, mother.triangle);
      ASSERT_FALSE(body.self_intersects()) << shape.name;
      const dcm::Split split = dcm::split_cell(topology, mother.node, random.unit_vector());
      ASSERT_TRUE(split.daughters) << shape.name;
      for (std::size_t h = 0; h < 2; ++h) {
        const geometry::AuditBody daughter(split.daughters->node[h], topology.triangle);
        EXPECT_FALSE(daughter.self_intersects()) << shape.name;
        EXPECT_NEAR(daughter.volume, body.volume / 2, 1e-9 * body.volume);
        const double outside = compute_outside(body, split.daughters->node[h]);
        // Nodes move out by the outset along a unit vector, from points on the mother.
        EXPECT_LE(outside, split.daughters->outset[h] + 1e-9);
        worst = std::max(worst, outside);
        mean += outside / 80;
        ++n_daughter;
      }
    }
    std::printf("%-13s farthest node outside the mother: mean %.3f um, worst %.3f um\n",
                shape.name.c_str(), mean, worst);
    EXPECT_LT(worst, shape.name == "crescent" ? 0.15 : 0.11) << shape.name;
  }
  EXPECT_GE(n_daughter, 480);
}

TEST(SplitAudit, TheMothersUsedInTestsAreSound) {
  for (const auto& shape : reference::cell_shapes()) {
    const geometry::Surface mother = reference::make_cell(shape, geometry::shared_icosphere(162),
                                                          15.1, Mat3::Identity(), Vec3::Zero());
    EXPECT_FALSE(geometry::AuditBody(mother.node, mother.triangle).self_intersects()) << shape.name;
  }
}

}  // namespace
}  // namespace acinus::coupling
