#include "runs/read_observables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <utility>
#include <vector>

#include "core/io/checkpoint.hpp"
#include "core/io/run_reader.hpp"
#include "runs/read_summary.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
constexpr double kSameTime = 1e-3;  // s
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

Measures read_measures(const std::string& folder) {
  if (fs::exists(folder + "/summary.json")) return read_summary(folder).measures;
  Measures measures;
  if (!io::has_checkpoint(folder)) return measures;
  const io::CheckpointData data = io::load_checkpoint(folder).data;
  const std::string group = "measures/";
  for (const auto& [name, value] : data.all())
    if (name.starts_with(group)) measures[name.substr(group.size())] = data.numbers(name);
  return measures;
}

/// Times of the samples, put on the frame they belong to: days lose the last digit.
std::vector<double> times_of(const Measures& measures, const std::vector<double>& frames) {
  std::vector<double> times;
  if (const auto s = measures.find("time_s"); s != measures.end()) times = s->second;
  if (const auto d = measures.find("time_d"); d != measures.end())
    for (double t : d->second) times.push_back(86400 * t);
  for (double& t : times)
    for (double frame : frames)
      if (std::abs(frame - t) < kSameTime) t = frame;
  return times;
}

/// The last value at or before each time; the first one where there is none.
std::vector<double> sampled(const std::vector<double>& at, const std::vector<double>& value,
                            const std::vector<double>& times) {
  std::vector<double> out;
  for (double t : times) {
    const auto after = std::upper_bound(at.begin(), at.end(), t + kSameTime);
    const std::size_t k =
        after == at.begin() ? 0 : static_cast<std::size_t>(after - at.begin() - 1);
    out.push_back(k < value.size() ? value[k] : kNone);
  }
  return out;
}

}  // namespace

std::pair<std::string, std::string> split_unit(const std::string& measure) {
  constexpr std::array<std::pair<const char*, const char*>, 10> kEnds{{{"_per_mm3", "1/mm^3"},
                                                                       {"_per_mm2", "1/mm^2"},
                                                                       {"_um2", "um^2"},
                                                                       {"_um", "um"},
                                                                       {"_kPa", "kPa"},
                                                                       {"_Pa", "Pa"},
                                                                       {"_nN", "nN"},
                                                                       {"_s", "s"},
                                                                       {"_h", "h"},
                                                                       {"_d", "d"}}};
  for (const auto& [end, unit] : kEnds)
    if (measure.ends_with(end))
      return {measure.substr(0, measure.size() - std::string(end).size()), unit};
  return {measure, "1"};
}

io::ObservableRows read_observables(const std::string& run_folder) {
  const std::string file = run_folder + "/run.vtkhdf";
  if (!fs::exists(file)) return {};
  if (auto rows = io::read_observable_rows(file)) return *rows;
  const io::RunReader reader(file);
  std::vector<double> frames;
  for (int k = 0; k < reader.n_frame(); ++k) frames.push_back(reader.time_s(k));
  const Measures measures = read_measures(run_folder);
  io::ObservableRows rows;
  rows.time_s = times_of(measures, frames);
  if (rows.time_s.empty()) rows.time_s = frames;
  if (rows.time_s.empty()) return rows;
  for (const auto& [name, value] : measures) {
    const auto [plain, unit] = split_unit(name);
    if (plain != "time" && value.size() == rows.time_s.size()) rows.column[plain] = {unit, value};
  }
  const std::map<std::string, std::vector<double>> series = reader.series();
  const std::map<std::string, std::string> units = reader.series_unit();
  const auto time = series.find("time");
  if (time == series.end() || time->second.empty()) return rows;
  for (const auto& [name, value] : series)
    if (name != "time" && !rows.column.contains(name))
      rows.column[name] = {units.at(name), sampled(time->second, value, rows.time_s)};
  return rows;
}

}  // namespace acinus::runs
