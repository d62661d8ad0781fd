/// Tests of the judge of the stress suite on cells that divide and die.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bench/stress/inspect.hpp"
#include "coupling/life/life.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/session/make_frame.hpp"

namespace acinus::bench {
namespace {

using Found = std::set<Defect>;

/// Deformable cell and sphere that divide, and one of each that dissolve, all far apart; run
/// by hand until a quarter of a cycle after both have divided. Two frames a cycle.
class LifeInspection : public testing::Test {
 protected:
  struct Record {
    std::vector<io::Frame> frames;
    std::vector<io::Event> events;
  };
  static constexpr double kCycle = 1000, kDuration = 600;  // s

  LifeInspection()
      : scene_(runs::parse_scene(R"({
  "time": {"end": "1250 s", "step": "50 s"},
  "cell_types": {"cell": {"dcm": {"nodes": 42},
    "cycle": {"time": "1000 s", "spread": 0, "mitosis": "100 s", "axis": "given",
              "direction": [0, 0, 1]},
    "death": {"mode": "lysis", "duration": "600 s", "final_volume": 0.4}}},
  "motility": {"random": false},
  "life": {"grid": "100 s", "remesh": false,
           "rules": [{"do": "die", "cells": [1, 3], "from": "200 s", "until": "400 s"}]},
  "cells": {"source": "list", "list": [
    {"position": ["0 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["60 um", "0 um", "0 um"], "model": "dcm"},
    {"position": ["0 um", "60 um", "0 um"], "model": "cbm"},
    {"position": ["60 um", "60 um", "0 um"], "model": "cbm"}]}})",
                                 "life.json")),
        start_(runs::build_world(scene_, Ranks::serial()).world),
        record_(sound()) {}

  /// Run made once for all tests.
  const Record& sound() const {
    static const Record record = live_through(start_);
    return record;
  }
  static Record live_through(coupling::World world) {
    Record record;
    coupling::Workspace work;
    coupling::size_workspace(world, work);
    const auto write = [&] {
      const runs::Snapshot snapshot = runs::take_snapshot(world, work);
      record.frames.push_back(runs::make_frame(world, work, snapshot, {}));
    };
    write();
    for (double next = 500; next <= 1250; next += 250) {
      for (double time = 0; time < next - 1e-6;) {
        const double limit =
            std::min(next - coupling::time_since_start(world), coupling::time_to_event(world));
        EXPECT_TRUE(coupling::take_step(world, work, limit).accepted);
        time = coupling::time_since_start(world);
        for (const coupling::LifeEvent& e : coupling::live(world, work).events)
          record.events.push_back({time, name_of(e.kind), e.cells, e.message});
      }
      if (next != 750) write();
    }
    return record;
  }
  io::Event& event(const std::string& code) {
    return *std::ranges::find(record_.events, code, &io::Event::code);
  }
  io::Event& division_of(std::int64_t mother) {
    return *std::ranges::find_if(record_.events, [&](const io::Event& e) {
      return e.code == "division" && e.cell_id[0] == mother;
    });
  }
  /// Takes all cells of an id out of a frame's table.
  static void forget(io::Frame& f, std::int64_t id) {
    const auto& ids = f.cells.ids.front().value;
    const auto at = std::ranges::find(ids, id) - ids.begin();
    for (io::IdColumn& c : f.cells.ids) c.value.erase(c.value.begin() + at);
    for (io::Column& c : f.cells.columns)
      c.value.erase(c.value.begin() + at * c.components, c.value.begin() + (at + 1) * c.components);
  }
  static double& radius_of(io::Frame& f, std::int64_t id) {
    const auto& ids = f.cells.ids.front().value;
    const auto at = std::ranges::find(ids, id) - ids.begin();
    return std::ranges::find(f.cells.columns, "radius", &io::Column::name)->value[at];
  }
  /// Nodes of a deformable cell: f(position) -> new position.
  template <class F>
  static void change_cell(io::Frame& frame, std::int64_t id, F f) {
    std::set<std::int64_t> nodes;
    for (std::size_t t = 0; t < frame.triangle.size(); ++t)
      if (frame.cell_id[t] == id) nodes.insert(frame.triangle[t].begin(), frame.triangle[t].end());
    for (const std::int64_t n : nodes) {
      float* x = frame.point.data() + 3 * n;
      const Vec3 y = f(Vec3(x[0], x[1], x[2]));
      for (int k = 0; k < 3; ++k) x[k] = static_cast<float>(y[k]);
    }
  }
  std::vector<Finding> find() const {
    return inspect_frames(record_.frames, record_.events, scene_, start_);
  }
  std::set<Defect> defects() const {
    std::set<Defect> all;
    for (const Finding& f : find()) all.insert(f.defect);
    return all;
  }

