/// Pages of `acinus report`: what is packed comes out again, what is too much is thinned, what is
/// damaged is reported.

#include "service/report/make_report.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_file.hpp"
#include "service/report/checks.hpp"
#include "service/report/frames.hpp"
#include "service/report/pack.hpp"
#include "service/report/page.hpp"
#include "service/report/scene_part.hpp"
#include "service/report/thin.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::service {
namespace {
namespace fs = std::filesystem;
using io::test::Folder;
using Json = nlohmann::json;

std::string decode_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0, n = 0;
  for (const char c : text) {
    if (c == '=') break;
    group = (group << 6) | static_cast<std::uint32_t>(digits.find(c));
    if (++n % 4 == 0)
      for (const int shift : {16, 8, 0}) bytes += static_cast<char>((group >> shift) & 0xff);
  }
  if (n % 4 == 2) bytes += static_cast<char>((group >> 4) & 0xff);
  if (n % 4 == 3)
    for (const int shift : {10, 2}) bytes += static_cast<char>((group >> shift) & 0xff);
  return bytes;
}

std::string decode_chunk(const std::string& chunk) {
  const std::string packed = decode_base64(chunk);
  std::string bytes(1 << 20, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

std::uint32_t byte_at(const std::string& bytes, std::size_t k) {
  return static_cast<unsigned char>(bytes.at(k));
}

TEST(ReportPack, IntegersComeBack) {
  const std::vector<std::int64_t> value{-1, 0, 7, 7, 2147483647, 12, -5};
  std::string bytes;
  append_integers(bytes, value);
  bytes = decode_chunk(encode_chunk(bytes));
  const std::size_t n = value.size();
  ASSERT_EQ(bytes.size(), 4 * n);
  std::int32_t sum = 0;
  for (std::size_t k = 0; k < n; ++k) {
    std::uint32_t step = 0;
    for (std::size_t plane = 0; plane < 4; ++plane)
      step = (step << 8) | byte_at(bytes, plane * n + k);
    sum = static_cast<std::int32_t>(static_cast<std::uint32_t>(sum) + step);
    EXPECT_EQ(sum, value[k]);
  }
}

TEST(ReportPack, NumbersComeBackToHalfAStepAndNoneStaysNone) {
  const std::vector<double> value{3, -2, 0.1, std::nan(""), 8, 7.99};
  std::string bytes;
  append_quantised(bytes, value);
  bytes = decode_chunk(encode_chunk(bytes));
  const std::size_t n = value.size();
  ASSERT_EQ(bytes.size(), 8 + 2 * n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t level = (byte_at(bytes, 8 + k) << 8) | byte_at(bytes, 8 + n + k);
    if (std::isnan(value[k])) {
      EXPECT_EQ(level, 65535U);
    } else {
      EXPECT_NEAR(-2 + 10.0 * level / kQuantisedSteps, value[k], 0.5 * 10 / kQuantisedSteps + 1e-6);
    }
  }
}

TEST(ReportThin, KeepsEndsAndPeaks) {
  EXPECT_EQ(choose_evenly(101, 5), (std::vector<int>{0, 25, 50, 75, 100}));
  EXPECT_EQ(choose_evenly(3, 5), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(choose_evenly(7, 1), std::vector<int>{6});
  runs::TimeCurve curve;
  for (int k = 0; k < 10000; ++k) {
    curve.time.push_back(k);
    curve.value.push_back(k == 4321 ? 100 : k == 4322 ? -100 : 0);
  }
  const runs::TimeCurve thin = thin_curve(curve, 100);
  EXPECT_LE(thin.time.size(), 100u);
  EXPECT_TRUE(std::ranges::is_sorted(thin.time));
  EXPECT_EQ(*std::ranges::max_element(thin.value), 100);
  EXPECT_EQ(*std::ranges::min_element(thin.value), -100);
  EXPECT_EQ(quantile({0, 1, 2, 3}, 0.5), 1.5);
}

/// Run folder with so many frames.
void write_run(const std::string& folder, int frames, int bodies) {
  fs::create_directories(folder);
  io::RunFile file = io::RunFile::create(folder + "/run.vtkhdf", {{"version", "x </script>"}});
  for (int k = 0; k < frames; ++k) file.append(io::test::make_frame(k, bodies, 3));
  file.close();
}

/// Data of a page as its script reads it.
Json data_of(const std::string& page) {
  const std::string text = io::read_text_file(page);
  const std::string begin = "id=\"data\">";
  const std::size_t from = text.find(begin) + begin.size();
  return Json::parse(text.substr(from, text.find("</script>", from) - from));
}

TEST(Report, ShowsWhatARunHolds) {
  const Folder f("report");
  write_run(f.path + "/a.run", 5, 2);
  const std::string page = write_report({.what = {f.path + "/a.run"}, .out = f.path + "/a.html"});
  const Json run = data_of(page)["items"][0];
  EXPECT_EQ(run["name"], "a.run");
  EXPECT_EQ(run["provenance"]["version"], "x </script>");
  EXPECT_EQ(run["frames"]["list"].size(), 5u);
  EXPECT_EQ(run["frames"]["meshes"].size(), 1u);  // the same triangles in all frames
  EXPECT_EQ(run["frames"]["meshes"][0]["triangles"], 16);
  EXPECT_EQ(run["frames"]["list"][0]["spheres"], 3);
  EXPECT_TRUE(run["damage"].empty());
  const std::string text = io::read_text_file(page);
  for (const char* from : {"src=\"http", "href=\"http", "url(http", "import(\"http"})
    EXPECT_FALSE(test::contains(text, from)) << from;
}

TEST(Report, NamesRunsOfEqualNameByTheirPath) {
  const Folder f("report_names");
  for (const char* run : {"/x/a.run", "/y/a.run", "/y/b.run"}) write_run(f.path + run, 1, 2);
  const Json items =
      data_of(write_report({.what = {f.path + "/x/a.run", f.path + "/y/a.run", f.path + "/y/b.run"},
                            .out = f.path + "/a.html"}))["items"];
  EXPECT_EQ(items[0]["name"], f.path + "/x/a.run");
  EXPECT_EQ(items[1]["name"], f.path + "/y/a.run");
  EXPECT_EQ(items[2]["name"], "b.run");
}

TEST(Report, KeepsItsSizeByLeavingOutFrames) {
  const Folder f("report_limit");
  write_run(f.path + "/a.run", 40, 400);
  ReportOptions options{.what = {f.path + "/a.run"}, .out = f.path + "/a.html"};
  options.bytes = empty_page_size() + 200'000;
  const Json run = data_of(write_report(options))["items"][0];
  EXPECT_LE(fs::file_size(options.out), options.bytes);
  EXPECT_LT(run["frames"]["list"].size(), 40u);
  EXPECT_GE(run["frames"]["list"].size(), 2u);
  EXPECT_EQ(run["frames"]["in_file"], 40);
  EXPECT_EQ(run["frames"]["list"].back()["number"], 39);
  options.bytes = 1000;
  EXPECT_THROW(write_report(options), Error);
}

TEST(Report, ReportsWhatIsDamagedAndShowsTheRest) {
  const Folder f("report_damage");
  const std::string folder = f.path + "/a.run";
  write_run(folder, 3, 2);
  io::write_text_file(folder + "/summary.json", "{\"status\": \"comp");
  Json run = data_of(write_report({.what = {folder}, .out = f.path + "/a.html"}))["items"][0];
  EXPECT_EQ(run["damage"].size(), 1u);
  EXPECT_EQ(run["frames"]["list"].size(), 3u);
  fs::resize_file(folder + "/run.vtkhdf", fs::file_size(folder + "/run.vtkhdf") / 3);
  run = data_of(write_report({.what = {folder}, .out = f.path + "/b.html"}))["items"][0];
  EXPECT_GE(run["damage"].size(), 2u);
}

TEST(Report, RefusesWhatItDoesNotKnow) {
  const Folder f("report_unknown");
  EXPECT_THROW(write_report({.what = {f.path}, .out = f.path + "/a.html"}), Error);
  EXPECT_THROW(write_report({.what = {f.path + "/none"}, .out = f.path + "/a.html"}), Error);
  io::write_text_file(f.path + "/law.json", "{}");
  EXPECT_THROW(write_report({.what = {f.path + "/law.json"}, .out = f.path + "/a.html"}), Error);
  EXPECT_FALSE(fs::exists(f.path + "/a.html"));
}

TEST(ReportScene, ListsOnlyValuesThatAreNotTheDefaults) {
  const auto scene = nlohmann::ordered_json::parse(R"({
    "name": "a", "description": "b", "experiment": "lobule", "seed": 1, "zoom": [], "capsule": null,
    "time": {"end": "1 h", "step": "60 s"},
    "lobule": {"height": "30 um", "vessel_fraction": 0.12},
    "walls": [{"speed": "0 um/h", "mirror": false}, {"mirror": true}], "unknown": 3})");
  std::string keys;
  for (const auto& c : list_changed_values(scene)) keys += c["key"].get<std::string>() + ";";
  EXPECT_EQ(keys, "experiment;time.end;lobule.height;walls.0.mirror;walls.1.mirror;unknown;");
}

TEST(ReportScene, ListsWallsInBaseUnits) {
  const auto scene = nlohmann::ordered_json::parse(R"({"walls": [
    {"name": "lower", "point": ["0 um", "1 mm", "-3 um"], "normal": [0, 0, 2], "speed": "36 um/h",
     "travel": "6 um", "opens": "1 min", "mirror": false}],
    "capsule": {"center": ["1 um", "2 um", "3 um"], "radius": "9 um", "speed": "0 um/h",
     "min_radius": "0 um", "opens": "auto"}})");
  const auto walls = list_walls(scene);
  ASSERT_EQ(walls.size(), 2u);
  EXPECT_EQ(walls[0]["point"], nlohmann::ordered_json({0, 1000, -3}));
  EXPECT_DOUBLE_EQ(walls[0]["speed"].get<double>(), 0.01);
  EXPECT_EQ(walls[0]["opens"], 60);
  EXPECT_EQ(walls[1]["radius"], 9);
  EXPECT_TRUE(walls[1]["opens"].is_null());
}

