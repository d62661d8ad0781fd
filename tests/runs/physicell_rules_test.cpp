/// Tables of PhysiCell's cell rules, read and converted into scenes.

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/physicell/convert_rules.hpp"
#include "tests/messages.hpp"
#include "tests/paths.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

std::string message_of(const std::string& text) {
  try {
    parse_physicell_rules(text, "rules.csv");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Exit::kBadInput);
    return error.what();
  }
  return "no error";
}

TEST(PhysiCellRules, AllVersionsGiveTheSameRule) {
  for (const char* text :
       {"cell,oxygen,decreases,necrosis,0,3.75,8,0\n",
        "\xEF\xBB\xBF// v3\r\n\r\ncell , oxygen,decreases,necrosis,0,3.75,8,0\r\n",
        "cell\toxygen\tdecreases\tnecrosis\t0\t3.75\t8\t0",
        "cell,oxygen,decreases,necrosis,0.002,0,3.75,8,0\n",
        "cell,necrosis,0,0.002,0.01,oxygen,decreases,3.75,8,0\n"}) {
    const std::vector<PhysiCellRule> rules = parse_physicell_rules(text, "rules.csv");
    ASSERT_EQ(rules.size(), 1U) << text;
    const PhysiCellRule& r = rules[0];
    EXPECT_EQ(r.cell_type, "cell");
    EXPECT_EQ(r.signal, "oxygen");
    EXPECT_EQ(r.behaviour, "necrosis");
    EXPECT_TRUE(r.decreases);
    EXPECT_EQ(r.extreme, 0);
    EXPECT_EQ(r.half_max, 3.75);
    EXPECT_EQ(r.power, 8);
    EXPECT_FALSE(r.dead);
    EXPECT_EQ(r.base.value_or(0.002), 0.002);
  }
  EXPECT_EQ(parse_physicell_rules("// a\n\nc,o,increases,apoptosis,1,1,1,1", "r")[0].line, 3);
}

TEST(PhysiCellRules, FaultsNameTheLine) {
  EXPECT_CONTAINS(message_of("// a\nc,o,increases,apoptosis,1,1,1\n"), "rules.csv:2: 7 columns");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,1,1,1,0,0,0,0"), "rules.csv:1: 11 columns");
  EXPECT_CONTAINS(message_of("c,,increases,apoptosis,1,1,1,0"), "rules.csv:1: column 2 is empty");
  EXPECT_CONTAINS(message_of("c,o,rises,apoptosis,1,1,1,0"), "column 3 \"rises\"");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,1,x,1,0"), "column 6 \"x\": is no number");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,1,0,1,0"), "half-max must be > 0");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,1,1,-2,0"), "Hill power must be > 0");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,-1,1,1,0"), "must be >= 0");
  EXPECT_CONTAINS(message_of("c,o,increases,apoptosis,nan,1,1,0"), "is no number");
  EXPECT_CONTAINS(message_of("// nothing\n"), "no rule in it");
}

/// Scene of a converted text, checked as any scene.
struct Read {
  ConvertedRules converted;
  Scene scene;
};
Read convert(const std::string& text, const BaseValues& base = {}) {
  Read r{
      convert_physicell_rules(parse_physicell_rules(text, "rules.csv"), base, "rules", "rules.csv"),
      {}};
  const std::string file = testing::TempDir() + "physicell_rules.json";
  io::write_text_file(file, r.converted.scene);
  r.scene = read_scene(file, {});
  return r;
}

