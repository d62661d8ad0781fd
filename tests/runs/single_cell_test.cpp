/// Measures of experiments on single cells, on worlds whose numbers are known.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <cmath>

#include "coupling/apparatus/suction/suction.hpp"
#include "runs/experiments/aspiration_experiment.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/narrow_gap_experiment.hpp"
#include "runs/experiments/plates_experiment.hpp"
#include "runs/experiments/pull_off_experiment.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::runs {
namespace {

/// One deformable cell of 12 um at the origin, and what a frame of it measures.
struct WatchedCell {
  Scene scene{};
  coupling::World world = coupling::make_test_world({{Vec3::Zero(), true}}, 60, 642);
  coupling::Workspace work{};
  Measures look(Experiment experiment) {
    scene.experiment = experiment;
    coupling::size_workspace(world, work);
    const Snapshot snapshot = take_snapshot(world, work);
    ObservedRun run;
    sample_experiment({scene, world, work, snapshot, {}}, run);
    return run.measures;
  }
};

contact::Pipette hole(double start, double length) {
  contact::Pipette p;
  p.mouth = Vec3(start, 0, 0);
  p.axis = Vec3::UnitX();
  p.radius = 20;
  p.thickness = 4;
  p.lip = 0;
  p.length = length;
  return p;
}

TEST(Plates, MeasureGapForceAndArea) {
  WatchedCell w;
  contact::Plane low, high;
  low.point = Vec3(0, 0, -11.5);
  high.point = Vec3(0, 0, 11.5);
  high.normal = -Vec3::UnitZ();
  low.material = high.material = {};
  w.world.params.boundary.planes = {low, high};
  Measures m = w.look(Experiment::kPlates);
  EXPECT_DOUBLE_EQ(m["gap_um"][0], 23);
  // A ball that was not deformed yet: k_rep pi R d^2 on each plate, d = 0.5 and the 0.3 % by which
  // the mesh stands out; contact points lie at most 0.07 um within the sphere.
  const double least = 5 * kPi * 12 * 0.43 * 0.43, most = 5 * kPi * 12 * 0.54 * 0.54;
  EXPECT_GT(m["force_nN"][0], least);
  EXPECT_LT(m["force_nN"][0], most);
  // What is nearer than half the range of friction counts in full, and what is beyond it not.
  EXPECT_GT(m["contact_radius_um"][0], std::sqrt(2 * 12 * 0.43));
  EXPECT_LT(m["contact_radius_um"][0], std::sqrt(2 * 12 * (0.54 + 0.3)));
}

TEST(Plates, ShellForceByHand) {
  dcm::Params p = dcm::params_without_terms();
  p.spring_stiffness = 2 / std::sqrt(3.0);  // K = 1, Y = 4/3
  p.bending_stiffness = 2 / std::sqrt(3.0);
  p.area_modulus = 2;
  EXPECT_EQ(shell_force(p, 10, 20), 0);
  EXPECT_EQ(shell_force(p, 10, 21), 0) << "not touched";
  EXPECT_NEAR(shell_force(p, 10, 18), 2 * kPi * 3 * 10 * 1e-3 + 8 * std::sqrt(4.0 / 3) * 0.1,
              1e-12);
}

// Wide cells: 2 T / R_p less the pressure of the whole; half a ball of the cell's own radius leaves
// half a ball, and no pressure.
TEST(Aspiration, ClosedFormHasItsLimits) {
  EXPECT_NEAR(closed_form_suction(0.3, 1, 1000), 2 * 0.3 * (1 - 1e-3), 1e-9);
  EXPECT_NEAR(closed_form_suction(0.3, 5, 12), 2 * 0.3 * (1 / 5.0 - 1 / 12.0), 0.3 * 1e-2);
  EXPECT_NEAR(closed_form_suction(0.3, 5, 5), 0, 1e-6);
}

TEST(Aspiration, MeasuresTheLengthBeyondTheMouth) {
  WatchedCell w;
  coupling::Suction suction;
  suction.mouth = Vec3(0, 0, 9);
  suction.reach = 6;
  suction.pressure.entry = {{0, 0.05}};
  w.world.params.apparatus.add(suction);
  Measures m = w.look(Experiment::kAspiration);
  EXPECT_NEAR(m["aspirated_length_um"][0], 3, 0.05) << "the mesh stands 0.3 % out";
  EXPECT_DOUBLE_EQ(m["suction_Pa"][0], 50);
  suction.mouth.z() = 20;
  w.world.params.apparatus = {};
  w.world.params.apparatus.add(suction);
  EXPECT_EQ(w.look(Experiment::kAspiration)["aspirated_length_um"][0], 0);
}

TEST(Aspiration, CriticalPressureIsWhereTheLengthIsRadiusAndLip) {
  PipetteBlock p;
  p.radius = 5;
  p.lip = 1;
  Measures m;
  EXPECT_FALSE(critical_suction(p, m));
  m["suction_Pa"] = {0, 10, 20, 30};
  m["aspirated_length_um"] = {1, 2, 5, 9};
  EXPECT_NEAR(*critical_suction(p, m), 0.0225, 1e-15);
  m["aspirated_length_um"] = {1, 2, 5, 5.9};
  EXPECT_FALSE(critical_suction(p, m));
}

TEST(NarrowGap, MeasuresWhereTheCellIs) {
  WatchedCell w;
  w.world.params.boundary.pipettes = {hole(-5, 10)};
  Measures m = w.look(Experiment::kNarrowGap);
  EXPECT_NEAR(m["position_um"][0], 5, 1e-12);
  EXPECT_NEAR(m["length_um"][0], 24, 0.1);
  EXPECT_NEAR(m["width_um"][0], 24, 0.1);
  EXPECT_NEAR(m["waist_um"][0], 24, 0.1);
  EXPECT_EQ(m["passed"][0], 0);
  w.world.params.boundary.pipettes = {hole(1, 10)};
  EXPECT_NEAR(w.look(Experiment::kNarrowGap)["waist_um"][0], 2 * std::sqrt(144.0 - 36), 0.1);
  w.world.params.boundary.pipettes = {hole(-30, 10)};
  m = w.look(Experiment::kNarrowGap);
  EXPECT_EQ(m["passed"][0], 1);
  EXPECT_EQ(m["waist_um"][0], 0) << "nothing left of it in the hole";
}

TEST(NarrowGap, PassageTakesFromTheFirstTouchToTheEnd) {
  Measures m;
  EXPECT_FALSE(passage_time(m));
  m["time_s"] = {0, 3600, 7200, 10800};
  m["position_um"] = {-20, -11, 0, 30};
  m["length_um"] = {24, 24, 24, 24};
  m["passed"] = {0, 0, 0, 0};
  EXPECT_FALSE(passage_time(m));
  m["passed"] = {0, 0, 0, 1};
  EXPECT_NEAR(*passage_time(m), 2, 1e-12);
}

TEST(PullOff, ForceIsTheLargestThatWasBorne) {
  Measures m;
  EXPECT_FALSE(has_come_apart(m));
  m["pull_force_nN"] = {0, 1, 2, 3};
  m["contact_area_um2"] = {0, 0, 0, 0};
  EXPECT_FALSE(has_come_apart(m)) << "they never met";
  m["contact_area_um2"] = {9, 8, 1, 1};
  EXPECT_FALSE(pull_off_force(m)) << "they still adhere";
  m["contact_area_um2"] = {9, 8, 1, 0};
  EXPECT_TRUE(has_come_apart(m));
  EXPECT_EQ(*pull_off_force(m), 2);
  m["pull_force_nN"] = {0, 4, 2, 1};
  EXPECT_EQ(*pull_off_force(m), 4) << "a spring lets the force fall before the contact is lost";
}

TEST(Tear, FiguresAreThoseOfATornBlock) {
  const ExperimentRow& row = experiment_row(Experiment::kTear);
  Measures m;
  m["tear_force_nN"] = {-1, 0, 2, 6, 3};
  m["separation_um"] = {20, 20, 21, 22, 25};
  m["tear_work_fJ"] = {0, 0, 1, 5, 18.5};
  nlohmann::ordered_json whole, torn;
  EXPECT_EQ(row.why_over(m), "");
  row.add_figures(Scene{}, m, whole);
  EXPECT_TRUE(whole["tear_peak_nN"].is_null()) << "it still holds";
  m["tear_force_nN"].push_back(0.1);
  m["separation_um"].push_back(26);
  m["tear_work_fJ"].push_back(20.05);
  EXPECT_NE(row.why_over(m), "");
  row.add_figures(Scene{}, m, torn);
  EXPECT_EQ(torn["tear_peak_nN"], 6);
  EXPECT_EQ(torn["tear_peak_separation_um"], 22);
  EXPECT_EQ(torn["tear_total_work_fJ"], 20.05);
}

}  // namespace
}  // namespace acinus::runs
