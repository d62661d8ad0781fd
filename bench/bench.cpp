#include "bench/bench.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "acinus_version.hpp"
#include "bench/output/bench_table.hpp"
#include "bench/output/result_file.hpp"
#include "bench/output/speed_index.hpp"
#include "bench/step/assembly.hpp"
#include "bench/step/fields.hpp"
#include "bench/step/nucleus_cost.hpp"
#include "bench/step/rank_traffic.hpp"
#include "bench/step/skipping.hpp"
#include "bench/step/step_cost.hpp"
#include "bench/stress/stress_suite.hpp"
#include "bench/tissue/accuracy.hpp"
#include "bench/tissue/contact_laws.hpp"
#include "bench/tissue/out_of_sample.hpp"
#include "bench/tissue/patch.hpp"
#include "bench/tissue/pull_off.hpp"
#include "bench/tissue/relaxation.hpp"
#include "bench/tissue/sheet_strength.hpp"
#include "bench/tissue/sleeping_lobule.hpp"
#include "bench/work_precision/work_precision.hpp"
#include "core/error.hpp"
#include "core/parallel/machine.hpp"
#include "core/parallel/ranks.hpp"
#include "core/parallel/threads.hpp"
#include "runs/session/together.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

const std::map<std::string, BenchTable (*)(const BenchOptions&)>& benches() {
  static const std::map<std::string, BenchTable (*)(const BenchOptions&)> all{
      {"accuracy", bench_accuracy},
      {"assembly", bench_assembly},
      {"cbm100k", bench_cbm100k},
      {"cbm10k", bench_cbm10k},
      {"cbm1m", bench_cbm1m},
      {"contact-laws", bench_contact_laws},
      {"contact-laws-pull-off", bench_contact_laws_pull_off},
      {"contact-laws-strength", bench_sheet_strength},
      {"dcm216", bench_dcm216},
      {"dcm27", bench_dcm27},
      {"fields", bench_fields},
      {"jkr", bench_jkr},
      {"nucleus", bench_nucleus},
      {"out-of-sample", bench_out_of_sample},
      {"patch", bench_patch},
      {"pull-off", bench_pull_off},
      {"pull-off-causes", bench_pull_off_causes},
      {"rank-memory", bench_rank_memory},
      {"ranks", bench_ranks},
      {"relaxation", bench_relaxation},
      {"skipping", bench_skipping},
      {"sleep", bench_sleep},
      {"stress", bench_stress},
      {"threads", bench_threads},
      {"work-precision", bench_work_precision},
      {"work-precision-capsule", bench_capsule},
      {"work-precision-cbm", bench_cbm},
      {"work-precision-clump", bench_clump},
      {"work-precision-growth", bench_growth},
      {"work-precision-stretch", bench_stretch}};
  return all;
}

/// @param speed_index  before and after the measurement, ms
void write_json(const std::string& file, const std::string& name, const ResultOrigin& origin,
                const std::pair<double, double>& speed_index, const BenchTable& table) {
  Json j = {{"name", name},
            {"commit", origin.commit},
            {"machine", origin.machine},
            {"instruction_set", origin.instruction_set},
            {"threads", origin.threads},
            {"speed_index_ms", {speed_index.first, speed_index.second}},
            {"rows", Json::array()}};
  for (const BenchRow& row : table) {
    Json r = {{"case", row.name}, {"cells", row.cells}};
    for (const auto& [key, value] : row.value) r[key] = value;
    j["rows"].push_back(r);
  }
  std::ofstream out(file);
  out << j.dump(2) << '\n';
  out.close();
  check(out.good(), file + ": cannot be written. Choose another file.", Exit::kFileError);
}

}  // namespace

std::vector<std::string> list_benches() {
  std::vector<std::string> names;
  for (const auto& [name, run] : benches()) names.push_back(name);
  return names;
}

int run_bench(const std::string& name, const BenchOptions& options) {
  const auto found = benches().find(name);
  check(found != benches().end(), fmt::format("bench {}: no such benchmark; there are: {}", name,
                                              fmt::join(list_benches(), ", ")));
  const Ranks ranks = Ranks::world();
  if (!ranks.is_alone() && name != "ranks" && name != "rank-memory")
    runs::together(ranks, [&] {
      throw Error(
          fmt::format("bench {} is one process: start it without mpirun. Only bench ranks and "
                      "rank-memory measure several.",
                      name));
    });
  const int threads = options.threads > 0 ? options.threads : processor_count();
  set_threads(threads);
  const Machine machine = describe_machine();
  const ResultOrigin origin{describe_command(name, options, threads),
                            ACINUS_GIT,
                            machine.cpu_model,
                            machine.instruction_set,
                            threads,
                            fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)))};
  const std::string csv_file = runs::together(ranks, [&] {
    const bool writes = !options.csv_file.empty() && ranks.is_root();
    return writes ? prepare_result_file(options.csv_file, origin) : std::string();
  });
  if (ranks.is_root())
    fmt::print("{}  commit {}  {}  {}  {} threads; CPU time, medians of repetitions\n", name,
               origin.commit, origin.machine, origin.instruction_set, threads);
  const double index_before = measure_speed_index();
  const BenchTable table = found->second(options);
  const double index_after = measure_speed_index();
  const bool passed = std::ranges::all_of(table, &BenchRow::passed);
  const int code = static_cast<int>(passed ? Exit::kDone : Exit::kInternal);
  if (!ranks.is_root()) return code;
  fmt::print("speed index (CPU time of a fixed loop): {:.3g} ms before, {:.3g} ms after\n",
             index_before, index_after);
  if (!csv_file.empty()) {
    BenchTable measured = table;
    for (BenchRow& row : measured)
      row.value.emplace_back("speed_index_ms", (index_before + index_after) / 2);
    append_results(csv_file, origin, measured);
  }
  if (!options.json_file.empty())
    write_json(options.json_file, name, origin, {index_before, index_after}, table);
  return code;
}

}  // namespace acinus::bench