TEST(PhysiCellRules, TableBecomesAScene) {
  const Read r = convert(io::read_text_file(test::source_path("tests/data/physicell_rules.csv")),
                         {{"necrosis", 0.002}});
  const std::vector<bool> converted{true,  true,  false, true,  true,
                                    false, false, true,  false, false};
  ASSERT_EQ(r.converted.remark.size(), converted.size());
  for (std::size_t k = 0; k < converted.size(); ++k)
    EXPECT_EQ(r.converted.remark[k].converted, converted[k]) << r.converted.remark[k].text;
  EXPECT_EQ(r.converted.n_converted, 5U);
  EXPECT_EQ(r.converted.remark.back().line, 14);
  ASSERT_EQ(r.scene.rules.size(), 6U) << "migration speed takes two rules";
  const SignalRuleEntry& necrosis = r.scene.rules[0];
  EXPECT_EQ(necrosis.name, "oxygen");
  EXPECT_EQ(necrosis.behaviour, coupling::Behaviour::kDeath);
  EXPECT_TRUE(necrosis.decreases);
  EXPECT_EQ(necrosis.cell_type, "tumour_cell");
  EXPECT_EQ(necrosis.half_max, 3.75);
  EXPECT_EQ(necrosis.power, 8);
  EXPECT_NEAR(necrosis.rate, 0.002 / 60, 1e-12);
  EXPECT_EQ(r.scene.rules[1].behaviour, coupling::Behaviour::kGrowth);
  EXPECT_NEAR(r.scene.cell_types.at("tumour_cell").cycle.time, 60 / 0.0007, 0.1);
  EXPECT_NEAR(r.scene.rules[3].rate, 0.001 / 60, 1e-12);
  EXPECT_EQ(r.scene.rules[4].behaviour, coupling::Behaviour::kMotility);
  EXPECT_EQ(r.scene.rules[4].name, "necrotic_debris");
  ASSERT_EQ(r.scene.substances.size(), 3U);
  EXPECT_NEAR(r.scene.substances[0].diffusion, 1e5 / 60, 1e-6);
  EXPECT_CONTAINS(r.converted.scene, "line 5, left out: tumour cell: pressure decreases");
  EXPECT_CONTAINS(r.converted.remark[3].text, "2 rules act on this behaviour");
}

TEST(PhysiCellRules, RangesThatNoResponseHasAreLeftOut) {
  const auto remark = [](const char* text, const BaseValues& base = {}) {
    return convert(text, base).converted.remark[0];
  };
  EXPECT_CONTAINS(remark("c,o,decreases,cycle entry,0.1,1,4,0").text, "falls to 0.1, not to 0");
  EXPECT_CONTAINS(remark("c,o,increases,apoptosis,0.01,0.1,1,4,0").text, "rises from 0.01");
  EXPECT_CONTAINS(remark("c,o,decreases,necrosis,0,1,4,0").text, "--base \"c:necrosis=0.001\"");
  EXPECT_TRUE(remark("c,o,decreases,necrosis,0,1,4,0", {{"c:necrosis", 0.01}}).converted);
  EXPECT_TRUE(remark("c,o,decreases,necrosis,0.01,0,1,4,0").converted);
  EXPECT_CONTAINS(remark("c,o,increases,apoptosis,1,1,1,1").text, "dead cells do not respond");
}

TEST(PhysiCellRules, RatesOfExchangeAreConverted) {
  const Read r = convert(
      "c,oxygen,decreases,VEGF secretion,0,5,4,0\nc,drug,increases,drug uptake,0.3,2,1,0\n"
      "c,drug,increases,drug export,0.3,2,1,0",
      {{"VEGF secretion", 0.12}});
  EXPECT_EQ(r.converted.n_converted, 2U);
  ASSERT_EQ(r.scene.rules.size(), 2U);
  EXPECT_EQ(r.scene.rules[0].behaviour, coupling::Behaviour::kSecretion);
  EXPECT_EQ(r.scene.rules[0].exchanged, "VEGF");
  EXPECT_TRUE(r.scene.rules[0].decreases);
  EXPECT_EQ(r.scene.rules[1].behaviour, coupling::Behaviour::kUptake);
  const std::vector<ExchangeEntry>& e = r.scene.cell_types.at("c").exchange;
  ASSERT_EQ(e.size(), 2U);
  EXPECT_EQ(e[0].substance, "VEGF");
  EXPECT_NEAR(e[0].secretion, 0.12 / 60, 1e-12);
  EXPECT_EQ(e[0].saturation, 1);
  EXPECT_NEAR(e[1].uptake, 0.3 / 60, 1e-12);
  EXPECT_EQ(r.scene.substances.size(), 3U);
  const ConvertedRules without = convert("c,oxygen,decreases,VEGF secretion,0,5,4,0").converted;
  EXPECT_EQ(without.n_converted, 0U);
  EXPECT_CONTAINS(without.remark[0].text, "give it in 1/min, as --base \"c:VEGF secretion=0.001\"");
}

