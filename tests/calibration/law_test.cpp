/// Law files: what is written is read again, and nothing else is.

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <string>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "io/disk.hpp"
#include "tests/messages.hpp"

namespace acinus::calibration {
namespace {

Law make_law() {
  Law law;
  law.a0 = 0.45;
  law.a1 = 4000.0 / 3;
  law.a1_interval = {1200, 1500};
  law.overlap_range = {0.03, 0.19};
  law.wall_recess = 0.125;
  law.friction_share = 0.225;
  law.r_squared = 0.998;
  law.rms_relative = 0.06;
  law.jkr_underestimation = 5.5;
  law.dcm = {{"bulk_modulus_kPa", 2.5}, {"cortex_young_kPa", 1}};
  law.cbm = {{"young_kPa", 0.45}, {"poisson", 0.47}};
  law.warnings = {"cells that are not at the capsule: 5"};
  law.provenance = {{"version", "0.1.0"}};
  return law;
}

class LawFile : public testing::Test {
 protected:
  void SetUp() override { folder_ = io::make_temporary_folder("acinus_law_"); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path() const { return folder_ + "/law.json"; }

  /// Message of read_law about the file after a change of its text.
  std::string message(const std::string& from, const std::string& to) const {
    std::string text = law_text(make_law());
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    io::write_text_file(path(), text);
    return test::message_of([&] { read_law(path()); });
  }

 private:
  std::string folder_;
};

TEST_F(LawFile, IsReadAsItWasWritten) {
  Law law = make_law();
  law.table = {{0.05, 0.45}, {0.1, 1.5}, {0.19, 4}};
  write_law(law, path());
  const Law read = read_law(path());
  EXPECT_EQ(law_text(read), law_text(law));
  EXPECT_EQ(read.a1, law.a1);
  EXPECT_EQ(read.provenance, law.provenance);
  EXPECT_EQ(read.warnings, law.warnings);
  const cbm::StiffnessLaw s = stiffness_law(read);
  EXPECT_TRUE(s.term.empty());
  ASSERT_EQ(s.table.size(), 3u);
  EXPECT_EQ(s.table[0].added, 0);
  EXPECT_EQ(s.table[1].overlap, 0.1);
  EXPECT_EQ(s.table[1].added, 1.5 - 0.45);
  EXPECT_EQ(s.range, 0.19);
  EXPECT_EQ(s.wall_recess, 0.125);
  ASSERT_EQ(stiffness_law(make_law()).term.size(), 1u);
  EXPECT_EQ(stiffness_law(make_law()).term[0].factor, make_law().a1);
}

TEST_F(LawFile, HoldsThePullOffIfItWasMeasured) {
  Law law = make_law();
  write_law(law, path());
  EXPECT_FALSE(test::contains(law_text(law), "pull_off_ratio"));
  EXPECT_EQ(read_law(path()).pull_off_ratio, 0);
  law.pull_off_ratio = 1.625;
  write_law(law, path());
  EXPECT_EQ(read_law(path()).pull_off_ratio, 1.625);
  std::string text = law_text(law);
  text.replace(text.find("1.625"), 5, "1.875");
  io::write_text_file(path(), text);
  EXPECT_CONTAINS(test::message_of([&] { read_law(path()); }), "changed by hand");
}

TEST_F(LawFile, BadOnesAreRefusedWithTheReason) {
  const auto expect = [&](const char* from, const char* to, const char* reason) {
    const std::string m = message(from, to);
    EXPECT_CONTAINS(m, reason) << from << " -> " << to;
    EXPECT_CONTAINS(m, "law.json");
  };
  expect("\"schema_version\": 4", "\"schema_version\": 7", "another version");
  expect("0.45", "NaN", "not JSON");
  expect("0.45", "1e999", "too large");
  expect("\"power\"", "\"colour\": 1, \"power\"", "unknown key \"colour\"");
  expect("0.45", "null", "expected a number");
  expect("0.45", "-0.45", "not allowed");
  expect("0.45", "\"450 Pa\"", "expected a number");
  expect("1200.0", "1600.0", "is above");
  expect("0.19", "0.7", "not allowed");
  expect("\"a1_kPa\"", "\"a_kPa\"", "missing");
  expect("0.125", "0.6", "not allowed");
  expect("0.225", "-0.225", "not allowed");
  expect("0.125", "0.126", "changed by hand");
  expect("2.5", "2.6", "changed by hand");
  expect("{", "", "not JSON");
  test::message_of([] { read_law("/nonexistent/law.json"); }, Exit::kFileError);
}

TEST_F(LawFile, NoNumberThatIsNotFiniteIsWritten) {
  for (const std::function<void(Law&)>& spoil : std::vector<std::function<void(Law&)>>{
           [](Law& l) { l.a1 = std::numeric_limits<double>::quiet_NaN(); },
           [](Law& l) { l.a1_interval[1] = std::numeric_limits<double>::infinity(); },
           [](Law& l) { l.dcm["cortex_young_kPa"] = -std::numeric_limits<double>::infinity(); }}) {
    Law law = make_law();
    spoil(law);
    EXPECT_THROW(write_law(law, path()), Error);
    EXPECT_FALSE(std::filesystem::exists(path()));
  }
}

TEST(Law, TellsForWhichCellsItHolds) {
  const Law law = make_law();
  EXPECT_TRUE(list_differences(law, law.dcm, law.cbm).empty());
  Parameters other = law.dcm;
  other["bulk_modulus_kPa"] = 5;
  other.erase("cortex_young_kPa");
  other["nodes"] = 162;
  const auto lines = list_differences(law, other, law.cbm);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], "dcm.bulk_modulus_kPa: the law holds for 2.5, here it is 5");
  EXPECT_EQ(lines[1], "dcm.cortex_young_kPa: the law holds for 1, here there is none");
  EXPECT_EQ(lines[2], "dcm.nodes: the law does not say, here it is 162");
}

}  // namespace
}  // namespace acinus::calibration
