#include <cmath>

#include "core/error.hpp"
#include "tests/paths.hpp"
#include "tests/runs/program.hpp"

namespace acinus::runs {
namespace {

class RunErrors : public ProgramTest {
 protected:
  RunErrors() { write("pair.json", kPair); }

  /// Checks that run and check refuse the scene with one change, with all of these words, and that
  /// run makes no folder.
  void expect_refused(const Words& changes, const Words& parts, int code = 2) const {
    Words checked{"check", "pair.json"}, ran = run_words("pair.json", "refused");
    for (const std::string& change : changes)
      for (Words* words : {&checked, &ran}) words->insert(words->end(), {"--set", change});
    for (const Words& words : {checked, ran}) {
      const Outcome outcome = call(words);
      EXPECT_EQ(outcome.code, code) << words[0] << " " << changes[0] << "\n" << outcome.text;
      for (const std::string& part : parts)
        EXPECT_CONTAINS(outcome.text, part) << words[0] << changes[0] << ": \""
                                            << "\" is missing in\n";
      EXPECT_FALSE(test::contains(outcome.text, "internal error")) << outcome.text;
    }
    EXPECT_FALSE(fs::exists(path("refused"))) << changes[0];
  }
};

// ---- an existing run folder --------------------------------------------------------------------

TEST_F(RunErrors, ResultsAreNeverReplacedUnasked) {
  ASSERT_EQ(call(run_words("pair.json", "a")).code, 0);
  const Json before = summary("a");
  const Outcome refused = call(run_words("pair.json", "a", {"--set", "seed=4"}));
  EXPECT_EQ(refused.code, 2);
  for (const char* part : {"--resume", "--overwrite", "--out a"})
    EXPECT_CONTAINS(refused.text, part);
  EXPECT_EQ(summary("a"), before);

  write("a/mine.txt", "notes");
  const Outcome bad = call(run_words("pair.json", "a", {"--overwrite", "--set", "seed=-4"}));
  EXPECT_EQ(bad.code, 2) << bad.text;
  EXPECT_EQ(summary("a"), before) << "a bad scene must not cost the old results";
  EXPECT_EQ(call(run_words("pair.json", "a", {"--overwrite", "--set", "seed=4"})).code, 0);
  EXPECT_NE(summary("a")["state_hash"], before["state_hash"]);
  EXPECT_EQ(reader("a").n_frame(), 5);
  EXPECT_TRUE(fs::exists(path("a/mine.txt")));
}

TEST_F(RunErrors, ResumeRefusesAnotherSceneAndListsTheKeys) {
  ASSERT_EQ(call(run_words("pair.json", "a")).code, 0);
  const Json before = summary("a");
  const Outcome changed = call(run_words(
      "pair.json", "a",
      {"--resume", "--set", "time.step=20 s", "--set", "cell_types.hepatocyte.radius=11 um"}));
  EXPECT_EQ(changed.code, 2);
  for (const char* part :
       {"/time/step: \"30 s\" -> \"20 s\"", "/cell_types/hepatocyte/radius: \"12 um\" -> \"11 um\"",
        "a/checkpoint.h5", "time.end"})
    EXPECT_CONTAINS(changed.text, part);
  const std::string cell = R"({"position": ["0 um", "0 um", "0 um"], "model": "dcm"})";
  const auto far = [](int x) {
    return R"({"position": [")" + std::to_string(x) + R"( um", "0 um", "0 um"], "model": "cbm"})";
  };
  const Outcome more = call(
      run_words("pair.json", "a",
                {"--resume", "--set",
                 "cells.list=[" + cell + "," + far(40) + "," + far(80) + "," + far(120) + "]"}));
  EXPECT_EQ(more.code, 2);
  EXPECT_CONTAINS(more.text, "/cells/list: 2 entries -> 4 entries");
  EXPECT_EQ(summary("a"), before);
  const Outcome longer =
      call(run_words("pair.json", "a", {"--resume", "--set", "time.end=10 min"}));
  EXPECT_EQ(longer.code, 0) << longer.text;
  EXPECT_EQ(summary("a")["simulated_s"], 600.0);
  EXPECT_EQ(reader("a").n_frame(), 6);
}

TEST_F(RunErrors, ResumeNeedsACheckpointThatCanBeRead) {
  const Outcome none = call(run_words("pair.json", "none", {"--resume"}));
  EXPECT_EQ(none.code, 2);
  EXPECT_CONTAINS(none.text, "holds no checkpoint");
  EXPECT_FALSE(fs::exists(path("none")));

  ASSERT_EQ(call(run_words("pair.json", "a", {"--until", "4 min"})).code, 0);
  fs::copy(path("a"), path("b"));
  fs::resize_file(path("b/checkpoint.h5"), 1000);
  const Outcome cut = call(run_words("pair.json", "b", {"--resume"}));
  EXPECT_EQ(cut.code, 4) << cut.text;
  EXPECT_CONTAINS(cut.text, "b/checkpoint.h5");
  fs::copy(path("a/checkpoint.h5"), path("b/checkpoint.prev.h5"));
  const Outcome previous = call(run_words("pair.json", "b", {"--resume"}));
  EXPECT_EQ(previous.code, 0) << previous.text;
  EXPECT_CONTAINS(previous.text, "checkpoint.prev.h5");
  EXPECT_CONTAINS(summary("b")["warnings"].dump(), "checkpoint.prev.h5") << "also with --quiet";
  ASSERT_EQ(call(run_words("pair.json", "a", {"--resume"})).code, 0);
  EXPECT_EQ(summary("a")["state_hash"], summary("b")["state_hash"]);
}

// ---- exit codes --------------------------------------------------------------------------------

TEST_F(RunErrors, FoldersThatCannotBeMadeExitWithFour) {
  write("file", "");
  for (const std::string& out : {std::string("file/run"), std::string("/proc/acinus_run")}) {
    const Outcome outcome = call(run_words("pair.json", out));
    EXPECT_EQ(outcome.code, 4) << outcome.text;
    EXPECT_CONTAINS(outcome.text, out);
  }
}

TEST_F(RunErrors, AFullDiskExitsWithFourAndKeepsWhatIsWritten) {
  const Words often{"--set", "output.every=30 s", "--checkpoint-every", "0.000001s"};
  ASSERT_EQ(call(run_words("pair.json", "whole", often)).code, 0);
  const std::vector<io::Frame> whole = read_frames(reader("whole"));
  Words start = run_words("pair.json", "start", often);
  start.insert(start.end(), {"--until", "30 s"});
  ASSERT_EQ(call(start).code, 0);
  // The first chunk of each dataset makes most of a small file: parts below 1 are parts of these,
  // the rest counts the later frames.
  const auto first = static_cast<double>(fs::file_size(path("start/run.vtkhdf")));
  const auto later = static_cast<double>(fs::file_size(path("whole/run.vtkhdf"))) - first;
  int with_frames = 0;
  std::size_t frames = 0;
  for (const double part : {0.003, 0.5, 1.3, 1.6, 1.9}) {
    const std::string run = "part" + std::to_string(part);
    const auto limit = static_cast<rlim_t>(part < 1 ? part * first : first + (part - 1) * later);
    const Outcome outcome = call(run_words("pair.json", run, often), limit);
    EXPECT_EQ(outcome.code, 4) << part << outcome.text;
    EXPECT_CONTAINS(outcome.text, run);
    EXPECT_CONTAINS(outcome.text, "Free space");
    const bool saved = fs::exists(path(run) / "checkpoint.h5");
    if (saved) {
      const std::vector<io::Frame> kept = read_frames(reader(run));
      EXPECT_GT(kept.size(), 0u);
      frames += kept.size();
      expect_first_frames(kept, whole, run);
      ++with_frames;
    }
    Words again = run_words("pair.json", run, often);
    again.emplace_back(saved ? "--resume" : "--overwrite");
    const Outcome rest = call(again);
    EXPECT_EQ(rest.code, 0) << part << rest.text;
    EXPECT_EQ(summary(run)["state_hash"], summary("whole")["state_hash"]) << part;
    EXPECT_EQ(reader(run).n_frame(), static_cast<int>(whole.size())) << part;
  }
  std::printf("%zu frames kept by %d of 5 runs on a full disk\n", frames, with_frames);
  EXPECT_GE(with_frames, 3);
}

TEST_F(RunErrors, ARunThatCannotGoOnExitsWithThreeAndNamesTheCell) {
  // The wall is 40 um away and comes 20 um nearer in the shortest step: the first steps are good.
  const Words crash{
      "--set",
      R"(walls=[{"name": "ram", "point": ["-52 um", "0 um", "0 um"], "normal": [1, 0, 0],)"
      R"( "speed": "60 um/min", "travel": "100 um", "mirror": true}])",
      "--set", "time.min_step=20 s"};
  const Outcome outcome = call(run_words("pair.json", "a", crash));
  EXPECT_EQ(outcome.code, 3) << outcome.text;
  const Json s = summary("a");
  EXPECT_EQ(s["status"], "failed");
  const std::string cause = s["cause"];
  EXPECT_CONTAINS(outcome.text, cause);
  EXPECT_CONTAINS(cause, "DCM cell 0");
  EXPECT_CONTAINS(cause, "Cells concerned: 0");
  EXPECT_CONTAINS(cause, "Try");
  const io::RunReader run = reader("a");
  EXPECT_GT(s["simulated_s"], 0.0);
  EXPECT_EQ(run.time_s(run.n_frame() - 1), s["simulated_s"].get<double>())
      << "the last good state has a frame";
  const io::Frame last = run.frame(run.n_frame() - 1);
  EXPECT_TRUE(std::ranges::all_of(last.point, [](float x) { return std::isfinite(x); }));
  const auto events = run.events();
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().code, "cannot_continue");
  EXPECT_EQ(events.back().cell_id, std::vector<std::int64_t>{0});
  EXPECT_CONTAINS(text("a/run.log"), "still fails");
  EXPECT_EQ(
      call(run_words("pair.json", "a", {crash[0], crash[1], crash[2], crash[3], "--resume"})).code,
      3);
}

TEST_F(RunErrors, AHugePullExitsWithThree) {
  const Outcome outcome = call(run_words(
      "pair.json", "a",
      {"--set", R"(cells.list.0.pull=["1e6 nN", "0 nN", "0 nN"])", "--set", "time.min_step=20 s"}));
  EXPECT_EQ(outcome.code, 3) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "DCM cell 0 would move");
  EXPECT_EQ(summary("a")["status"], "failed");
  EXPECT_EQ(reader("a").n_frame(), 1);
}

