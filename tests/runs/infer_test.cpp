/// Inference files and targets: values, priors in the coordinates of the sampler, faults with
/// place.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runs/infer/inference_registry.hpp"
#include "runs/infer/read_inference.hpp"
#include "runs/infer/target.hpp"
#include "runs/scene/explain.hpp"
#include "tests/geometry/temp_folder.hpp"
#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

class Infer : public testing::Test {
 protected:
  Infer() { folder_.write("target.csv", ""); }

  InferencePlan parse(const std::string& parameters, const std::string& more = "") {
    return parse_inference(R"({"scene": "two_cells", "target": "target.csv", )" + more +
                               R"("parameters": [)" + parameters + "]}",
                           "i.json", folder_.path());
  }
  std::string fault(const std::string& parameters, const std::string& more = "") {
    return test::message_of([&] { parse(parameters, more); });
  }
  std::vector<TargetPoint> target(const std::string& text) {
    return read_target(folder_.write("t.csv", text), units_, 7200);
  }
  std::string target_fault(const std::string& text) {
    return test::message_of([&] { target(text); });
  }

  geometry::TempFolder folder_;
  std::map<std::string, std::string> units_{{"overlap_um", "um"}, {"cells", "1"}};
};

TEST_F(Infer, PriorsHaveTheUnitsOfTheRegistry) {
  const InferencePlan p = parse(
      R"({"key": "cell_types.hepatocyte.radius", "low": "8 um", "high": "0.02 mm"},
         {"key": "cell_types.hepatocyte.cbm.ecm_friction", "prior": "log_uniform",
          "low": "1e8 N s/m^3", "high": "1e9 N s/m^3"},
         {"key": "cell_types.hepatocyte.cbm.poisson", "prior": "normal", "mean": 0.4, "sd": 0.05, "high": 0.49})");
  ASSERT_EQ(p.prior.size(), 3u);
  EXPECT_EQ(p.prior[0].low, 8);
  EXPECT_NEAR(p.prior[0].high, 20, 1e-12);
  EXPECT_EQ(p.unit[1], "N s/m^3");
  EXPECT_NEAR(p.prior[1].value(p.prior[1].low), 1e8, 1);
  EXPECT_NEAR(p.prior[1].step(1, 3), std::log(std::sqrt(1e17)), 1e-12);
  EXPECT_EQ(p.prior[2].density(0.495), 0);
  EXPECT_NEAR(p.prior[2].step(0, 2), 0.25, 1e-12);
  EXPECT_EQ(p.label[1], "ecm_friction");
  EXPECT_EQ(p.inference.name, "i");
}

TEST_F(Infer, FaultsNamePlaceAndAdvice) {
  const std::string radius = R"("key": "cell_types.hepatocyte.radius")";
  EXPECT_CONTAINS(fault(""), "/parameters ... at least one parameter is needed");
  EXPECT_CONTAINS(fault("{" + radius + "}"), "i.json:1:");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "low": "1 um"})"),
                  "high is missing: the prior has two");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "low": "9 um", "high": "8 um"})"),
                  "must be below high");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "low": "9 s", "high": "8 um"})"), "/low = \"9 s\"");
  EXPECT_CONTAINS(
      fault("{" + radius + R"(, "prior": "log_uniform", "low": "0 um", "high": "8 um"})"),
      "must be above 0 with prior = log_uniform");
  EXPECT_CONTAINS(fault(R"({"key": "cells.model", "low": 1, "high": 2})"),
                  "is no key of a scene with one number as value");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "low": "1 um", "high": "2 um"}, {)" + radius +
                        R"(, "low": "1 um", "high": "2 um"})"),
                  "another parameter has this key");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "low": "1 um", "high": "2 um"})",
                        R"("method": "scan", "particles": 7, )"),
                  "/particles");
  EXPECT_CONTAINS(fault("{" + radius + R"(, "prior": "normal", "mean": "1 um", "sd": "0 um"})"),
                  "/sd = \"0 um\": must be above 0");
  EXPECT_CONTAINS(explain_key("inference.particles", inference_entries()), "accepted simulations");
}

TEST_F(Infer, TargetsAreReadByColumns) {
  const std::vector<TargetPoint> p = target(
      "# measured\nsd,observable,value,time_h,who\n0.5,overlap_um,3,0.5,me\n1,cells,2,,me\n\n");
  ASSERT_EQ(p.size(), 2u);
  EXPECT_EQ(*p[0].time, 1800);
  EXPECT_EQ(p[0].value, 3);
  EXPECT_EQ(p[0].sd, 0.5);
  EXPECT_FALSE(p[1].time);
  const auto q = target("time_s,observable,value,sd,unit\n10,overlap_um,5e3,1e3,nm\n");
  EXPECT_NEAR(q[0].value, 5, 1e-12);
  EXPECT_NEAR(q[0].sd, 1, 1e-12);
  const TimeCurve curve{{0, 3600}, {0, 6}};
  const std::vector<double> found = values_at(p, {{"overlap_um", curve}, {"cells", curve}});
  EXPECT_EQ(found, (std::vector<double>{3, 6}));
  EXPECT_NEAR(distance_to(p, found), std::sqrt(16.0 / 2), 1e-12);
  EXPECT_TRUE(values_at(p, {{"overlap_um", curve}}).empty());
  EXPECT_TRUE(std::isnan(distance_to(p, {})));
}

TEST_F(Infer, FaultsOfATargetNameTheLine) {
  const std::string head = "time_s,observable,value,sd\n";
  EXPECT_CONTAINS(target_fault("time_s,observable,value,sd\n"), "holds no values");
  EXPECT_CONTAINS(target_fault("time_s,value,sd\n"), "t.csv:1: no column observable");
  EXPECT_CONTAINS(target_fault(head + "1,overlap,2,1\n"), "t.csv:2: \"overlap\" is no observable");
  EXPECT_CONTAINS(target_fault(head + "1,cells,2,1\n1,cells,x,1\n"), "t.csv:3: value is \"x\"");
  EXPECT_CONTAINS(target_fault(head + "1,cells,2,0\n"), "sd must be above 0");
  EXPECT_CONTAINS(target_fault(head + "1,cells,2\n"), "sd is missing");
  EXPECT_CONTAINS(target_fault(head + "9e9,cells,2,1\n"), "lies outside the run, 0 to 7200 s");
  EXPECT_CONTAINS(target_fault("observable,value,sd,unit\noverlap_um,2,1,s\n"),
                  "the unit is \"s\"; um is");
}

}  // namespace
}  // namespace acinus::runs
