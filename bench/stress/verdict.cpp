#include "bench/stress/verdict.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/disk.hpp"

namespace acinus::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kOutcomes{
    TrialOutcome::kClean,     TrialOutcome::kNamed,     TrialOutcome::kStopped,
    TrialOutcome::kTimeLimit, TrialOutcome::kRefused,   TrialOutcome::kCrashed,
    TrialOutcome::kHung,      TrialOutcome::kNotFinite, TrialOutcome::kUnnoticed};
bool is_failure(TrialOutcome o) { return o >= TrialOutcome::kRefused; }

/// Events of scenes with life that the table counts.
constexpr std::array kLifeEvents{"division", "division_waits", "settling_failed", "death",
                                 "lysis",    "remeshed",       "mesh_degenerate", "promotion",
                                 "demotion", "promotion_waits"};

/// Parses a line; empty if it is incomplete, or of another program or kind of scenes.
std::optional<RunVerdict> read_line(const std::string& line, const std::string& program,
                                    const SceneKind& kind) {
  const Json j = Json::parse(line, nullptr, false);
  if (!j.is_object() || j.value("program", "") != program ||
      j.value("life", !kind.life) != kind.life || j.value("law", "") != kind.law)
    return {};
  const std::string name = j.value("outcome", "");
  const auto outcome =
      std::ranges::find(kOutcomes, name, [](TrialOutcome o) { return std::string(name_of(o)); });
  if (outcome == kOutcomes.end()) return {};
  return RunVerdict{j.value("seed", std::uint64_t{0}),
                    *outcome,
                    j.value("cause", ""),
                    j.value("cells", 0),
                    j.value("cpu_s", 0.0),
                    j.value("events", std::map<std::string, int>{})};
}

}  // namespace

const char* name_of(TrialOutcome outcome) {
  constexpr std::array kNames{"clean",   "named", "stopped",    "time_limit", "refused",
                              "crashed", "hung",  "not_finite", "unnoticed"};
  return kNames[static_cast<std::size_t>(outcome)];
}

VerdictFile::VerdictFile(const std::string& path, const std::string& program, const SceneKind& kind)
    : program_(program), kind_(kind) {
  if (path.empty()) return;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);)
    if (const auto verdict = read_line(line, program, kind)) before_[verdict->seed] = *verdict;
  file_.open(path, std::ios::app);
  if (!file_) io::fail_on_disk(path, "write", errno);
  file_ << '\n';  // ends a torn line
}

void VerdictFile::add(const RunVerdict& v) {
  if (!file_.is_open()) return;
  const Json line{{"program", program_},
                  {"life", kind_.life},
                  {"law", kind_.law},
                  {"seed", v.seed},
                  {"outcome", name_of(v.outcome)},
                  {"cells", v.cells},
                  {"cpu_s", v.cpu_s},
                  {"cause", v.cause},
                  {"events", v.events}};
  file_ << line.dump(-1, ' ', false, Json::error_handler_t::replace) << std::endl;
}

BenchRow row_of(Family family, bool life, const std::vector<RunVerdict>& all) {
  BenchRow row{name_of(family), 0, {}};
  std::map<TrialOutcome, int> count;
  std::map<std::string, int> event;
  int n = 0;
  double cpu = 0;
  for (const RunVerdict& j : all) {
    if (family_of(j.seed) != family) continue;
    ++n;
    ++count[j.outcome];
    cpu += j.cpu_s;
    for (const auto& [code, times] : j.events) event[code] += times;
    row.cells += j.cells;
    row.passed = row.passed && !is_failure(j.outcome);
  }
  row.value.emplace_back("scenes", n);
  for (const TrialOutcome o : kOutcomes) row.value.emplace_back(name_of(o), count[o]);
  if (life)
    for (const char* code : kLifeEvents) row.value.emplace_back(code, event[code]);
  row.value.emplace_back("cpu_s", cpu);
  return row;
}

}  // namespace acinus::bench