/// Two cells that start with their centres 0.6 diameters apart.
constexpr const char* kOverlapping = R"({
  "time": {"end": "40 min", "step": "30 s"},
  "cell_types": {"hepatocyte": {"dcm": {"nodes": 42}}},
  "cells": {"source": "list", "model": "dcm", "list": [
    {"position": ["0 um", "0 um", "0 um"]}, {"position": ["14.4 um", "0 um", "0 um"]}]},
  "motility": {"random": false}, "output": {"every": "20 min"}
})";

/// Three soft cells whose coarse meshes meet in nodes only, compressed to half their volume.
constexpr const char* kCompressed = R"({
  "time": {"end": "4 h", "step": "10 min"},
  "cell_types": {"cell": {"radius": "17 um",
    "dcm": {"nodes": 42, "bulk_modulus": "130 Pa", "cortex_thickness": "0.15 um"}}},
  "cells": {"source": "list", "model": "dcm", "list": [
    {"position": ["-17 um", "-9.8 um", "0 um"]}, {"position": ["17 um", "-9.8 um", "0 um"]},
    {"position": ["0 um", "19.6 um", "0 um"]}]},
  "capsule": {"radius": "40 um", "speed": "9 um/h", "min_radius": "20 um"},
  "contact": {"quadrature": "nodes"}, "motility": {"random": false}, "output": {"every": "1 h"}
})";