TEST(ReportScene, DrawsThePlanesOfALobule) {
  const auto scene =
      nlohmann::ordered_json::parse(R"({"lobule": {"shape": "pie", "radius": "280 um",
    "height": "48 um", "central_vein_radius": "10 um", "portal_vein_radius": "15 um"}})");
  const auto walls = list_walls(scene);
  EXPECT_EQ(walls.size(), 5u);
  for (const auto& wall : walls) EXPECT_TRUE(wall["mirror"].get<bool>());
}

TEST(Report, LinksTheRunsOfAStudy) {
  const Folder f("report_study");
  const std::string study = f.path + "/a.study";
  for (const char* folder : {"/runs/x=1_h/seed_1", "/runs/x/seed_1", "/../outside"})
    fs::create_directories(study + folder);
  io::write_text_file(study + "/study.json", "{}");
  io::write_text_file(study + "/report.md", "# a\n\nabout\n");
  io::write_text_file(study + "/runs/x/seed_1/report.html", "");
  io::write_text_file(
      study + "/runs.csv",
      "run,state\nx=1 h/seed_1,done\nx/seed_1,done\n../../outside,done\nnone,done\n");
  fs::create_directories(f.path + "/pages");
  const Json item =
      data_of(write_report({.what = {study}, .out = f.path + "/pages/a.html"}))["items"][0];
  EXPECT_EQ(item["path"], "../a.study");
  EXPECT_EQ(item["text"], "# a\n\nabout\n");
  EXPECT_EQ(item["links"],
            Json({"runs/x=1_h/seed_1/", "runs/x/seed_1/report.html", nullptr, nullptr}));
}

TEST(Checks, JudgeOverlapsOfSpheresInTheirRadii) {
  const auto failed = [](double pair, double vessel, int divisions) {
    const nlohmann::ordered_json summary = {
        {"max_overlap_cbm_um", pair},
        {"overlap_of_spheres_um", {{"cbm_vessel", vessel}, {"radius", 12}}},
        {"cells", {{"divisions", divisions}}}};
    std::string names;
    for (const auto& check : list_checks(summary))
      if (!check["pass"].get<bool>()) names += check["name"].get<std::string>() + ";";
    return names;
  };
  EXPECT_EQ(failed(5.9, 4.7, 0), "");
  EXPECT_NE(failed(6.1, 4.7, 0).find("two spheres"), std::string::npos);
  EXPECT_EQ(failed(6.1, 4.7, 3), "") << "sisters start deep in each other";
  EXPECT_NE(failed(5.9, 4.9, 3).find("vessel"), std::string::npos);
}

}  // namespace
}  // namespace acinus::service
