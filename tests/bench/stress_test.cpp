/// Scene generator of the stress suite, and the judge of what runs leave behind.

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "bench/stress/inspect.hpp"
#include "bench/stress/random_scene.hpp"
#include "coupling/step/workspace_size.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/session/make_frame.hpp"
#include "runs/session/soundness.hpp"
#include "tests/runs/scene_texts.hpp"

namespace acinus::bench {
namespace {

constexpr std::uint64_t kSeeds = 300;

std::vector<runs::Scene> read_scenes(bool life) {
  const runs::scene_texts::TemporaryFolder folder;
  std::vector<runs::Scene> scenes;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RandomScene drawn = draw_scene(seed, {.life = life});
    if (!drawn.network.empty()) folder.write(kNetworkFile, drawn.network);
    scenes.push_back(runs::read_scene(folder.write("scene.json", drawn.text)));
    const runs::BuiltWorld built = runs::build_world(scenes.back(), Ranks::serial());
    const coupling::State& s = built.world.state;
    const int cells = dcm::count_cells(s.dcm) + static_cast<int>(s.cbm.n_cell());
    EXPECT_GE(cells, 1) << "seed " << seed;
    EXPECT_LE(cells, 64) << "seed " << seed;
    EXPECT_LE(cells, drawn.cells) << "seed " << seed;
  }
  return scenes;
}

/// Seeds 1 .. kSeeds as the program reads them.
const std::vector<runs::Scene>& drawn_scenes() {
  static const std::vector<runs::Scene> all = read_scenes(false);
  return all;
}
const std::vector<runs::Scene>& living_scenes() {
  static const std::vector<runs::Scene> all = read_scenes(true);
  return all;
}

const runs::CellType& type_of(const runs::Scene& scene) { return scene.cell_types.begin()->second; }

TEST(RandomScene, IsTheSameTextEveryTimeAndAnotherForAnotherSeed) {
  std::set<std::string> texts;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const RandomScene a = draw_scene(seed), b = draw_scene(seed);
    EXPECT_EQ(a.text, b.text);
    EXPECT_EQ(a.network, b.network);
    texts.insert(a.text);
  }
  EXPECT_EQ(texts.size(), 50u);
}

/// Fixed scenes of seeds: FNV-1a of the texts, without life and with the integrators there
/// are.
// Without the law between triangles, which is an addition to the same scene.
TEST(RandomScene, IsTheSceneItHasAlwaysBeen) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RandomScene drawn = draw_scene(seed, {.law = "cohesive"});
    for (const char c : drawn.text + drawn.network)
      hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  }
  EXPECT_EQ(hash, 0x2f0919ae8f21e2f1u) << std::hex << hash;
}

using Json = nlohmann::json;

/// Takes the lengths of cells out of a scene: radii um; spacing and jitter in diameters.
struct Lengths {
  std::vector<double> radius, relative;
};
Lengths take_lengths(Json& scene) {
  Lengths l;
  const auto take = [&](Json& cell) {
    l.radius.push_back(std::stod(cell["radius"].get<std::string>()));
    cell.erase("radius");
  };
  Json& cells = scene["cells"];
  take(scene["cell_types"]["cell"]);
  if (cells.contains("list"))
    for (Json& cell : cells["list"]) take(cell);
  for (const char* key : {"spacing", "jitter"}) {
    if (cells.contains(key)) l.relative.push_back(cells[key]);
    cells.erase(key);
  }
  return l;
}

TEST(RandomScene, TheLawChangesNothingElse) {
  int triangles = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Json drawn = Json::parse(draw_scene(seed).text),
         forced = Json::parse(draw_scene(seed, {.law = "maugis-dugdale"}).text),
         without = Json::parse(draw_scene(seed, {.law = "cohesive"}).text);
    EXPECT_EQ(forced["contact"],
              Json::parse(R"({"law": "maugis-dugdale", "quadrature": "3-point"})"));
    EXPECT_FALSE(without["contact"].contains("law")) << seed;
    EXPECT_EQ(drawn, drawn["contact"].contains("law") ? forced : without) << seed;
    triangles += drawn["contact"].contains("law") ? 1 : 0;
    forced.erase("contact");
    without.erase("contact");
    EXPECT_EQ(forced, without) << seed;
  }
  EXPECT_GT(triangles, 0.1 * kSeeds);
  EXPECT_LT(triangles, 0.2 * kSeeds);
}