TEST_F(RunErrors, AnOverlapThatContactDoesNotMendStopsTheRun) {
  write("deep.json", kCompressed);
  const Outcome outcome = call(run_words("deep.json", "a"));
  EXPECT_EQ(outcome.code, 3) << outcome.text;
  const Json s = summary("a");
  EXPECT_EQ(s["status"], "failed");
  const std::string cause = s["cause"];
  EXPECT_CONTAINS(cause, "DCM cells");
  EXPECT_CONTAINS(cause, "overlap by");
  EXPECT_CONTAINS(cause, "contact.max_depth");
  EXPECT_GT(s["simulated_s"], 0.0);
  const auto events = reader("a").events();
  ASSERT_GE(events.size(), 2u);
  EXPECT_EQ(events.front().code, "deep_overlap");
  EXPECT_EQ(events.front().cell_id.size(), 2u);
  EXPECT_EQ(events.back().code, "cannot_continue");
  EXPECT_EQ(call(run_words("deep.json", "a", {"--resume"})).code, 3) << "it did not go away";
}

TEST_F(RunErrors, AWallThatOverrunsASphereStopsTheRun) {
  write("pair.json", kOverlapping);
  const Outcome outcome = call(run_words(
      "pair.json", "a",
      {"--set", "cells.model=cbm", "--set", R"(cells.list.1.position=["24 um", "0 um", "0 um"])",
       "--set", "cell_types.hepatocyte.cbm.ecm_friction=1e12 N s/m^3", "--set", "time.max_move=0",
       "--set", "time.adaptive=false", "--set", "output.every=5 min", "--set",
       R"(walls=[{"name": "ram", "point": ["-12 um", "0 um", "0 um"], "normal": [1, 0, 0],)"
       R"( "speed": "2 um/min", "travel": "30 um", "mirror": true}])"}));
  EXPECT_EQ(outcome.code, 3) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "CBM cell 0 has its centre");
  EXPECT_CONTAINS(outcome.text, "inside wall \"ram\"");
}

