/// Studies that would write elsewhere, or make runs without end.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/runs/study_texts.hpp"

namespace acinus::runs {
namespace {

std::string study_with(const std::string& more) { return text_with(more, R"("slow": {})"); }

TEST(StudyHostile, NoValueLeadsOutOfTheStudysFolder) {
  for (const char* value : {R"("x/../../../../../other.study/runs/a")", R"("../..")", R"("/etc")",
                            R"(".")", R"("a\\b\u0000c")", R"("")"}) {
    const StudyPlan plan = parse(study_with(
        R"("sweeps": [ { "of": ["slow"], "key": "description", "label": "d", "values": [)" +
        std::string(value) + "] } ]"));
    const std::filesystem::path folder = plan.variants.back().folder;
    EXPECT_EQ(std::distance(folder.begin(), folder.end()), 2) << folder;
    for (const auto& part : folder) EXPECT_NE(part.string().front(), '.') << folder;
  }
  expect_fault(study_with(R"("sweeps": [ { "of": ["slow"], "key": "description", "label": "../x",
                                          "values": ["a"] } ])"),
               {"/sweeps/0/label"});
}

TEST(StudyHostile, RefusesMoreVariantsAndRunsThanAStudyHas) {
  std::string values, seeds;
  for (int k = 0; k < 400; ++k) values += (k > 0 ? ", " : "") + std::to_string(k);
  for (int k = 0; k < 15000; ++k) seeds += (k > 0 ? ", " : "") + std::to_string(k);
  const auto sweep = [&](const std::string& label) {
    return R"({ "of": ["slow*"], "key": "motility.grid", "label": ")" + label +
           R"(", "values": [)" + values + "] }";
  };
  expect_fault(study_with("\"sweeps\": [ " + sweep("a") + ", " + sweep("b") + " ]"),
               {"makes more than 10000 variants"});
  expect_fault(
      R"({"scene": "two_cells", "seeds": [)" + seeds + R"(], "variants": {"a": {}, "b": {}}})",
      {"make 30000 runs"});
}

TEST(StudyHostile, RefusesLongChainsOfVariants) {
  std::string variants = "\"v0\": {}";
  for (int k = 1; k < 200; ++k)
    variants += fmt::format(", \"v{}\": {{\"extends\": \"v{}\"}}", k, k - 1);
  expect_fault(R"({"scene": "two_cells", "seeds": [1], "variants": {)" + variants + "}}",
               {"variants extend one another"});
}

}  // namespace
}  // namespace acinus::runs
