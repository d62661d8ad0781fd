/// Observables: the registry, and hand-made worlds with known numbers.

#include "runs/experiments/observables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/parallel/threads.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/lobule_experiment.hpp"
#include "runs/experiments/observe.hpp"
#include "runs/experiments/observed_run.hpp"
#include "runs/experiments/sample_tissue.hpp"
#include "runs/session/audit_world.hpp"
#include "tests/coupling/worlds.hpp"

namespace acinus::runs {
namespace {

/// Sums of some dozen numbers.
constexpr double kRoundOff = 1e-12;

Scene lobule_scene(coupling::LobuleShape shape = coupling::LobuleShape::kHexagon,
                   double height = 48) {
  Scene scene;
  scene.experiment = Experiment::kLobule;
  scene.lobule = LobuleBlock{};
  scene.lobule->shape = shape;
  scene.lobule->height = height;
  scene.cell_types["hepatocyte"] = {};
  return scene;
}

/// World and the frames that are measured of it.
struct Watched {
  Scene scene;
  coupling::World world;
  coupling::Workspace work{};
  ObservedRun observer{};
  Snapshot snapshot{};
  std::vector<io::SeriesValue> row{};

  Watched(Scene s, coupling::World w) : scene(std::move(s)), world(std::move(w)) {
    coupling::size_workspace(world, work);
    snapshot = take_snapshot(world, work);
  }
  /// Measures the snapshot as it is now.
  void look(double time = 0) {
    snapshot.time = time;
    row = observe_frame(
        {scene, world, work, snapshot,
         audit_world(world, work, snapshot, prepare_static_bodies(world.params.boundary))},
        observer);
  }
  double operator[](const std::string& name) const {
    const auto at = std::ranges::find(row, name, &io::SeriesValue::name);
    EXPECT_NE(at, row.end()) << name;
    return at == row.end() ? std::nan("") : at->value;
  }
};

/// Spheres of 12 um on a ring at this distance, in two slices of a hexagon.
std::vector<coupling::TestCell> ring(double distance, int n = 8) {
  std::vector<coupling::TestCell> cells;
  for (const double z : {12.0, 36.0})
    for (int k = 0; k < n; ++k) {
      const double angle = 2 * kPi * (k + 0.3) / n;
      cells.push_back({Vec3(distance * std::cos(angle), distance * std::sin(angle), z), false});
    }
  return cells;
}

/// Brings all spheres of a snapshot nearer to the axis.
void move_inward(Snapshot& s, double by) {
  for (coupling::CellMeasure& c : s.cells) {
    const double r = std::hypot(c.center.x(), c.center.y());
    c.center.head<2>() *= (r - by) / r;
  }
}

std::vector<Experiment> all_experiments() {
  std::vector<Experiment> all;
  for (std::size_t k = 0; k < split_choices(kChoices<Experiment>).size(); ++k)
    all.push_back(static_cast<Experiment>(k));
  return all;
}

TEST(Experiments, HaveARowEach) {
  std::set<std::string> meanings;
  for (const Experiment experiment : all_experiments()) {
    const std::string meaning = experiment_row(experiment).meaning;
    EXPECT_FALSE(meaning.empty()) << name_of_choice(experiment);
    EXPECT_TRUE(meanings.insert(meaning).second) << meaning;
  }
  EXPECT_GT(meanings.size(), 1U);
}

TEST(Observables, HaveUniqueNamesUnitsAndMeanings) {
  for (const Experiment experiment : all_experiments()) {
    std::set<std::string> seen{"time"};
    for (const Observable& o : known_observables(experiment)) {
      EXPECT_TRUE(seen.insert(o.name).second)
          << name_of_choice(experiment) << " has " << o.name << " twice";
      EXPECT_FALSE(o.unit.empty()) << o.name;
      EXPECT_FALSE(o.meaning.empty()) << o.name;
    }
  }
}

/// Every series of a frame is an observable, and every observable has a series.
TEST(Observables, AreWhatTheExperimentsMeasure) {
  for (const Experiment experiment : all_experiments()) {
    Scene scene = lobule_scene();
    scene.experiment = experiment;
    scene.cells.list.resize(2);
    Watched w(scene, coupling::make_test_world(
                         {{Vec3(60, 0, 20), true}, {Vec3(83.5, 0, 20), false}}, 60, 42));
    contact::Plane plane;
    plane.name = "left wall";
    plane.point = Vec3(48.5, 0, 0);
    plane.normal = Vec3::UnitX();
    plane.material = {};
    w.world.params.boundary.planes = {plane};
    contact::Capsule capsule;
    capsule.name = "capsule";
    capsule.center = Vec3(72, 0, 20);
    capsule.radius = 60;
    w.world.params.boundary.capsules = {capsule};
    w.snapshot = take_snapshot(w.world, w.work);
    w.look(3600);
    std::set<std::string> row;
    for (const io::SeriesValue& v : w.row) {
      EXPECT_TRUE(std::isfinite(v.value)) << v.name;
      row.insert(v.name);
    }
    EXPECT_EQ(w["time"], 3600);
    EXPECT_EQ(w["cells_dcm"], 1);
    EXPECT_LT(w["wall_left_wall_net_x_nN"], 0) << "pushed to the left";
    const std::set<std::string> not_columns{"time_s",
                                            "time_d",
                                            "profile_radius_um",
                                            "pressure_profile_Pa",
                                            "density_profile",
                                            "cytosol_pressure_profile_Pa"};
    for (const auto& [name, values] : w.observer.measures)
      // The recovery of a relaxation is computed anew from the series at every frame.
      EXPECT_TRUE(experiment == Experiment::kRelaxation || row.contains(name) ||
                  not_columns.contains(name))
          << name_of_choice(experiment) << ": " << name;
    for (const std::string& name : row)
      EXPECT_TRUE(name == "time" || w.observer.measures.contains(name))
          << name_of_choice(experiment) << ": " << name;
  }
}

TEST(Observables, WithoutMembersAreZero) {
  Scene scene;
  scene.experiment = Experiment::kSpheroid;
  Watched w(scene, coupling::make_test_world({{Vec3::Zero(), false}}));
  w.look();
  EXPECT_EQ(w["cells_dcm"], 0);
  EXPECT_EQ(w["contact_pressure_mean_dcm_Pa"], 0);
  EXPECT_EQ(w["sphericity"], 0);
  EXPECT_EQ(w["inner_density"], 0) << "one cell has none";
  EXPECT_EQ(w["inner_cells"], 1);
}

TEST(Tissue, TellsOverlapsOfSpheresWithVesselsAndEachOther) {
  coupling::World world =
      coupling::make_test_world({{Vec3(0, 15.7, 0), false}, {Vec3(22, 15.7, 0), false}});
  geometry::Network n;
  n.node = {Vec3(-30, 0, 0), Vec3(50, 0, 0)};
  n.segment = {{0, 1}};
  n.radius = {{4.7, 4.7}};
  contact::set_network(world.params.boundary.vessels, n);
  world.params.boundary.vessels.material = {0, 0.6, 0.4, false};
  Watched w({}, world);
  w.look();
  EXPECT_NEAR(w["overlap_cbm_vessels_um"], 1, 1e-11);
  EXPECT_EQ(w["overlap_vessels_um"], w["overlap_cbm_vessels_um"]);
  EXPECT_NEAR(w["overlap_cbm_cbm_um"], 2, 1e-11);
  EXPECT_EQ(w["overlap_dcm_vessels_um"], 0);
  EXPECT_LT(w["vessels_net_y_nN"], 0);
  EXPECT_NEAR(w["vessels_force_nN"], -w["vessels_net_y_nN"], kRoundOff * w["vessels_force_nN"]);
}

TEST(Tissue, CountsWhatHangsTogether) {
  Watched w({}, coupling::make_test_world({{Vec3(0, 0, 0), true},
                                           {Vec3(23.5, 0, 0), false},
                                           {Vec3(47, 0, 0), true},
                                           {Vec3(0, 100, 0), false},
                                           {Vec3(0, 123, 0), false},
                                           {Vec3(0, 0, 100), false}}));
  w.look();
  EXPECT_EQ(w["detached_cells"], 1);
  EXPECT_EQ(w["cells_in_small_clusters"], 3);
  EXPECT_EQ(w["clusters"], 3);
  EXPECT_EQ(w["interface_pairs"], 2);
  EXPECT_GT(w["interface_force_nN"], 0);
  EXPECT_LT(w["interface_residual"], 1e-14);
}

TEST(Lesion, OfCellsOnARingIsTheRing) {
  Watched w(lobule_scene(), coupling::make_test_world(ring(100)));
  w.look(0);
  for (const char* reading : {"slices", "rings"}) {
    const std::string name = std::string("lesion_radius_") + reading;
    EXPECT_NEAR(w[name + "_centre_um"], 100, 1e-10);
    EXPECT_NEAR(w[name + "_surface_um"], 88, 1e-10);
  }
  EXPECT_EQ(w["lesion_area_relative"], 1);
  EXPECT_EQ(w["lesion_area_open"], 1);
  EXPECT_EQ(w["cells_layer_1"], 16);
  move_inward(w.snapshot, 40);
  w.look(86400);
  EXPECT_NEAR(w["lesion_area_slices_centre"], 0.36, kRoundOff);
  EXPECT_NEAR(w["lesion_area_slices_surface"], std::pow(48.0 / 88, 2), kRoundOff);
  EXPECT_NEAR(w["lesion_area_slices_centre_floor"], std::pow((60.0 - 22) / (100 - 22), 2),
              kRoundOff);
  EXPECT_NEAR(w["lesion_area_slices_surface_floor"], std::pow((48.0 - 10) / (88 - 10), 2),
              kRoundOff);
  EXPECT_NEAR(w["lesion_area_rings_centre_floor"], std::pow((60.0 - 46) / (100 - 46), 2),
              kRoundOff);
  EXPECT_EQ(w["lesion_area_relative"], w["lesion_area_slices_centre_floor"]);
  // All cells are inside the initial lesion now: it is less by their volume over the height.
  const double open = kPi * (88 * 88 - 100);
  EXPECT_NEAR(w["lesion_area_open_um2"], open - 16 * 4.0 / 3 * kPi * 1728 / 48, 0.02 * open);
  EXPECT_GT(w["front_roughness_um"], 5) << "there is space between the cells";
}

TEST(Lesion, ClosestCellOfEveryLayerCounts) {
  // Both slices have one cell that is nearer; rings: nearest cells at 60, 84 and 108.
  Watched w(lobule_scene(), coupling::make_test_world({{Vec3(60, 0, 10), false},
                                                       {Vec3(84, 0, 10), false},
                                                       {Vec3(108, 0, 10), false},
                                                       {Vec3(132, 0, 10), false},
                                                       {Vec3(0, 90, 40), false}}));
  w.look();
  EXPECT_NEAR(w["lesion_radius_slices_centre_um"], 75, 1e-10);
  EXPECT_NEAR(w["lesion_radius_slices_surface_um"], 63, 1e-10);
  EXPECT_NEAR(w["lesion_radius_rings_centre_um"], 84, 1e-10);
  EXPECT_NEAR(w["lesion_radius_rings_surface_um"], 72, 1e-10);
  EXPECT_EQ(w["cells_layer_1"], 2);
  EXPECT_EQ(w["cells_layer_4"], 1);
}

TEST(Lesion, SurfaceOfADeformableCellIsItsNearestEdge) {
  Watched w(lobule_scene(), coupling::make_test_world({{Vec3(70, 0, 20), true}}));
  w.look();
  double least = 1e300;
  for (const Vec3& x : w.work.dcm.body[0].node) least = std::min(least, std::hypot(x.x(), x.y()));
  EXPECT_LE(w["lesion_radius_slices_surface_um"], least);
  // An edge of 6.5 um bows less than 0.5 um behind the sphere through its ends.
  EXPECT_NEAR(w["lesion_radius_slices_surface_um"], 58, 0.5);
}

TEST(Lesion, KeepsItsFirstFrameThroughACheckpoint) {
  Watched w(lobule_scene(), coupling::make_test_world(ring(100)));
  w.look(0);
  move_inward(w.snapshot, 20);
  w.look(3600);
  io::CheckpointData data;
  put_observed_run(w.observer, data);
  Watched resumed(lobule_scene(), coupling::make_test_world(ring(100)));
  resumed.observer = get_observed_run(data);
  move_inward(w.snapshot, 20);
  resumed.snapshot = w.snapshot;
  w.look(7200);
  resumed.look(7200);
  ASSERT_EQ(w.row.size(), resumed.row.size());
  for (std::size_t k = 0; k < w.row.size(); ++k)
    EXPECT_EQ(w.row[k].value, resumed.row[k].value) << w.row[k].name;
  EXPECT_EQ(w.observer.measures, resumed.observer.measures);
  EXPECT_NEAR(w["lesion_area_slices_centre"], 0.36, kRoundOff);
}

TEST(Lesion, SpeedsOfLeadersAndFollowers) {
  Watched w(lobule_scene(), coupling::make_test_world(ring(100)));
  for (std::size_t k = 0; k < 4; ++k) w.snapshot.cells[k].leader = true;
  w.look(0);
  EXPECT_EQ(w["leaders"], 4);
  EXPECT_EQ(w["leader_speed_cells"], 0);
  EXPECT_EQ(w["leader_speed_um_h"], 0);
  // Those that led go 6 um in two hours, the others 1 um; then others lead, and one cell is new.
  Snapshot fast = w.snapshot, slow = w.snapshot;
  move_inward(fast, 6);
  move_inward(slow, 1);
  for (std::size_t k = 0; k < w.snapshot.cells.size(); ++k) {
    w.snapshot.cells[k] = k < 4 ? fast.cells[k] : slow.cells[k];
    w.snapshot.cells[k].leader = k >= 4;
  }
  w.snapshot.cells[15].id = 99;
  w.look(7200);
  EXPECT_NEAR(w["leader_speed_um_h"], 3, 1e-10);
  EXPECT_EQ(w["leader_speed_cells"], 4);
  EXPECT_NEAR(w["follower_speed_um_h"], 0.5, 1e-10);
  EXPECT_EQ(w["follower_speed_cells"], 11);
  EXPECT_EQ(w["leaders"], 12);
}

TEST(Lesion, BirthsCountInTheLayerTheyHappenIn) {
  Watched w(lobule_scene(), coupling::make_test_world({{Vec3(60, 0, 10), false},
                                                       {Vec3(84, 1, 10), false},
                                                       {Vec3(84, -1, 10), false},
                                                       {Vec3(0, 90, 40), true},
                                                       {Vec3(0, 92, 40), true}}));
  coupling::LifeReport report;
  report.events = {{coupling::EventKind::kDivision, {7, 1, 2}, ""},
                   {coupling::EventKind::kDivision, {8, 3, 4}, ""},
                   {coupling::EventKind::kDeath, {5}, ""}};
  observe_births(w.scene, w.world, report, w.observer);
  w.look();
  EXPECT_EQ(w["births"], 2);
  EXPECT_EQ(w["births_layer_1"], 1);
  EXPECT_EQ(w["births_layer_2"], 1);
  EXPECT_EQ(w["births_layer_beyond"], 0);
}

TEST(Lesion, DensityIsOfTheVolumeOutsideVessels) {
  coupling::World world = coupling::make_test_world(ring(100));
  Watched bare(lobule_scene(), world);
  bare.look();
  const double volume = 6 * std::sqrt(3.0) / 4 * 280 * 280 * 48;
  EXPECT_NEAR(bare["density_per_mm3"], 16e9 / volume, kRoundOff * 16e9 / volume);
  const double tissue = volume - kPi * (88 * 88 - 100) * 48;
  EXPECT_NEAR(bare["density_tissue_per_mm3"], 16e9 / tissue, 1e-6 * 16e9 / tissue);
  geometry::Network n;
  n.node = {Vec3(200, 0, -20), Vec3(200, 0, 70)};
  n.segment = {{0, 1}};
  n.radius = {{15, 15}};
  contact::set_network(world.params.boundary.vessels, n);
  world.params.boundary.vessels.material = {};
  Watched with(lobule_scene(), world);
  with.look();
  const double free = 16e9 / with["density_per_mm3"];
  // Counted in cubes of 2 um, 7.5 to a radius: the number of lattice points in a circle is off by
  // less than 2 r^(2/3), here 7.7 of 177.
  EXPECT_NEAR((volume - free) / (kPi * 225 * 48), 1, 0.043);
  EXPECT_EQ(with["sinusoid_contact_area_um2"], 0) << "wider than the central vein: no sinusoid";
  EXPECT_EQ(with["sinusoid_distance_um"], 0);
}

TEST(Lesion, ContactWithSinusoidsIsThatOfTheContacts) {
  coupling::World world =
      coupling::make_test_world({{Vec3(100, 16, 20), false}, {Vec3(140, -16.4, 20), true}});
  geometry::Network n;
  n.node = {Vec3(60, 0, 20), Vec3(180, 0, 20)};
  n.segment = {{0, 1}};
  n.radius = {{4.7, 4.7}};
  contact::set_network(world.params.boundary.vessels, n);
  world.params.boundary.vessels.material = {0, 0.6, 0.4, false};
  Watched w(lobule_scene(), world);
  w.look();
  double area = 0;
  coupling::visit_contacts(w.world, w.work,
                           [&](const coupling::ContactForce& c) { area += c.area; });
  EXPECT_GT(area, 10);
  EXPECT_NEAR(w["sinusoid_contact_area_um2"], area, kRoundOff * area);
  EXPECT_NEAR(w["sinusoid_contact_area_per_cell_um2"], area / 2, kRoundOff * area);
  EXPECT_NEAR(w["sinusoid_distance_um"], 0.5 * (16 + 16.4) - 4.7, 0.01);
}

TEST(Lesion, ClosesBetweenTwoFrames) {
  EXPECT_FALSE(closing_time({0, 1, 2}, {1, 0.5, 0.05}));
  EXPECT_NEAR(*closing_time({0, 1, 2, 3}, {1, 0.5, 0.07, 0.03}), 2.5, kRoundOff);
  EXPECT_EQ(*closing_time({0, 1}, {0, 0}), 0);
  EXPECT_FALSE(closing_time({}, {}));
}

TEST(Observables, DoNotDependOnTheNumberOfThreads) {
  const int before = thread_count();
  std::vector<io::SeriesValue> row[2];
  for (const int threads : {1, 3}) {
    set_threads(threads);
    std::vector<coupling::TestCell> cells = ring(60);
    for (std::size_t k = 0; k < cells.size(); k += 2) cells[k].deformable = true;
    Watched w(lobule_scene(), coupling::make_test_world(cells, 60, 42));
    w.look();
    row[threads / 2] = w.row;
  }
  set_threads(before);
  for (std::size_t k = 0; k < row[0].size(); ++k)
    EXPECT_EQ(row[0][k].value, row[1][k].value) << row[0][k].name;
}

}  // namespace
}  // namespace acinus::runs