TEST_F(RunErrors, CellsPlacedInEachOtherAreCutApart) {
  write("deep.json", kOverlapping);
  const Outcome outcome = call(run_words("deep.json", "a"));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "2 deformable cells (number 0, 1)");
  EXPECT_TRUE(reader("a").events().empty());
}

// ---- bad input: nothing is made ----------------------------------------------------------------

TEST_F(RunErrors, CellsThatDoNotFitAreNamedWithTheirPlace) {
  write("vessel.swc", "1 0 -60 0 0 4 -1\n2 0 0 0 0 4 1\n3 0 60 0 0 4 2\n");
  expect_refused({"vessels.file=vessel.swc"},
                 {"pair.json", "/cells/list/0", "(0, 0, 0) um", "16 um inside vessel segment",
                  "at most 0.3 um", "Move"});
  expect_refused(
      {R"(walls=[{"name": "floor", "mirror": true, "point": ["0 um", "0 um", "5 um"]}])"},
      {"/cells/list/1", "17 um inside wall \"floor\"", "at most 0.3 um", "Move"});
  expect_refused({R"(capsule={"radius": "20 um"})"},
                 {"/cells/list/1", "15.5 um inside the wall of the capsule", "Move"});
  expect_refused({R"(cells.list.1.position=["1 um", "0 um", "0 um"])"},
                 {"/cells/list/0 and /cells/list/1", "1 um apart", "half a radius, 6 um", "Move"});
  expect_refused({R"(cells.list.1.position=["0 um", "0 um", "0 um"])"},
                 {"/cells/list/0 and /cells/list/1", "0 um apart"});
  expect_refused({"cells.list.0.radius=1e100 um"}, {"/cells/list/0", "1e100 um", "unit"});
  expect_refused({"cells.list.0.radius=1e-9 um"}, {"/cells/list/0", "1e-09 um", "unit"});
  expect_refused({R"(cells.list.1.position=["1e9 um", "0 um", "0 um"])"},
                 {"/cells/list/1", "1e9 um", "unit"});
}

