/// Horizontal sections, chords in them, and what is measured with both: open area, front, plates.

#include "runs/experiments/sections.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "geometry/topology.hpp"
#include "runs/experiments/flooded_area.hpp"
#include "runs/experiments/open_area.hpp"
#include "runs/experiments/plate_thickness.hpp"
#include "tests/reference/brick.hpp"

namespace acinus::runs {
namespace {

/// Round-off of lengths of up to some hundred micrometres.
constexpr double kCutRoundOff = 1e-11;

/// Closed box, 12 triangles.
struct Brick {
  geometry::Surface surface;
  contact::SurfaceBody body;
  Brick(const Vec3& low, const Vec3& high) : surface(reference::brick(low, high)) {
    body.node = surface.node;
    body.triangle = &surface.triangle;
    contact::refresh_body(body);
  }
  Brick(const Brick&) = delete;
  Brick& operator=(const Brick&) = delete;
  std::span<const contact::SurfaceBody> bodies() const { return {&body, 1}; }
};

LobuleDomain pie(double height = 72) {
  LobuleDomain lobule;
  lobule.frame = {height, 10, 12};
  lobule.from_angle = -kPi / 6;
  lobule.to_angle = kPi / 6;
  return lobule;
}

TEST(Sections, ChordsOfABallAreThoseOfItsCircle) {
  const Ball ball{Vec3(5, 1, 10), 13};
  const std::vector<double> height{15, 30};
  const std::vector<Section> sections = make_sections({}, {&ball, 1}, height);
  ASSERT_EQ(sections[0].outline.size(), 1U);
  EXPECT_TRUE(sections[1].outline.empty()) << "7 um above it";
  // Radius sqrt(169 - 25) = 12 at this height; the line passes 1 um beside its centre.
  const std::vector<Chord> chords =
      compute_chords(sections[0].outline[0], Vec2(0, 0), Vec2::UnitX());
  ASSERT_EQ(chords.size(), 1U);
  EXPECT_NEAR(chords[0][0], 5 - std::sqrt(143), kCutRoundOff);
  EXPECT_NEAR(chords[0][1], 5 + std::sqrt(143), kCutRoundOff);
  EXPECT_TRUE(compute_chords(sections[0].outline[0], Vec2(0, 13.1), Vec2::UnitX()).empty());
}

TEST(Sections, ChordsOfACellMeshAddUpToItsVolume) {
  const geometry::Topology& t = geometry::shared_icosphere(162);
  contact::SurfaceBody body;
  body.triangle = &t.triangle;
  for (const Vec3& x : t.rest) body.node.push_back(Vec3(3, -2, 20) + 12 * x);
  contact::refresh_body(body);
  constexpr double kStep = 0.5;
  std::vector<double> height;
  for (double z = 7; z < 33; z += kStep) height.push_back(z + 0.5 * kStep);
  double volume = 0;
  for (const Section& s : make_sections({&body, 1}, {}, height))
    for (double y = -16 + 0.5 * kStep; y < 12; y += kStep)
      for (const Outline& o : s.outline)
        for (const Chord& c : compute_chords(o, Vec2(-100, y), Vec2::UnitX()))
          volume += (c[1] - c[0]) * kStep * kStep;
  // The midpoint rule of a round body: relative error of the order of (step / R)^2.
  EXPECT_NEAR(volume / (4.0 / 3 * kPi * 1728), 1, 2e-3);
}

TEST(Sections, LinesThroughNodesAndAlongEdgesStillCloseTheirChords) {
  const Brick brick(Vec3(10, -5, 0), Vec3(30, 5, 20));
  const std::vector<double> height{0, 20, 10};
  const std::vector<Section> s = make_sections(brick.bodies(), {}, height);
  for (const double y : {-5.0, 0.0, 5.0})
    for (const Section& section : s)
      for (const Outline& o : section.outline)
        for (const Chord& c : compute_chords(o, Vec2(0, y), Vec2::UnitX()))
          EXPECT_NEAR(c[1] - c[0], 20, kCutRoundOff) << y << " at " << section.z;
}

TEST(Sections, PiecesThatTouchAreOne) {
  const std::vector<Ball> balls{{Vec3(0, 0, 0), 10}, {Vec3(19, 0, 0), 10}, {Vec3(41, 0, 0), 10}};
  const std::vector<double> height{0};
  const Section s = make_sections({}, balls, height)[0];
  const auto pieces = [&](double join) {
    return covered_pieces(s, Vec2(0, 0), Vec2::UnitX(), join);
  };
  ASSERT_EQ(pieces(0).size(), 2U);
  EXPECT_NEAR(pieces(0)[0][1], 29, kCutRoundOff);
  EXPECT_EQ(pieces(2.1).size(), 1U) << "the gap is 2 um";
}

TEST(OpenArea, OfACellInsideIsLessByItsVolumeOverTheHeight) {
  const LobuleDomain lobule = pie();
  const LesionGrid grid = make_lesion_grid(lobule, 120, {});
  const double all = measure_opening(grid, make_sections({}, {}, grid.height)).area;
  // The midpoint rule is exact for an area that is linear in the radius.
  EXPECT_NEAR(all, kPi / 6 * (120 * 120 - 100), kCutRoundOff * all);
  const Ball ball{Vec3(70, 5, 30), 12};
  const double less = all - measure_opening(grid, make_sections({}, {&ball, 1}, grid.height)).area;
  // About 6 slices, 19 rays and 12 points a ray hit it; a cell of the grid at its rim is right or
  // wrong as a whole, and errors of both signs cancel.
  EXPECT_NEAR(less / (4.0 / 3 * kPi * 1728 / 72), 1, 0.05);
}

TEST(OpenArea, LeavesOutVessels) {
  geometry::Network vessels;
  vessels.node = {Vec3(60, 0, -20), Vec3(60, 0, 100)};
  vessels.segment = {{0, 1}};
  vessels.radius = {{6, 6}};
  const LesionGrid grid = make_lesion_grid(pie(), 120, vessels);
  const double area = measure_opening(grid, make_sections({}, {}, grid.height)).area;
  // A circle of 6 um on a grid of 2 um by 1 um: its rim is 38 um long, half a cell of it is 38 um^2
  // if all errors had one sign.
  EXPECT_NEAR(kPi / 6 * (120 * 120 - 100) - area, kPi * 36, 12);
}

TEST(OpenArea, FrontOfAFlatWallOfCells) {
  const Brick wall(Vec3(60, -200, -10), Vec3(90, 200, 100));
  const LesionGrid grid = make_lesion_grid(pie(), 80, {});
  const Opening o = measure_opening(grid, make_sections(wall.bodies(), {}, grid.height));
  // Rays meet it at 60 / cos(a), |a| <= 30 degrees. Means over 60 rays: midpoint rule, error
  // (1 degree)^2 / 24 of the second derivative, some 1e-5 of the value.
  const double range = kPi / 3, mean = 60 * 2 * std::log(std::tan(kPi / 4 + kPi / 12)) / range,
               square = 3600 * 2 * std::tan(kPi / 6) / range;
  EXPECT_NEAR(o.front, mean, 1e-4 * mean);
  EXPECT_NEAR(o.roughness, std::sqrt(square - mean * mean), 1e-2);
  EXPECT_NEAR(o.seen, 3600 * std::tan(kPi / 6) - 0.5 * range * 100, 1e-4 * 3600);
  // The wall hides what lies behind it, and covers the same.
  EXPECT_NEAR(o.area / o.seen, 1, 0.02);
}

TEST(OpenArea, RaysThatMeetNothingEndOneDiameterBeyond) {
  const LesionGrid grid = make_lesion_grid(pie(), 80, {});
  const Opening o = measure_opening(grid, make_sections({}, {}, grid.height));
  EXPECT_NEAR(o.front, 104, kCutRoundOff);
  EXPECT_NEAR(o.roughness, 0, 1e-5);
  EXPECT_NEAR(o.seen, o.area, 1e-9);
}

double flooded_area(const LesionGrid& grid, std::span<const contact::SurfaceBody> bodies,
                    std::span<const Ball> balls, const geometry::Network& vessels = {}) {
  return measure_flooded_area(make_flood_lattice(grid, pie(), vessels),
                              make_sections(bodies, balls, grid.height));
}

TEST(FloodedArea, OfAnEmptyLesionIsAllOfIt) {
  const LesionGrid grid = make_lesion_grid(pie(), 120, {});
  const double all = kPi / 6 * (120 * 120 - 100);
  // Points of 16 um^2 are in or out as a whole; the rim is 360 um long: 45 of them if all erred
  // one way.
  EXPECT_NEAR(flooded_area(grid, {}, {}), all, 0.02 * all);
}

TEST(FloodedArea, EndsAtAWallAndPassesThroughADoor) {
  const LesionGrid grid = make_lesion_grid(pie(), 120, {});
  const double all = flooded_area(grid, {}, {});
  const Brick wall(Vec3(60, -200, -10), Vec3(84, 200, 100));
  const double before = flooded_area(grid, wall.bodies(), {});
  const double front = 60 * 60 * std::tan(kPi / 6) - kPi / 6 * 100;
  // The front lies on faces of cubes; their points are as above.
  EXPECT_NEAR(before, front, 0.05 * front) << "what lies behind the wall is not reached";
  const Brick left(Vec3(60, -200, -10), Vec3(84, -12, 100)),
      right(Vec3(60, 24, -10), Vec3(84, 200, 100));
  std::vector<contact::SurfaceBody> both{left.body, right.body};
  const double with_door = flooded_area(grid, both, {});
  EXPECT_GT(with_door, all - 24 * 130) << "through 36 um: all but the wall";
  const Brick narrow(Vec3(60, -200, -10), Vec3(84, -2, 100)),
      other(Vec3(60, 2, -10), Vec3(84, 200, 100));
  both = {narrow.body, other.body};
  EXPECT_NEAR(flooded_area(grid, both, {}), before, 1e-9) << "4 um are less than a cube";
}

TEST(FloodedArea, LeavesOutVessels) {
  geometry::Network vessels;
  vessels.node = {Vec3(60, 0, -20), Vec3(60, 0, 100)};
  vessels.segment = {{0, 1}};
  vessels.radius = {{10, 10}};
  const LesionGrid grid = make_lesion_grid(pie(), 120, vessels);
  // Points of 4 um in a circle of 10: its rim crosses some 16 of them.
  EXPECT_NEAR(flooded_area(grid, {}, {}) - flooded_area(grid, {}, {}, vessels), kPi * 100, 60);
}

TEST(Plates, ThicknessIsAreaOverWidthOfTheLines) {
  const Brick plate(Vec3(-10, -300, 0), Vec3(10, 300, 40));
  const std::vector<double> height{20};
  const Chords chords = measure_chords(make_sections(plate.bodies(), {}, height));
  // Lines 6 um apart in four directions: of each together A / 6 um, and width / 6 um of them.
  const double widths = 600 + 20 + 2 * 620 / std::sqrt(2.0), area = 600 * 20;
  EXPECT_NEAR(chords.count, widths / 6, 4);  // one more or less in each direction
  EXPECT_NEAR(chords.mean, 4 * area / widths, 0.03 * 4 * area / widths);
}

TEST(Plates, CellsInTouchAreOnePlate) {
  const std::vector<Ball> apart{{Vec3(0, 0, 0), 12}, {Vec3(30, 0, 0), 12}},
      touching{{Vec3(0, 0, 0), 12}, {Vec3(24, 0, 0), 12}};
  const std::vector<double> height{0};
  EXPECT_GT(measure_chords(make_sections({}, touching, height)).mean,
            measure_chords(make_sections({}, apart, height)).mean);
}

TEST(Plates, DistanceFromChosenVessels) {
  geometry::Network n;
  n.node = {Vec3(0, 0, 0), Vec3(0, 0, 50), Vec3(20, 0, 0), Vec3(20, 0, 50)};
  n.segment = {{0, 1}, {2, 3}};
  n.radius = {{4, 4}, {10, 10}};
  const std::vector<Vec3> points{Vec3(12, 0, 10), Vec3(0, 9, 30)};
  const std::vector<std::uint8_t> thin{1, 0}, both{1, 1}, none{0, 0};
  EXPECT_NEAR(mean_distance(points, n, thin), (8 + 5) / 2.0, kCutRoundOff);
  EXPECT_NEAR(mean_distance(points, n, both), (-2 + 5) / 2.0, kCutRoundOff);
  EXPECT_EQ(mean_distance(points, n, none), 0);
  EXPECT_EQ(mean_distance({}, n, both), 0);
}

}  // namespace
}  // namespace acinus::runs
