/// Steps do not depend on the age of the lists of near spheres: a resumed run makes them anew.

#include <gtest/gtest.h>

#include "coupling/simulation.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::coupling {
namespace {

/// Two spheres on a deformable cell; they come nearer to each other by 0.1 um, from beyond what is
/// listed to within it, without touching.
World triangle() {
  const double half = 0.5 * 24.33, height = std::sqrt(23.8 * 23.8 - half * half);
  World w = make_test_world({{Vec3(0, 0, 0), true},
                             {Vec3(-half, height, 0), false, Vec3(0.3, 0, 0)},
                             {Vec3(half, height, 0), false}},
                            1);
  w.params.dcm[0].adhesion = w.params.cbm[0].adhesion = 0;
  w.params.motility.random = false;
  return w;
}

TEST(ListsOfSpheres, AgeDoesNotChangeTheStep) {
  World kept = triangle(), renewed = kept;
  Workspace a, b;
  size_workspace(kept, a);
  size_workspace(renewed, b);
  std::size_t most_more = 0;
  for (int k = 0; k < 250; ++k) {
    b.cbm.list_position.clear();
    kept.state.clock.coarse = renewed.state.clock.coarse = true;  // groups cells that are joined
    ASSERT_TRUE(take_step(kept, a, 1).accepted);
    ASSERT_TRUE(take_step(renewed, b, 1).accepted);
    if (b.cbm.pair.size() > a.cbm.pair.size())
      most_more = std::max(most_more, b.cbm.pair.size() - a.cbm.pair.size());
    ASSERT_EQ(hash_state(kept.state), hash_state(renewed.state)) << "step " << k;
  }
  EXPECT_GT(most_more, 0) << "the lists never differed";
}

}  // namespace
}  // namespace acinus::coupling
