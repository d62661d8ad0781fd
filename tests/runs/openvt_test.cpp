#include "runs/openvt/openvt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/openvt/permedcoe.hpp"

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

/// Options of a run in a folder that is removed at the end of the test.
struct ShortRun {
  std::string folder = io::make_temporary_folder("openvt");
  OpenVtOptions options;
  explicit ShortRun(std::vector<std::string> set) {
    options.out = folder + "/a.run";
    options.csv = folder + "/a.csv";
    options.threads = 1;
    options.quiet = true;
    options.set = std::move(set);
  }
  ~ShortRun() { std::filesystem::remove_all(folder); }
  std::vector<std::string> lines() const {
    std::istringstream text(io::read_text_file(options.csv));
    std::vector<std::string> all;
    for (std::string line; std::getline(text, line);) all.push_back(line);
    return all;
  }
};

TEST(OpenVt, TwoTypesOfCellsAreWrittenInTheFormatOfTheWorkshop) {
  const ShortRun run({"time.end=\"10 min\"", "output.every=\"5 min\""});
  MixedShare found;
  ASSERT_EQ(run_sorting("sorting", run.options, found), 0);
  EXPECT_EQ(found.mixed.front(), 1) << "a checkerboard";
  ASSERT_EQ(found.time.size(), 3u);
  const std::vector<std::string> lines = run.lines();
  ASSERT_EQ(lines.size(), 301u);
  EXPECT_EQ(lines[0], "simID,time,cellID,cellType,x,y");
  EXPECT_EQ(lines[1], "0,0,0,0,-4.5,-4.5");
  EXPECT_EQ(lines[2], "0,0,1,1,-3.5,-4.5");
}

/// 600 s in units of a hundredth of the time in which a cell moves its diameter squared.
TEST(OpenVt, TheClockOfTheWorkshopIsThatOfACellAlone) {
  const ShortRun run(
      {"time.end=\"10 min\"", "output.every=\"10 min\"", "cell_types.a.diffusion=\"2e-15 m^2/s\""});
  MixedShare found;
  ASSERT_EQ(run_sorting("engulfment", run.options, found), 0);
  EXPECT_NEAR(found.time.back(), 600 * 400 * 2e-3 / 100, 1e-9);
  EXPECT_LT(found.mixed.front(), 0.1) << "two halves";
}

TEST(PerMedCoe, TwoCellsMeetAtTheVelocityAsked) {
  const ShortRun run({"time.end=\"0.9 min\"", "output.every=\"0.1 min\""});
  Pushing found;
  ASSERT_EQ(run_pushing(run.options, found), 0);
  ASSERT_EQ(found.distance.size(), 10u);
  for (std::size_t k = 0; k < found.time.size(); ++k)
    EXPECT_NEAR(found.distance[k], 30 - 20 * found.time[k], 0.02) << k;
  EXPECT_EQ(run.lines()[0], "timestep,dx");
}

TEST(PerMedCoe, TheLayerGrowsFromOneCell) {
  const ShortRun run({"time.end=\"60 h\"", "output.every=\"60 h\""});
  Growth found;
  ASSERT_EQ(run_growth("monolayer", run.options, found), 0);
  EXPECT_NEAR(found.diameter.front(), 20, 1e-9);
  EXPECT_EQ(found.cells.back(), 4);
  EXPECT_GT(found.diameter.back(), 35);
  EXPECT_EQ(run.lines().size(), 3u);
}

}  // namespace
}  // namespace acinus::runs