TEST(RandomScene, LifeIsAnAdditionToTheSameScene) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const RandomScene with = draw_scene(seed, {.life = true}), without = draw_scene(seed);
    EXPECT_EQ(with.network, without.network);
    Json living = Json::parse(with.text), plain = Json::parse(without.text);
    ASSERT_TRUE(living.contains("life")) << seed;
    living.erase("life");
    living["time"].erase("until_cells");
    for (const char* key : {"cycle", "inhibition", "death"})
      living["cell_types"]["cell"].erase(key);
    plain["time"].erase("integrator");
    for (Json* scene : {&living, &plain}) scene->erase("rules");  // growth and death need life
    if (living.contains("moving_zoom")) {
      living.erase("moving_zoom");
      for (Json* scene : {&living, &plain}) {
        scene->erase("zoom");
        (*scene)["cells"].erase("model");
      }
    }
    // Where cells start anywhere in their cycle, the oldest are as large as those of the scene.
    const auto& cycle = living_scenes()[seed - 1].cell_types.begin()->second.cycle;
    const double smaller = cycle.time > 0 && cycle.random_start ? std::cbrt(0.5) : 1;
    const Lengths has = take_lengths(living), had = take_lengths(plain);
    ASSERT_EQ(has.radius.size(), had.radius.size());
    ASSERT_EQ(has.relative.size(), had.relative.size());
    for (std::size_t k = 0; k < has.radius.size(); ++k)  // texts have five digits
      EXPECT_NEAR(has.radius[k], smaller * had.radius[k], 1e-4 * had.radius[k]) << seed;
    for (std::size_t k = 0; k < has.relative.size(); ++k)
      EXPECT_NEAR(smaller * has.relative[k], had.relative[k], 1e-12) << seed;
    EXPECT_EQ(living, plain) << seed;
  }
}

TEST(RandomScene, IsAcceptedByTheProgram) {
  try {
    EXPECT_EQ(drawn_scenes().size(), kSeeds);
    EXPECT_EQ(living_scenes().size(), kSeeds);
  } catch (const Error& error) {
    FAIL() << error.what();
  }
}

TEST(RandomScene, NominalParametersStayInsideTheTable) {
  for (const runs::Scene& s : drawn_scenes()) {
    if (family_of(s.seed) != Family::kNominal) continue;
    const runs::CellType& t = type_of(s);
    EXPECT_TRUE(t.radius >= 8.8 && t.radius <= 12) << s.seed;
    EXPECT_TRUE(t.adhesion >= 0.01 - 1e-6 && t.adhesion <= 0.05 + 1e-6) << s.seed;
    EXPECT_TRUE(t.dcm.bulk_modulus >= 0.75 - 1e-6 && t.dcm.bulk_modulus <= 2.5 + 1e-6) << s.seed;
    EXPECT_DOUBLE_EQ(t.dcm.cortex_young, 1);
    EXPECT_DOUBLE_EQ(t.dcm.medium_friction, 0.1);
    EXPECT_DOUBLE_EQ(t.cbm.medium_friction, 0.5);
    EXPECT_DOUBLE_EQ(t.diffusion, 1e-4);
    EXPECT_DOUBLE_EQ(s.contact.cell_friction, 50);
    EXPECT_TRUE(s.numerics.max_step >= 5 - 1e-3 && s.numerics.max_step <= 120 + 1e-3) << s.seed;
    EXPECT_TRUE(s.numerics.adaptive) << s.seed;
    EXPECT_EQ(s.numerics.integrator, coupling::Integrator::kLinearlyImplicit) << s.seed;
    EXPECT_LE(s.motility.leader_force, 1 + 1e-6) << s.seed;
  }
}

TEST(RandomScene, WideParametersCoverTheirDecades) {
  struct Interval {
    double low = std::numeric_limits<double>::infinity(), high = 0;
    void add(double x) { low = std::min(low, x), high = std::max(high, x); }
  } young, friction, adhesion, step;
  int uncontrolled = 0;
  for (const runs::Scene& s : drawn_scenes()) {
    if (family_of(s.seed) != Family::kWide) continue;
    young.add(type_of(s).dcm.cortex_young);
    friction.add(s.contact.cell_friction);
    adhesion.add(type_of(s).adhesion);
    step.add(s.numerics.max_step);
    uncontrolled += s.numerics.adaptive ? 0 : 1;
    EXPECT_LE(s.motility.leader_force, 10 + 1e-6);
  }
  // 150 uniform draws leave the outer twentieth of a range empty once in 2000 times.
  const auto expect_covered = [](const Interval& r, double low, double high, const char* what) {
    const double margin = std::pow(high / low, 0.05), rounding = 1 + 1e-4;
    EXPECT_TRUE(r.low >= low / rounding && r.low <= low * margin) << what << " " << r.low;
    EXPECT_TRUE(r.high <= high * rounding && r.high >= high / margin) << what << " " << r.high;
  };
  expect_covered(young, 0.1, 10, "cortex Young's modulus, kPa");
  expect_covered(friction, 5, 500, "friction, nN s/um^3");
  expect_covered(adhesion, 1e-3, 1, "adhesion, nN/um");
  expect_covered(step, 1, 1800, "step, s");
  EXPECT_GT(uncontrolled, 15);
}

