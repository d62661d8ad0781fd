#include "runs/study/study_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "io/tidy_table.hpp"

namespace acinus::runs {
namespace {

/// Field of a CSV file [RFC 4180] on one line, since some readers do not accept line breaks.
std::string field(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// Conversion factor from the unit of a file to that of the plan; 0 for different dimensions.
double factor(const std::string& from, const std::string& to) {
  if (from == to) return 1;
  const UnitScale a = scale_of_unit(from), b = scale_of_unit(to);
  return a.dimension == b.dimension ? a.in_base / b.in_base : 0;
}

RunData read_run(const StudyPlan& plan, const StudyRun& run, const std::string& root) {
  RunData data{inspect_run(root, run), {}, 0};
  if (data.status.state == RunState::kStale || data.status.state == RunState::kToDo ||
      data.status.state == RunState::kRefused)
    return data;
  const std::string file = root + "/" + run.folder + "/run.vtkhdf";
  if (!std::filesystem::exists(file)) return data;
  try {
    const io::RunReader reader(file);
    const std::map<std::string, std::string> units = reader.observable_unit();
    std::map<std::string, std::vector<double>> column = reader.observables();
    const std::vector<double> time = std::exchange(column["time"], {});
    if (!time.empty()) data.until = time.back();
    for (const auto& [name, value] : column) {
      const auto unit = plan.units.find(name);
      if (unit == plan.units.end()) continue;
      const double scale = factor(units.at(name), unit->second);
      if (scale == 0) continue;
      TimeCurve& curve = data.curve[name];
      for (std::size_t k = 0; k < std::min(time.size(), value.size()); ++k) {
        if (!std::isfinite(value[k])) continue;
        curve.time.push_back(time[k]);
        curve.value.push_back(scale * value[k]);
      }
    }
  } catch (const Error& error) {
    data.status.cause = error.what();
  }
  return data;
}

bool is_wanted(const Study& study, const std::string& observable) {
  return study.observables.empty() ||
         std::ranges::find(study.observables, observable) != study.observables.end();
}

}  // namespace

StudyData read_study_data(const StudyPlan& plan, const std::string& root) {
  StudyData data;
  for (const StudyRun& run : plan.runs) data.push_back(read_run(plan, run, root));
  // Runs that wait for a start that failed have no folder that could say so.
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    RunStatus& status = data[k].status;
    if (plan.runs[k].source < 0 || status.state != RunState::kToDo) continue;
    const std::size_t source = plan.runs[k].source;
    if (!has_failed(data[source].status.state) || has_start(root, plan.runs[source])) continue;
    status.state = RunState::kRefused;
    status.cause = describe_missing_start(plan.runs[source], data[source].status);
  }
  return data;
}

void write_table(const StudyPlan& plan, const StudyData& data, const std::string& root) {
  std::vector<std::string> runs, variants, observables, units;
  std::vector<std::int64_t> seeds;
  std::vector<double> times, values;
  std::string csv = "run,variant,seed,time_s,observable,value,unit\n";
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const StudyRun& run = plan.runs[k];
    const std::string& variant = plan.variant_of(run).name;
    for (const auto& [name, curve] : data[k].curve) {
      if (!is_wanted(plan.study, name)) continue;
      const std::string& unit = plan.units.at(name);
      for (std::size_t i = 0; i < curve.time.size(); ++i) {
        csv += fmt::format("{},{},{},{},{},{},{}\n", field(run.name), field(variant), run.seed,
                           curve.time[i], name, curve.value[i], field(unit));
        runs.push_back(run.name);
        variants.push_back(variant);
        seeds.push_back(static_cast<std::int64_t>(run.seed));
        times.push_back(curve.time[i]);
        observables.push_back(name);
        values.push_back(curve.value[i]);
        units.push_back(unit);
      }
    }
  }
  io::write_text_file(root + "/table.csv", csv);
  io::write_tidy_table(root + "/table.h5", {{"run", "", runs},
                                            {"variant", "", variants},
                                            {"seed", "1", seeds},
                                            {"time_s", "s", times},
                                            {"observable", "", observables},
                                            {"value", "in column unit", values},
                                            {"unit", "", units}});
}

void write_runs(const StudyPlan& plan, const StudyData& data, const std::string& root) {
  std::string csv = "run,variant,seed,state,simulated_s,wall_s,cpu_s,state_hash,cause\n";
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const StudyRun& run = plan.runs[k];
    const RunStatus& s = data[k].status;
    csv += fmt::format("{},{},{},{},{},{:.3f},{:.3f},{},{}\n", field(run.name),
                       field(plan.variant_of(run).name), run.seed, name_of(s.state), s.simulated_s,
                       s.wall_s, s.cpu_s, s.state_hash, field(s.cause));
  }
  io::write_text_file(root + "/runs.csv", csv);
}

}  // namespace acinus::runs