TEST_F(RunErrors, MemoryIsEstimatedBeforeAnythingIsPlacedAndWatchedThen) {
  const Outcome outcome = call(
      {"run", "clump13", "--set", "cells.count=100000", "--max-memory", "500 MB", "--out", "a"});
  EXPECT_EQ(outcome.code, 2) << outcome.text;
  for (const char* part :
       {"at least 7.29 GB", "0.5 GB are allowed", "1e+05 cells", "dcm.nodes", "--max-memory"})
    EXPECT_CONTAINS(outcome.text, part);
  EXPECT_FALSE(fs::exists(path("a")));
  // An estimate knows nothing of what grows.
  const Outcome stopped = call({"run", "two_cells", "--max-memory", "2MB", "--out", "b"});
  EXPECT_EQ(stopped.code, 75) << stopped.text;
  EXPECT_EQ(summary("b")["cause"], "stopped by the memory limit");
  EXPECT_EQ(call({"run", "two_cells", "--max-memory", "2", "--out", "c"}).code, 2);
}

TEST_F(RunErrors, VesselFilesMustBeUsable) {
  write("nan.swc", "1 0 -60 50 0 4 -1\n2 0 0 50 0 nan 1\n");
  expect_refused({"vessels.file=nan.swc"},
                 {"nan.swc:2", "radius nan", "finite number above 0", "Repair"});
  write("place.swc", "1 0 -60 50 0 4 -1\n2 0 0 nan 0 4 1\n");
  expect_refused({"vessels.file=place.swc"}, {"place.swc:2", "nan", "finite", "Repair"});
  write("bare.vtk",
        "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 2 float\n-60 50 0 60 50 "
        "0\nLINES 1 3\n2 0 1\n");
  expect_refused({"vessels.file=bare.vtk"}, {"bare.vtk", "no radius array", "POINT_DATA"});
  expect_refused({"vessels.file=missing.vtk"}, {"/vessels/file", "missing.vtk", "no such file"});
  write("net.png", "x");
  expect_refused({"vessels.file=net.png"}, {"net.png", ".vtk", ".swc"});
}

TEST_F(RunErrors, OptionsThatHaveNoEffectAreRefused) {
  write("tree.swc", "1 0 0 0 0 1 -1\n2 0 9 0 0 1 1\n");
  const std::vector<std::pair<Words, std::string>> all{
      {{"import", "a.tif", "--out", "o", "--model", "cbm", "--nodes", "162"}, "--nodes is for"},
      {{"import", "a.tif", "--out", "o", "--voxel", "1 um", "--unit", "1 um"}, "--unit has no"},
      {{"import", "a.tif", "--out", "o", "--dataset", "labels"}, "--dataset names"},
      {{"mesh", "vessels", "pair.json", "--out", "v.stl", "--unit", "1 mm"}, "a network file"},
      {{"mesh", "vessels", "pair.json", "--out", "v.stl", "--vessel-radius-array", "r"},
       "a network file"},
      {{"mesh", "vessels", "tree.swc", "--out", "v.stl", "--vessel-radius-array", "r"},
       "for VTK files only"},
      {{"voxelise", "a.run", "--out", "l.tif", "--seed", "3"}, "--noise"}};
  for (const auto& [words, part] : all) {
    const Outcome outcome = call(words);
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_CONTAINS(outcome.text, part);
  }
  expect_refused({"vessels.file=tree.swc", "vessels.radius_array=r"}, {"for VTK files only"});
  expect_refused({"vessels.radius_array=r"}, {"/vessels/radius_array", "/vessels/file"});
}

constexpr const char* kOpenTetrahedron =
    "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\nf 1 3 2\nf 1 2 4\nf 1 4 3\n";

