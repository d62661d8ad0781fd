#include "runs/openvt/openvt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::runs {
namespace {

constexpr double kSampled = 2e-3;  // 720 angles, 40 rings

TEST(OpenVt, ALoneDiscIsFreeAllRound) {
  const std::vector<FreeShares> free = free_shares({{1, 2, 5}, {50, 2, 5}});
  EXPECT_EQ(free[0].rim, 1);
  EXPECT_EQ(free[1].area, 1);
}

TEST(OpenVt, DiscsThatOverlapByTheirRadiusKeepTwoThirdsOfTheirRim) {
  const std::vector<FreeShares> free = free_shares({{0, 0, 5}, {5, 0, 5}});
  // The lens of two circles whose centres lie on each other's rim.
  const double lens = 2 * std::numbers::pi / 3 - std::sqrt(3) / 2;
  for (const FreeShares& f : free) {
    EXPECT_NEAR(f.rim, 2.0 / 3, kSampled);
    EXPECT_NEAR(f.area, 1 - lens / std::numbers::pi, kSampled);
  }
}

TEST(OpenVt, ACoveredDiscHasNothingFree) {
  const std::vector<FreeShares> free = free_shares({{0, 0, 2}, {0.5, 0, 5}});
  EXPECT_EQ(free[0].rim, 0);
  EXPECT_EQ(free[0].area, 0);
  EXPECT_EQ(free[1].rim, 1);
  EXPECT_NEAR(free[1].area, 1 - 4.0 / 25, kSampled);
}

TEST(OpenVt, NineDiametersAreFoundBetweenFrames) {
  EXPECT_DOUBLE_EQ(time_to_90_percent({{0, 60, 120}, {5, 8.5, 9.5}}), 90);
  EXPECT_THROW(time_to_90_percent({{0, 60}, {5, 8.9}}), Error);
}

TEST(OpenVt, ARowOfSpheresRelaxes) {
  OpenVtOptions options;
  const std::string folder = io::make_temporary_folder("openvt");
  options.out = folder + "/row.run";
  options.csv = folder + "/row.csv";
  options.threads = 1;
  options.quiet = true;
  options.set = {"output.every=\"5 min\""};
  RowLength row;
  ASSERT_EQ(run_relaxation(options, row), 0);
  EXPECT_NEAR(row.width.front(), 5, 1e-6);
  EXPECT_NEAR(time_to_90_percent(row), 58 * 60, 120);
  EXPECT_TRUE(io::read_text_file(options.csv).starts_with("time,width\n0,5\n"));
  // What is there is taken, not made again.
  options.resume = true;
  RowLength again;
  EXPECT_EQ(run_relaxation(options, again), 0);
  EXPECT_EQ(again.width, row.width);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace acinus::runs