TEST(RandomScene, MeetsEverySituation) {
  std::set<std::string> seen;
  for (const runs::Scene& s : drawn_scenes()) {
    seen.insert(runs::name_of_choice(s.cells.source));
    seen.insert(runs::name_of_choice(s.contact.quadrature));
    seen.insert(runs::name_of_choice(s.numerics.integrator));
    seen.insert(s.friction.liquid ? "liquid" : "ecm");
    seen.insert(std::to_string(type_of(s).dcm.nodes));
    seen.insert("model " + runs::name_of_choice(model_of(s)));
    if (s.capsule.enabled) seen.insert("capsule");
    if (!s.walls.empty()) seen.insert("walls");
    if (s.motility.leader_force > 0) seen.insert("leaders");
    if (s.start_up.enabled) seen.insert("start-up");
  }
  for (const char* what : {"clump", "list", "box", "fill", "lobule", "3-point", "nodes",
                           "linearly-implicit", "liquid", "42", "162", "642", "model dcm",
                           "model cbm", "model zoom", "capsule", "walls", "leaders", "start-up"})
    EXPECT_TRUE(seen.contains(what)) << what;
}

TEST(RandomScene, MeetsEveryKindOfLife) {
  std::set<std::string> seen;
  int dividing = 0;
  for (const runs::Scene& s : living_scenes()) {
    const runs::CellType& t = type_of(s);
    seen.insert("by " + runs::name_of_choice(t.cycle.inhibition.by));
    seen.insert(t.cycle.death.lysis ? "lysis" : "removal");
    if (t.softening < 1) seen.insert("soft");
    if (s.life.sleep) seen.insert("sleep");
    seen.insert(s.life.remesh ? "remesh" : "no remesh");
    for (const runs::LifeRuleBlock& r : s.life.rules) {
      seen.insert(r.die ? "die" : "rest");
      if (r.region) seen.insert(runs::name_of_choice(r.region->kind));
      if (!r.cells.empty()) seen.insert(r.descendants ? "kin" : "one");
      if (r.share == 1 && std::isinf(r.until)) seen.insert("everybody");
    }
    if (t.cycle.time == 0) continue;
    seen.insert(runs::name_of_choice(t.cycle.axis));
    seen.insert(std::string("start ") + (t.cycle.random_start ? "random" : "birth"));
    if (t.cycle.random_start || t.cycle.time < 0.9 * s.time.end) ++dividing;
    if (family_of(s.seed) == Family::kNominal) {
      EXPECT_GE(t.cycle.time, 1800) << s.seed;
      EXPECT_LE(t.cycle.mitosis, 0.2 * t.cycle.time * (1 + 1e-4)) << s.seed;
    }
  }
  for (const char* what :
       {"by none", "by pressure", "by volume",    "removal",    "lysis",  "soft",
        "sleep",   "remesh",      "no remesh",    "die",        "rest",   "half_space",
        "sphere",  "kin",         "one",          "everybody",  "random", "plane",
        "given",   "vessel",      "start random", "start birth"})
    EXPECT_TRUE(seen.contains(what)) << what;
  EXPECT_GT(dividing, 200);
}