TEST_F(RunErrors, StaticMeshesMustBeClosedAndClearOfCells) {
  write("open.obj", kOpenTetrahedron);
  expect_refused({R"(static_meshes=[{"file": "open.obj"}])"},
                 {"open.obj: body 0", "3 open edges", "Close the holes"});
  write("closed.obj", std::string(kOpenTetrahedron) + "f 2 3 4\n");
  const auto body = [](const std::string& more) {
    return R"(static_meshes=[{"name": "rock", "file": "closed.obj")" + more + "}]";
  };
  // The first cell is centred on the corner at the origin, the second on the bottom face.
  expect_refused({body("")},
                 {"/cells/list/0", "12 um inside static mesh \"rock\"", "/cells/list/1"});
  // Both deep inside: the corner is moved 40 um back and everything made ten times as large.
  const std::string around = R"(, "scale": 10, "shift": ["-40 um", "-40 um", "-40 um"])";
  expect_refused({body(around)}, {"52 um inside static mesh \"rock\""});
  const Outcome within =
      call({"check", "pair.json", "--set", body(around + R"(, "inside": true)")});
  EXPECT_EQ(within.code, 0) << within.text;
  const Outcome beside =
      call({"check", "pair.json", "--set", body(R"(, "shift": ["12 um", "12 um", "12 um"])")});
  EXPECT_EQ(beside.code, 0) << beside.text;
  expect_refused({body(R"(, "shift": ["12 um", "12 um", "12 um"], "inside": true)")},
                 {"inside static mesh \"rock\""});
}

TEST_F(RunErrors, AMeshWithAHoleIsRefused) {
  const auto refused = [this](const std::string& folder, const std::string& name) {
    expect_refused({"static_meshes=[{\"file\": \"" + folder + name + "\", \"unit\": \"1 m\"}]"},
                   {name + ": body 1", "edge"});
  };
  refused(test::data_path("files/"), "open_body.vtk");
  if (test::has_real_data()) refused(test::real_path("simucell3d/"), "young_laplace_test_geom.vtk");
}

TEST_F(RunErrors, WrongValuesAreNamed) {
  expect_refused({"cells.list.0.radius=12 h"}, {"/cells/list/0/radius", "\"12 h\"", "a length"});
  expect_refused({"cells.list.0.radius=12"}, {"/cells/list/0/radius = 12", "unit", "12 um"});
  expect_refused({"cells.list.0.radius=-12 um"},
                 {"/cells/list/0/radius", "\"-12 um\"", "must be > 0 um"});
  expect_refused({"cells.list.0.raduis=12 um"},
                 {"/cells/list/0/raduis", "unknown key", "\"radius\"", "acinus explain"});
  expect_refused({"cells.list.0.type=liver"}, {"\"liver\"", "unknown cell type", "hepatocyte"});
  // Two errors are reported at once.
  expect_refused({"time.end=5", "seed=x"}, {"/time/end", "/seed"});
}

// ---- acinus check ------------------------------------------------------------------------------

TEST_F(RunErrors, CheckCountsWhatItBuilt) {
  write("vessel.swc", "1 0 -60 50 0 4 -1\n2 0 60 50 0 4 1\n");
  const Outcome outcome = call({"check", "pair.json", "--set", "vessels.file=vessel.swc"});
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_CONTAINS(outcome.text, "1 deformable cell, 1 sphere from list, 120 um of vessels");
}

TEST_F(RunErrors, EveryShippedSceneFits) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(test::source_path("runs/scenes"))) {
    if (entry.path().extension() != ".json") continue;
    const Outcome outcome = call({"check", entry.path().string()});
    EXPECT_EQ(outcome.code, 0) << entry.path() << "\n" << outcome.text;
    EXPECT_CONTAINS(outcome.text, "valid scene");
    ++scenes;
  }
  EXPECT_GE(scenes, 7);
  const auto expect_vessels = [this](const std::string& file, const std::string& text) {
    const Outcome outcome = call({"check", test::source_path("runs/scenes/vessel_file.json"),
                                  "--set", "vessels.file=" + file});
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_CONTAINS(outcome.text, text);
  };
  expect_vessels(test::data_path("files/capillaries.vtk"), "640 um of vessels");
  if (test::has_real_data())
    expect_vessels(test::real_path("vascpy/test_smaller_vasculature.vtk"), "566 um of vessels");
}

}  // namespace
}  // namespace acinus::runs