  runs::Scene scene_;
  coupling::World start_;
  Record record_;
};

TEST_F(LifeInspection, FindsNothingWhereCellsDivideAndDieAsTheyShould) {
  int divisions = 0, deaths = 0;
  for (const io::Event& e : record_.events) {
    divisions += e.code == "division" ? 1 : 0;
    deaths += e.code == "death" ? 1 : 0;
  }
  EXPECT_EQ(divisions, 2);
  EXPECT_EQ(deaths, 2);
  for (const Finding& f : find()) ADD_FAILURE() << name_of(f.defect) << " " << f.what;
}

TEST_F(LifeInspection, FindsADivisionAndADeathNobodyTold) {
  std::erase_if(record_.events, [](const io::Event& e) { return e.code == "division"; });
  // The daughters are unborn, the mothers gone, and they had not divided in time.
  EXPECT_EQ(defects(), (Found{Defect::kUnborn, Defect::kVanished, Defect::kUntimely}));
  record_ = sound();
  std::erase_if(record_.events, [](const io::Event& e) { return e.code == "death"; });
  EXPECT_TRUE(defects().contains(Defect::kVanished));
}

TEST_F(LifeInspection, FindsACellThatVanishes) {
  io::Frame& last = record_.frames.back();
  forget(last, last.cells.ids.front().value.front());
  EXPECT_TRUE(defects().contains(Defect::kVanished));
}

TEST_F(LifeInspection, FindsTheDeadAmongTheLivingAndAWrongMother) {
  io::Event early = event("death");
  std::erase_if(record_.events, [&](const io::Event& e) { return e.cell_id == early.cell_id; });
  early.time_s = 490;  // the frame of 500 s still shows the cell
  record_.events.insert(record_.events.begin(), early);
  EXPECT_EQ(defects(), (Found{Defect::kUnborn, Defect::kUntimely}));
  record_ = sound();
  for (io::IdColumn& c : record_.frames.back().cells.ids)
    if (c.name == "parent") c.value.back() += 1;
  EXPECT_EQ(defects(), Found{Defect::kUnborn});
}

TEST_F(LifeInspection, ADissolvingCellMayGoEarlyIfTheRunSaysSo) {
  const std::vector<std::int64_t> dissolves = event("lysis").cell_id;
  const auto death = std::ranges::find_if(record_.events, [&](const io::Event& e) {
    return e.code == "death" && e.cell_id == dissolves;
  });
  ASSERT_NE(death, record_.events.end());
  death->time_s -= 20;
  io::Event told = *death;
  told.code = "death_early";
  EXPECT_EQ(defects(), Found{Defect::kUntimely});
  record_.events.insert(death, told);
  EXPECT_TRUE(defects().empty());
}

TEST_F(LifeInspection, FindsEventsThatCannotBe) {
  event("division").time_s = 800;  // the cycle takes 1000 s without exception
  std::ranges::stable_sort(record_.events, {}, &io::Event::time_s);
  EXPECT_EQ(defects(), Found{Defect::kUntimely});
  record_ = sound();
  event("lysis").cell_id = {0};  // the rule is for others
  EXPECT_TRUE(defects().contains(Defect::kUntimely));
  record_ = sound();
  record_.events.push_back(event("division"));  // a second time
  EXPECT_EQ(defects(), Found{Defect::kUntimely});
}

TEST_F(LifeInspection, FindsModelsThatChangeUntold) {
  // Cell 0 is deformable in every frame, whatever an event says; and cell 2 is a sphere already.
  record_.events.insert(record_.events.begin(), {100, "demotion", {0}, ""});
  EXPECT_EQ(defects(), Found{Defect::kUntimely});
  record_ = sound();
  record_.events.insert(record_.events.begin(), {100, "demotion", {2}, ""});
  EXPECT_EQ(defects(), Found{Defect::kUntimely});
}

TEST_F(LifeInspection, FindsADivisionThatDoesNotCome) {
  for (const bool divides : {true, false}) {
    record_ = sound();
    const char* code = divides ? "division" : "death";
    std::erase_if(record_.events, [&](const io::Event& e) { return e.code == code; });
    record_.frames.resize(2);  // until 500 s all is well
    EXPECT_EQ(defects(), Found{});
    record_.frames.back().time_s = 1250;
    EXPECT_TRUE(defects().contains(Defect::kUntimely)) << code;
  }
}

TEST_F(LifeInspection, FindsARestVolumeThatGrowthCannotMake) {
  for (const double factor : {0.8, 1.3}) {
    record_ = sound();
    io::Frame& f = record_.frames[1];  // half a cycle: 1.5 times the volume at birth
    radius_of(f, 2) *= factor;
    EXPECT_EQ(defects(), Found{Defect::kVolume}) << factor;
  }
}

TEST_F(LifeInspection, FindsADivisionThatLosesVolume) {
  const auto born = division_of(0).cell_id;
  const double shrunk = std::cbrt(1 / (1.1 * kMostDivisionChange));
  ASSERT_NEAR(record_.frames[2].time_s, 1000, 1e-6);
  for (std::size_t k = 1; k <= 2; ++k)
    change_cell(record_.frames[2], born[k], [&](const Vec3& x) { return Vec3(shrunk * x); });
  EXPECT_EQ(defects(), Found{Defect::kVolume});
}

TEST_F(LifeInspection, HoldsNewbornCellsToTheLimitsOfAll) {
  const auto born = division_of(0).cell_id;
  const auto mirrored = [](const Vec3& x) { return Vec3(x.x(), x.y(), -x.z()); };
  change_cell(record_.frames[2], born[1], mirrored);
  EXPECT_TRUE(defects().contains(Defect::kInverted));
  record_ = sound();
  // Into the place of her sister, on the other side of z = 0. Nodes of their common face lie on
  // either side of it by rounding.
  double height = 0;
  change_cell(record_.frames[2], born[1], [&](const Vec3& x) {
    height += x.z();
    return x;
  });
  const double shift = height > 0 ? -8 : 8;  // um
  change_cell(record_.frames[2], born[1],
              [&](const Vec3& x) { return Vec3(x.x(), x.y(), x.z() + shift); });
  EXPECT_TRUE(defects().contains(Defect::kTunnelled));
}

TEST_F(LifeInspection, AllowsSistersToStartInEachOtherButNoOthers) {
  const auto born = division_of(2).cell_id;
  io::Frame& f = record_.frames[2];
  ASSERT_EQ(f.n_sphere, 2);  // the dissolved one is gone
  const float* x = f.point.data() + 3 * f.n_mesh_node;
  const double distance = (Vec3(x[0], x[1], x[2]) - Vec3(x[3], x[4], x[5])).norm();
  EXPECT_LT(distance, radius_of(f, born[1]));
  EXPECT_EQ(defects(), Found{});
  // The first of them as a daughter of cell 3, which then did not dissolve.
  std::erase_if(record_.events, [](const io::Event& e) { return e.cell_id[0] == 3; });
  io::Event& division = division_of(2);
  division.cell_id = {2, born[1], 101};
  record_.events.push_back({division.time_s, "division", {3, born[2], 102}, ""});
  EXPECT_TRUE(defects().contains(Defect::kTunnelled));
}

}  // namespace
}  // namespace acinus::bench
