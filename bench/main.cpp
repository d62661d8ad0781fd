/// Program acinus-bench, also started by `acinus bench`.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "core/error.hpp"
#include "core/spelling.hpp"
#include "runs/program.hpp"

namespace acinus::bench {
namespace {

void check_name(const std::string& name, const std::vector<std::string>& names) {
  if (std::ranges::find(names, name) != names.end()) return;
  const std::string known = fmt::format("Known: {}", fmt::join(names, ", "));
  throw Error(fmt::format("no benchmark \"{}\". {}", name,
                          did_you_mean_and(nearest_name(name, names), known)));
}

int run(int argc, char** argv) {
  std::string name;
  BenchOptions options;
  CLI::App app("Measures speed and error; without NAME, lists the names.", "acinus bench");
  app.footer("Example: acinus bench dcm27 --threads 1 --csv results.csv");
  app.add_option("NAME", name, "benchmark");
  app.add_option("--json", options.json_file, "also write the rows here")->type_name("FILE");
  app.add_option("--csv", options.csv_file,
                 "also append the rows to this result file; a folder: to DATE_MACHINE.csv in it")
      ->type_name("FILE");
  app.add_option("--threads", options.threads, "threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  app.add_option("--seeds", options.seeds, "repetitions of random cases (default: 3)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000));
  app.add_option("--first", options.first,
                 "first seed of random cases (default: 1); --seeds 1 --first N repeats one")
      ->type_name("N")
      ->check(CLI::Range(1, 1000000000));
  app.add_flag("--life", options.life,
               "stress: the cells of the same scenes also grow, divide and die");
  app.add_option("--law", options.law,
                 "stress: contact law of all scenes (default: drawn for each)")
      ->type_name("LAW")
      ->check(CLI::IsMember({"cohesive", "maugis-dugdale"}));
  app.add_option("--radius", options.radius, "out-of-sample: radius of the cells, um (default: 12)")
      ->type_name("UM")
      ->check(CLI::Range(4.0, 40.0));
  app.add_option("--stiffness", options.stiffness,
                 "out-of-sample: factor on the moduli of the cells (default: 1)")
      ->type_name("F")
      ->check(CLI::Range(0.5, 2.0));
  app.add_option("--out", options.folder, "folder for plots and scenes")->type_name("DIR");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? static_cast<int>(Exit::kDone) : static_cast<int>(Exit::kBadInput);
  }
  const std::vector<std::string> names = list_benches();
  if (name.empty()) {
    for (const std::string& known : names) fmt::print("{}\n", known);
    return 0;
  }
  check_name(name, names);
  return run_bench(name, options);
}

}  // namespace
}  // namespace acinus::bench

int main(int argc, char** argv) {
  return acinus::runs::run_program([&] { return acinus::bench::run(argc, argv); });
}
