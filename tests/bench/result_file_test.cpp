/// Result files of benchmarks: header, fields, units, appending, faults found before a measurement.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "bench/output/result_file.hpp"
#include "io/disk.hpp"
#include "tests/messages.hpp"

namespace acinus::bench {
namespace {

const ResultOrigin kOrigin{
    "acinus bench x --threads 1", "abc", "Maker(R) Chip, 2.5 GHz", "avx2", 1, "2026-11-28"};
const std::string kFirstLine =
    "command,case,figure,value,unit,commit,machine,instruction set,threads,date\n";
const std::string kEnd = ",abc,\"Maker(R) Chip, 2.5 GHz\",avx2,1,2026-11-28\n";

class ResultFile : public testing::Test {
 protected:
  ~ResultFile() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  std::string folder_ = io::make_temporary_folder("acinus_result_file_");
};

TEST_F(ResultFile, HoldsOneFigureALineWithItsUnitAndOrigin) {
  const std::string file = prepare_result_file(path("a.csv"), kOrigin);
  append_results(file, kOrigin,
                 {{.name = "27 cells, \"nodes\"", .cells = 27, .value = {{"cpu_s", 0.125}}},
                  {.name = "plain", .value = {{"ratio", 1234567.25}, {"steps", 3e6}}}});
  const std::string start = "acinus bench x --threads 1,\"27 cells, \"\"nodes\"\"\",";
  EXPECT_EQ(io::read_text_file(file),
            kFirstLine + start + "cells,27," + kEnd + start + "cpu_s,0.125,s" + kEnd +
                "acinus bench x --threads 1,plain,ratio,1234567.25," + kEnd +
                "acinus bench x --threads 1,plain,steps,3000000," + kEnd);
}

TEST_F(ResultFile, IsAppendedToUnderOneHeader) {
  for (int run = 0; run < 2; ++run) {
    const std::string file = prepare_result_file(path("a.csv"), kOrigin);
    append_results(file, kOrigin, {{.name = "c", .value = {{"gain", run}}}});
  }
  EXPECT_EQ(io::read_text_file(path("a.csv")), kFirstLine + "acinus bench x --threads 1,c,gain,0," +
                                                   kEnd + "acinus bench x --threads 1,c,gain,1," +
                                                   kEnd);
}

TEST_F(ResultFile, EndsATornLineBeforeItAppends) {
  io::write_text_file(path("a.csv"), kFirstLine + "acinus bench x,torn");
  prepare_result_file(path("a.csv"), kOrigin);
  EXPECT_EQ(io::read_text_file(path("a.csv")), kFirstLine + "acinus bench x,torn\n");
}

TEST_F(ResultFile, TakesItsNameInAFolderFromDateAndMachine) {
  EXPECT_EQ(prepare_result_file(folder_, kOrigin), path("2026-11-28_maker_r_chip_2_5_ghz.csv"));
  ResultOrigin nameless = kOrigin;
  nameless.machine = "";
  EXPECT_EQ(prepare_result_file(folder_, nameless), path("2026-11-28_unknown.csv"));
}

TEST_F(ResultFile, IsRefusedBeforeTheMeasurement) {
  io::write_text_file(path("other.csv"), "time,force\n1,2\n");
  EXPECT_CONTAINS(test::fault_of([&] { prepare_result_file(path("other.csv"), kOrigin); }),
                  "other.csv:1: \"time,force\" ... header of a result file ... Choose another");
  EXPECT_EQ(io::read_text_file(path("other.csv")), "time,force\n1,2\n");
  EXPECT_CONTAINS(
      test::fault_of([&] { prepare_result_file(path("none/a.csv"), kOrigin); }, Exit::kFileError),
      "none/a.csv: cannot append to");
}

TEST(UnitOfFigure, IsTheEndOfItsName) {
  for (const auto& [figure, unit] : std::initializer_list<std::pair<const char*, const char*>>{
           {"cpu_s", "s"},
           {"pressure_error_Pa", "Pa"},
           {"area_per_contact_um2", "um^2"},
           {"force_per_contact_nN", "nN"},
           {"cpu_us_per_cell_step", "us"},
           {"us_per_cell", "us"},
           {"message_KB_per_step_most", "KB"},
           {"bytes_per_cell", "bytes"},
           {"tension_contact_min_mN_m", "mN/m"},
           {"million_per_s", ""},
           {"work_over_W_6_um", ""},
           {"cpu_over_that_without", ""},
           {"steps", ""},
           {"s", "s"},
           {"", ""}})
    EXPECT_EQ(unit_of_figure(figure), unit) << figure;
}

TEST(DescribeCommand, NamesWhatDiffersFromTheDefaults) {
  BenchOptions options;
  options.csv_file = "results.csv";
  EXPECT_EQ(describe_command("dcm27", options, 2), "acinus bench dcm27 --threads 2");
  options.first = 53;
  options.seeds = 1;
  options.life = true;
  EXPECT_EQ(describe_command("stress", options, 1),
            "acinus bench stress --threads 1 --seeds 1 --first 53 --life");
  options.law = "cohesive";
  EXPECT_EQ(describe_command("stress", options, 1),
            "acinus bench stress --threads 1 --seeds 1 --first 53 --life --law cohesive");
  options = {};
  options.radius = 9.5;
  options.stiffness = 0.5;
  EXPECT_EQ(describe_command("out-of-sample", options, 1),
            "acinus bench out-of-sample --threads 1 --radius 9.5 --stiffness 0.5");
}

}  // namespace
}  // namespace acinus::bench