TEST(PhysiCellRules, SignalsOfCellsAreConvertedWhereTheyMeanTheSame) {
  const std::string table =
      "c,volume,decreases,migration speed,0,2494,4,0\n"
      "c,contact with live cell,increases,apoptosis,0.01,6,4,0\n"
      "c,contact with big cell,increases,cell-cell adhesion,1,2,4,0\n"
      "c,pressure,decreases,cycle entry,0,0.5,4,0\n"
      "c,contact with dead cell,increases,apoptosis,0.01,6,4,0\n"
      "c,contact with BM,increases,apoptosis,0.01,6,4,0\n";
  const ConvertedRules without = convert(table).converted;
  EXPECT_EQ(without.n_converted, 3U);
  EXPECT_CONTAINS(without.remark[3].text, "has no unit, here it is in Pa");
  EXPECT_CONTAINS(without.remark[4].text, "dead cells are no neighbours");
  EXPECT_CONTAINS(without.remark[5].text, "contact with walls is no signal");
  EXPECT_CONTAINS(without.remark[1].text, "here those that touch count");
  const ConvertedRules with =
      convert_physicell_rules(parse_physicell_rules(table, "r"), {}, "rules", "r", 0.1);
  const Scene scene = parse_scene(with.scene, "rules.json");
  EXPECT_EQ(with.n_converted, 4U);
  EXPECT_TRUE(scene.substances.empty());
  ASSERT_EQ(scene.rules.size(), 5U);
  EXPECT_EQ(scene.rules[0].signal, coupling::Signal::kVolume);
  EXPECT_NEAR(scene.rules[0].half_max, 2494, 1e-9);
  EXPECT_EQ(scene.rules[2].signal, coupling::Signal::kNeighbours);
  EXPECT_EQ(scene.rules[2].half_max, 6);
  EXPECT_EQ(scene.rules[2].other, "");
  EXPECT_EQ(scene.rules[3].behaviour, coupling::Behaviour::kAdhesion);
  EXPECT_EQ(scene.rules[3].other, "big_cell");
  EXPECT_TRUE(scene.cell_types.contains("big_cell"));
  EXPECT_EQ(scene.rules[4].signal, coupling::Signal::kPressure);
  EXPECT_NEAR(scene.rules[4].half_max, 0.05, 1e-12) << "kPa, half of what 1 stands for";
}

TEST(PhysiCellRules, BaseValuesAreChecked) {
  EXPECT_EQ(parse_base_values({"necrosis=0.5", "a b:cycle entry=1e-3"}),
            (BaseValues{{"necrosis", 0.5}, {"a b:cycle entry", 1e-3}}));
  for (const char* text : {"necrosis", "necrosis=", "necrosis=x", "necrosis=-1", "necrosis=1 h"})
    EXPECT_THROW(parse_base_values({text}), Error) << text;
  EXPECT_THROW(convert("c,o,increases,apoptosis,1,1,1,0", {{"necrosis", 1}}), Error);
}

TEST(PhysiCellRules, NamesThatBecomeOneAreRefused) {
  EXPECT_THROW(convert("a b,o,increases,apoptosis,1,1,1,0\na_b,o,increases,necrosis,1,1,1,0"),
               Error);
}

TEST(PhysiCellRules, SceneIsWrittenOnce) {
  const std::string folder = testing::TempDir() + "physicell_scene";
  fs::remove_all(folder);
  const std::string table = test::source_path("tests/data/physicell_rules.csv");
  const ConvertedRules written = write_physicell_scene(table, folder, {});
  EXPECT_EQ(written.scene, folder + "/physicell_rules.json");
  EXPECT_EQ(written.n_converted, 4U) << "without the base rate of necrosis";
  EXPECT_THROW(write_physicell_scene(table, folder, {}), Error);
}

}  // namespace
}  // namespace acinus::runs
