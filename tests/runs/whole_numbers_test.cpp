/// Whole numbers in scenes, however programs write them.

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "runs/experiments/read_scene.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::runs {
namespace {
using namespace scene_texts;

Scene scene(const std::string& set) { return parse_scene(kMinimal, "scene.json", ".", {set}); }

std::string refused(const std::string& set) {
  return test::message_of([&] { scene(set); });
}

TEST(WholeNumbers, MayHaveAPointOrAnExponent) {
  for (const char* text : {"7", "7.0", "7e0", "70e-1", "0.7E1", "7.000"})
    EXPECT_EQ(scene(std::string("seed=") + text).seed, 7) << text;
  EXPECT_EQ(scene("seed=0.0").seed, 0);
  EXPECT_EQ(scene("seed=-0.0").seed, 0);
  EXPECT_EQ(scene("seed=9007199254740992.0").seed, 1ULL << 53);
  EXPECT_EQ(scene("seed=18446744073709551615").seed, UINT64_MAX);
  EXPECT_EQ(scene("time.until_cells=1e3").time.until_cells, 1000);
  EXPECT_EQ(scene("solver.max_iterations=50.0").hash, scene("solver.max_iterations=50").hash);
  EXPECT_EQ(scene("seed=7.0").hash, scene("seed=7").hash);
}

TEST(WholeNumbers, AreRefusedForWhatIsWrongWithThem) {
  EXPECT_CONTAINS(refused("seed=1.5"), "/seed = 1.5: must be a whole number from 0");
  EXPECT_CONTAINS(refused("seed=-1.0"), "/seed = -1: must be a whole number from 0");
  // Rounded already: it stands for several whole numbers.
  EXPECT_CONTAINS(refused("seed=1e19"), "beyond 2^53 written without point and exponent");
  EXPECT_CONTAINS(refused("time.until_cells=1e10"), "is beyond the largest whole number here");
  EXPECT_CONTAINS(refused("time.until_cells=0.5"), "must be a whole number");
  EXPECT_CONTAINS(refused("time.until_cells=\"5\""), "must be a whole number, without quotes");
}

}  // namespace
}  // namespace acinus::runs
