/// Pages of folders that strangers made: nothing of others is shown, nothing crashes.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_file.hpp"
#include "service/report/make_report.hpp"
#include "tests/io/sample.hpp"
#include "tests/messages.hpp"

namespace acinus::service {
namespace {
namespace fs = std::filesystem;
using io::test::Folder;

constexpr const char* kSecret = "a secret of the reader";

void put(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

std::string write_run(const Folder& f, const std::string& scene = "{}") {
  const std::string folder = f / "a.run";
  fs::create_directories(folder);
  io::RunFile file = io::RunFile::create(folder + "/run.vtkhdf", {{"scene", scene}});
  file.append(io::test::make_frame(0, 1, 1));
  file.close();
  return folder;
}

std::string page_of(const Folder& f, const std::string& what) {
  return io::read_text_file(write_report({.what = {what}, .out = f / "page.html"}));
}

TEST(ReportHostile, JsonWithoutEndIsDamage) {
  const Folder f("report_nested");
  for (const std::string& open : {std::string("["), std::string("{\"a\":")}) {
    std::string nested;
    for (int k = 0; k < 200'000; ++k) nested += open;
    const std::string folder = write_run(f, nested);
    put(folder + "/summary.json", nested);
    EXPECT_CONTAINS(page_of(f, folder), "summary.json: is no JSON object");
    put(f / "law.json", nested);
    EXPECT_THROW(page_of(f, f / "law.json"), Error);
    put(f / "s.study/study.json", nested);
    put(f / "s.study/runs.csv", "run\n");
    put(f / "s.study/verdicts.json", nested);
    EXPECT_NO_THROW(page_of(f, f / "s.study"));
    fs::remove_all(folder);
  }
}

TEST(ReportHostile, ScenesThatAreNoneAreDamage) {
  const Folder f("report_scene");
  for (const char* scene : {"", "[1]", "3", "{\"cell_types\": 3}", "{\"cell_types\": {\"a\": []}}",
                            "{\"time\": \"1\"}", "\xff\xfe"}) {
    const std::string folder = write_run(f, scene);
    for (const char* summary :
         {"[]", "{\"balance\": []}", "{\"balance\": {\"momentum\": \"x\"}}"}) {
      put(folder + "/summary.json", summary);
      EXPECT_NO_THROW(page_of(f, folder)) << scene << summary;
    }
    fs::remove_all(folder);
  }
}

TEST(ReportHostile, ShowsNothingThatLinksLeadTo) {
  const Folder f("report_links");
  put(f / "secret.txt", kSecret);
  put(f / "elsewhere/x.svg", kSecret);
  const std::string folder = write_run(f);
  fs::create_symlink(f / "secret.txt", folder + "/summary.json");
  fs::create_symlink(f / "secret.txt", folder + "/run.lock");
  EXPECT_FALSE(test::contains(page_of(f, folder), kSecret));
  EXPECT_EQ(io::read_text_file(f / "secret.txt"), kSecret);
  const std::string study = f / "s.study";
  put(study + "/study.json", "{}");
  put(study + "/runs.csv", "run\n");
  fs::create_directories(study + "/plots");
  fs::create_symlink(f / "secret.txt", study + "/plots/x.svg");
  EXPECT_THROW(page_of(f, study), Error);
  fs::remove_all(study + "/plots");
  fs::create_directory_symlink(f / "elsewhere", study + "/plots");
  fs::create_symlink(f / "secret.txt", study + "/verdicts.json.tmp");
  EXPECT_FALSE(test::contains(page_of(f, study), kSecret));
}

TEST(ReportHostile, DoesNotWaitForPipes) {
  const Folder f("report_pipes");
  const std::string folder = write_run(f);
  for (const char* name : {"summary.json", "run.lock", "run.vtkhdf.journal", "run.vtkhdf.sums"}) {
    fs::remove(folder + "/" + name);
    ASSERT_EQ(mkfifo((folder + "/" + name).c_str(), 0600), 0);
  }
  EXPECT_NO_THROW(page_of(f, folder));
  fs::remove(folder + "/run.vtkhdf");
  ASSERT_EQ(mkfifo((folder + "/run.vtkhdf").c_str(), 0600), 0);
  EXPECT_NO_THROW(page_of(f, folder));
  ASSERT_EQ(mkfifo((f / "law.json").c_str(), 0600), 0);
  EXPECT_THROW(page_of(f, f / "law.json"), Error);
}

}  // namespace
}  // namespace acinus::service
