#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "contact/jkr.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/workspace_size.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::runs {
namespace {

/// Sums of a handful of numbers: a few roundings, relative.
constexpr double kSumRoundOff = 1e-13;

coupling::CellMeasure cell(const Vec3& center, double pressure_kPa, bool deformable = false) {
  coupling::CellMeasure c;
  c.center = center;
  c.pressure = pressure_kPa;
  c.cytosol_pressure = 2 * pressure_kPa;
  c.deformable = deformable;
  return c;
}

/// Adds a frame of the scene's experiment to the series.
void sample(const Scene& scene, const coupling::World& world, const Snapshot& snapshot,
            Measures& m) {
  const coupling::Workspace work;
  ObservedRun run;
  run.measures = std::move(m);
  sample_experiment({scene, world, work, snapshot, {}}, run);
  m = std::move(run.measures);
}

Scene scene_of(Experiment experiment) {
  Scene scene;
  scene.experiment = experiment;
  return scene;
}

double last(const Measures& m, const std::string& name) { return m.at(name).back(); }

/// Six cells at distance 30 um from a seventh, one more pair at 14 um.
Snapshot star() {
  Snapshot s;
  s.time = 7200;
  s.cells.push_back(cell(Vec3(5, 5, 5), 0.4));
  for (int axis = 0; axis < 3; ++axis)
    for (double sign : {-1.0, 1.0})
      s.cells.push_back(cell(Vec3(5, 5, 5) + sign * 30 * Vec3::Unit(axis), 0.1));
  for (double sign : {-1.0, 1.0}) s.cells.push_back(cell(Vec3(5 + sign * 14, 5, 5), 0.25));
  return s;
}

TEST(Spheroid, SeriesOfKnownCells) {
  Measures m;
  sample(scene_of(Experiment::kSpheroid), coupling::World{}, star(), m);
  EXPECT_EQ(last(m, "time_s"), 7200);
  EXPECT_EQ(last(m, "cells"), 9);
  EXPECT_NEAR(last(m, "radius_of_gyration_um"), std::sqrt((6 * 900 + 2 * 196) / 9.0),
              30 * kSumRoundOff);
  EXPECT_NEAR(last(m, "mean_pressure_Pa"), (400 + 6 * 100 + 2 * 250) / 9.0, 400 * kSumRoundOff);
  // Below 10 um there is one cell, from 20 um on six.
  const double third = 4.0 / 3 * kPi * 1000;
  EXPECT_NEAR(last(m, "inner_pressure_Pa"), 400, 400 * kSumRoundOff);
  EXPECT_NEAR(last(m, "outer_pressure_Pa"), 100, 400 * kSumRoundOff);
  EXPECT_NEAR(last(m, "inner_cytosol_pressure_Pa"), 800, 800 * kSumRoundOff);
  EXPECT_NEAR(last(m, "outer_cytosol_pressure_Pa"), 200, 800 * kSumRoundOff);
  EXPECT_NEAR(last(m, "inner_density") / (1e9 / third), 1, kSumRoundOff);
  EXPECT_NEAR(last(m, "outer_density") / (6e9 / (19 * third)), 1, kSumRoundOff);
  EXPECT_FALSE(m.contains("sphericity")) << "there are only spheres";
}

TEST(Spheroid, ProfileOfKnownCells) {
  Measures m;
  sample(scene_of(Experiment::kSpheroid), coupling::World{}, star(), m);
  const std::vector<double>&radius = m.at("profile_radius_um"), &p = m.at("pressure_profile_Pa"),
        &density = m.at("density_profile");
  ASSERT_EQ(radius.size(), 10u);
  ASSERT_EQ(p.size(), 10u);
  ASSERT_EQ(density.size(), 10u);
  for (int k = 0; k < 10; ++k) {
    const std::size_t i = k;
    const int count = k == 0 ? 1 : k == 4 ? 2 : k == 9 ? 6 : 0;
    EXPECT_NEAR(radius[i], 3 * k + 1.5, 30 * kSumRoundOff) << k;
    const double volume = 36 * kPi * ((k + 1.0) * (k + 1) * (k + 1) - 1.0 * k * k * k);
    // The volume is a difference of cubes up to 1000/217 times as large.
    EXPECT_NEAR(density[i], 1e9 * count / volume, 10 * kSumRoundOff * 1e9 / volume) << k;
    if (count == 0)
      EXPECT_TRUE(std::isnan(p[i])) << k;
    else
      EXPECT_NEAR(p[i], k == 0 ? 400 : k == 4 ? 250 : 100, 400 * kSumRoundOff) << k;
  }
}

TEST(Spheroid, SeriesGrowAndProfilesAreOfTheLastFrame) {
  Measures m;
  const Scene scene = scene_of(Experiment::kSpheroid);
  sample(scene, coupling::World{}, star(), m);
  Snapshot later = star();
  for (coupling::CellMeasure& c : later.cells) c.center *= 2;
  sample(scene, coupling::World{}, later, m);
  for (const char* name : {"time_s", "cells", "radius_of_gyration_um", "mean_pressure_Pa",
                           "inner_pressure_Pa", "outer_pressure_Pa", "inner_cytosol_pressure_Pa",
                           "outer_cytosol_pressure_Pa", "inner_density", "outer_density"})
    EXPECT_EQ(m.at(name).size(), 2u) << name;
  const std::vector<double>& gyration = m.at("radius_of_gyration_um");
  EXPECT_NEAR(gyration[1] / gyration[0], 2, 2 * kSumRoundOff);
  ASSERT_EQ(m.at("profile_radius_um").size(), 10u);
  EXPECT_NEAR(m.at("profile_radius_um")[9], 57, 60 * kSumRoundOff);
}

TEST(Spheroid, OneCellHasNoDensityAndNoneHasNothing) {
  Measures m;
  Snapshot s;
  s.cells = {cell(Vec3(1, 2, 3), 0.05)};
  sample(scene_of(Experiment::kSpheroid), coupling::World{}, s, m);
  EXPECT_EQ(last(m, "radius_of_gyration_um"), 0);
  EXPECT_NEAR(last(m, "inner_pressure_Pa"), 50, 50 * kSumRoundOff);
  EXPECT_TRUE(std::isnan(last(m, "inner_density")));
  s.cells.clear();
  sample(scene_of(Experiment::kSpheroid), coupling::World{}, s, m);
  EXPECT_EQ(last(m, "cells"), 0);
  EXPECT_TRUE(std::isnan(last(m, "mean_pressure_Pa")));
  EXPECT_EQ(m.at("radius_of_gyration_um").size(), 2u);
}

TEST(Spheroid, SphericityIsThatOfTheDeformableCells) {
  Snapshot s;
  s.cells = {cell(Vec3::Zero(), 0, true), cell(Vec3(9, 0, 0), 0, true),
             cell(Vec3(20, 0, 0), 0, false)};
  s.cells[0].volume = 4.0 / 3 * kPi * 27;  // a sphere: 1
  s.cells[0].area = 4 * kPi * 9;
  s.cells[1].volume = 8;  // a cube: (pi/6)^(1/3)
  s.cells[1].area = 24;
  s.cells[2].volume = 1;
  s.cells[2].area = 100;
  Measures m;
  sample(scene_of(Experiment::kSpheroid), coupling::World{}, s, m);
  EXPECT_NEAR(last(m, "sphericity"), 0.5 * (1 + std::cbrt(kPi / 6)), kSumRoundOff);
  EXPECT_FALSE(m.contains("height_um")) << "only a monolayer has a height";
}

TEST(Monolayer, ProfilesAreOfRings) {
  Snapshot s = star();
  Measures m;
  sample(scene_of(Experiment::kMonolayer), coupling::World{}, s, m);
  // Two of the six outer cells stand above and below the middle one: r = 0.
  EXPECT_NEAR(last(m, "inner_pressure_Pa"), (400 + 200) / 3.0, 400 * kSumRoundOff);
  EXPECT_NEAR(last(m, "outer_pressure_Pa"), 100, 400 * kSumRoundOff);
  EXPECT_NEAR(last(m, "inner_density") / (3e6 / (kPi * 100)), 1, kSumRoundOff);
  EXPECT_NEAR(last(m, "outer_density") / (4e6 / (kPi * 500)), 1, kSumRoundOff);
  EXPECT_NEAR(m.at("density_profile")[4] / (2e6 / (kPi * (225 - 144))), 1, 10 * kSumRoundOff);
  EXPECT_NEAR(last(m, "radius_of_gyration_um"), std::sqrt((6 * 900 + 2 * 196) / 9.0),
              30 * kSumRoundOff);
}

// ---- a wall that adheres ---------------------------------------------------------------------

constexpr double kAdhesion = 0.01;  // nN/um, 1e-5 J/m^2

/// One cell of 12 um whose centre stands 12 um above a wall, in liquid so that it is free to
/// follow.
Scene on_wall(const std::string& model, const std::string& wall,
              const std::vector<std::string>& set) {
  const std::string text = R"({"time": {"end": "1 day", "step": "20 s"},
    "cell_types": {"a": {"cbm": {"young_spread": 0}}}, "motility": {"random": false},
    "cells": {"model": ")" +
                           model +
                           R"(", "list": [{"position": ["0 um", "0 um", "12 um"]}]},
    "walls": [{"point": ["0 um", "0 um", "0 um"], "normal": [0, 0, 1])" +
                           wall + "}]}";
  return parse_scene(text, "wall.json", ".", set);
}

const std::string kMirror = R"(, "mirror": true)";
const std::string kSticky = R"(, "mirror": false, "adhesion": "1e-5 J/m^2")";

struct OneCell {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();  ///< um, centre
  double contact_area = 0;                        ///< um^2
  Measures measures;                              ///< of the end
};
OneCell simulate(Scene scene, double duration) {
  scene.experiment = Experiment::kMonolayer;
  BuiltWorld built = build_world(scene, Ranks::serial());
  coupling::World& world = built.world;
  coupling::Workspace work;
  coupling::size_workspace(world, work);
  OneCell out;
  out.start = take_snapshot(world, work).cells.at(0).center;
  while (world.state.clock.time < duration - 1e-6) {
    const auto step = coupling::take_step(world, work, duration - world.state.clock.time);
    EXPECT_TRUE(step.accepted) << step.cause;
    if (!step.accepted) return out;
  }
  const Snapshot end = take_snapshot(world, work);
  out.end = end.cells.at(0).center;
  out.contact_area = end.cells.at(0).contact_area;
  sample(scene, world, end, out.measures);
  return out;
}

TEST(AdhesiveWall, SphereSinksToItsJkrRest) {
  const Scene scene = on_wall("cbm", kSticky, {});
  const OneCell out = simulate(scene, 6 * 3600);
  const contact::SphereBody sphere{12, 3 * 2.5 * (1 - 2 * 0.47), 0.47};
  const contact::SphereBody wall{contact::kFlat, contact::kRigid, 0};
  const double rest =
      contact::jkr_special(contact::reduced_pair(sphere, wall, kAdhesion)).zero_force.overlap;
  std::printf("sphere on wall: overlap %.4f um, JKR %.4f um, contact area %.1f um^2\n",
              12 - out.end.z(), rest, out.contact_area);
  EXPECT_GT(rest, 0.1);
  // Exponential approach over hundreds of times its own time scale; what is left is the tolerance
  // of the step, 0.01 um, at which the controller lets an ever smaller motion end.
  EXPECT_NEAR(12 - out.end.z(), rest, 0.01);
}

TEST(AdhesiveWall, DeformableCellFlattens) {
  const OneCell out = simulate(on_wall("dcm", kSticky, {}), 6 * 3600);
  const OneCell mirror = simulate(on_wall("dcm", kMirror, {}), 6 * 3600);
  std::printf(
      "DCM cell after 6 h: height %.2f um on the adhesive wall, %.2f um on a mirror; height/width "
      "%.3f and %.3f; contact area %.1f and %.1f um^2\n",
      last(out.measures, "height_um"), last(mirror.measures, "height_um"),
      last(out.measures, "height_to_width"), last(mirror.measures, "height_to_width"),
      out.contact_area, mirror.contact_area);
  // A patch of the order of the JKR one; the mirror only touches.
  EXPECT_GT(out.contact_area, 50);
  EXPECT_LT(mirror.contact_area, 0.5 * out.contact_area);
  EXPECT_LT(last(out.measures, "height_to_width"), 0.99);
  EXPECT_GT(last(mirror.measures, "height_to_width"), 0.99);
}

/// Less than the pull-off force of every law between 1 and 2 pi W R, 0.38 and 0.75 nN.
const std::string kPullUp = R"(cells.list.0.pull=["0 nN", "0 nN", "0.1 nN"])";

TEST(AdhesiveWall, HoldsACellThatAMirrorLetsGo) {
  for (const char* model : {"dcm", "cbm"}) {
    const double held = simulate(on_wall(model, kSticky, {kPullUp}), 6 * 3600).end.z();
    const double lost = simulate(on_wall(model, kMirror, {kPullUp}), 6 * 3600).end.z();
    std::printf("%s cell pulled up with 0.1 nN for 6 h: z = %.2f um held, %.2f um at a mirror\n",
                model, held, lost);
    EXPECT_LT(held, 12.5) << model;
    EXPECT_GT(lost, 13) << model;
  }
}

TEST(AdhesiveWall, FrictionIsThatOfVessels) {
  const std::vector<std::string> set{R"(cells.list.0.pull=["0.1 nN", "0 nN", "0 nN"])",
                                     "friction.cbm_vessel=1e11 N s/m^3",
                                     "friction.dcm_vessel=1e11 N s/m^3"};
  const std::vector<std::string> smooth{set[0], "friction.cbm_vessel=0 N s/m^3",
                                        "friction.dcm_vessel=0 N s/m^3"};
  // The fifth hour, when the sphere's contact area A rests: it slides at
  // F/(gamma_ECM (S - A) + gamma_vessel A), a few times slower than off the wall.
  const OneCell before = simulate(on_wall("cbm", kSticky, set), 4 * 3600);
  const OneCell full = simulate(on_wall("cbm", kSticky, set), 5 * 3600);
  const double area = full.contact_area, surface = 4 * kPi * 144;
  const double expected = 0.1 * 3600 / (0.5 * (surface - area) + 100 * area);
  const double slid = full.end.x() - before.end.x();
  std::printf("sphere on a rough wall: slid %.4f um, expected %.4f um\n", slid, expected);
  // The solver works to 3e-3 of the force, and the links keep friction in single precision.
  EXPECT_NEAR(slid / expected, 1, 3e-3);
  for (const char* model : {"dcm", "cbm"}) {
    const OneCell slow = simulate(on_wall(model, kSticky, set), 7200);
    const OneCell fast = simulate(on_wall(model, kSticky, smooth), 7200);
    const double rough_um = slow.end.x() - slow.start.x(),
                 smooth_um = fast.end.x() - fast.start.x();
    std::printf("%s cell: slid %.4f um with and %.4f um without wall friction\n", model, rough_um,
                smooth_um);
    EXPECT_GT(smooth_um, 0.5) << model;
    // A deformable cell that cannot slide still rolls.
    EXPECT_LT(rough_um, 0.5 * smooth_um) << model;
  }
}

}  // namespace
}  // namespace acinus::runs