/// Two deformable cells and a sphere, each in touch with nothing; a wall below.
class Inspection : public testing::Test {
 protected:
  Inspection()
      : scene_(runs::parse_scene(R"({
  "time": {"end": "1 h"}, "cell_types": {"cell": {"dcm": {"nodes": 42}}},
  "motility": {"random": false},
  "cells": {"source": "list", "list": [
    {"position": ["0 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["30 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["0 um", "30 um", "0 um"], "model": "cbm"}]},
  "walls": [{"point": ["0 um", "0 um", "-13 um"], "normal": [0, 0, 1], "mirror": true}]})",
                                 "two.json")),
        start_(runs::build_world(scene_, Ranks::serial()).world) {
    coupling::World world = start_;
    coupling::Workspace work;
    coupling::size_workspace(world, work);
    const runs::Snapshot snapshot = runs::take_snapshot(world, work);
    frame_ = runs::make_frame(world, work, snapshot, {});
  }
  /// Moves the nodes of a deformable cell: f(node position) -> new position.
  template <class F>
  void change_cell(int cell, F f) {
    for (int n = 42 * cell; n < 42 * (cell + 1); ++n) {
      float* x = frame_.point.data() + 3 * n;
      const Vec3 y = f(Vec3(x[0], x[1], x[2]));
      for (int k = 0; k < 3; ++k) x[k] = static_cast<float>(y[k]);
    }
  }
  std::set<Defect> defects() const {
    std::set<Defect> all;
    for (const Finding& f : inspect_frame(frame_, scene_, start_, Pedigree(start_)))
      all.insert(f.defect);
    return all;
  }

  runs::Scene scene_;
  coupling::World start_;
  io::Frame frame_;
};

using Found = std::set<Defect>;

TEST_F(Inspection, FindsNothingInASoundFrame) {
  EXPECT_EQ(frame_.n_mesh_node, 84);
  EXPECT_EQ(defects(), Found{});
}

TEST_F(Inspection, FindsANumberThatIsNotFinite) {
  const io::Frame sound = frame_;
  frame_.point[100] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(defects(), Found{Defect::kNotFinite});
  frame_ = sound;
  frame_.cell_data[0].value[3] = std::numeric_limits<float>::infinity();
  EXPECT_EQ(defects(), Found{Defect::kNotFinite});
}

TEST_F(Inspection, FindsACellTurnedInsideOut) {
  change_cell(1, [](const Vec3& x) { return Vec3(60 - x.x(), x.y(), x.z()); });
  EXPECT_TRUE(defects().contains(Defect::kInverted));
}

TEST_F(Inspection, FindsASurfaceThatCrossesItself) {
  int moved = 0;
  change_cell(0, [&](const Vec3& x) { return moved++ == 0 ? Vec3(-1.2 * x) : x; });
  EXPECT_TRUE(defects().contains(Defect::kCrossed));
}

TEST_F(Inspection, FindsACellInsideAnother) {
  change_cell(1, [](const Vec3& x) { return Vec3(0.4 * (x - Vec3(30, 0, 0))); });
  EXPECT_TRUE(defects().contains(Defect::kTunnelled));
}

TEST_F(Inspection, AllowsAnOverlapThatContactsStillSee) {
  const auto overlap = [&](double depth) {
    double high = 0, low = 1e9;
    change_cell(0, [&](const Vec3& x) { return high = std::max(high, x.x()), x; });
    change_cell(1, [&](const Vec3& x) { return low = std::min(low, x.x()), x; });
    change_cell(1, [&](const Vec3& x) { return Vec3(x.x() - low + high - depth, x.y(), x.z()); });
  };
  overlap(0.9 * runs::deepest_overlap(start_));
  EXPECT_EQ(defects(), Found{});
  overlap(1.5 * runs::deepest_overlap(start_));  // a tip is a little less deep than boxes overlap
  EXPECT_TRUE(defects().contains(Defect::kTunnelled));
}

TEST_F(Inspection, FindsACellBehindAWall) {
  change_cell(0, [](const Vec3& x) { return Vec3(x.x(), x.y(), x.z() - 4); });
  EXPECT_EQ(defects(), Found{Defect::kTunnelled});
}

TEST_F(Inspection, FindsASphereBehindAWallOrOverACell) {
  float* center = frame_.point.data() + 3 * 84;
  center[2] = -14;
  EXPECT_EQ(defects(), Found{Defect::kTunnelled});
  center[1] = center[2] = 0;
  EXPECT_TRUE(defects().contains(Defect::kTunnelled));
}

TEST_F(Inspection, FindsACollapsedCellAndOneThatFlewAway) {
  const io::Frame sound = frame_;
  change_cell(0, [](const Vec3& x) { return Vec3(0.4 * x); });
  EXPECT_EQ(defects(), Found{Defect::kVolume});
  frame_ = sound;
  change_cell(1, [](const Vec3& x) { return Vec3(x.x() + 1000, x.y(), x.z()); });
  EXPECT_EQ(defects(), Found{Defect::kLost});
}

}  // namespace
}  // namespace acinus::bench
