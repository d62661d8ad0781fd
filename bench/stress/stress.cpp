#include "bench/stress/stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/stress/inspect.hpp"
#include "bench/stress/random_scene.hpp"
#include "core/error.hpp"
#include "core/io/disk.hpp"
#include "runs/build/build_world.hpp"
#include "runs/scene/reader.hpp"
#include "runs/session/child.hpp"

namespace acinus::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Wall time a run is given, s, and the time after which it hangs: it did not obey the first.
constexpr double kRunTime = 60, kHangTime = 300;
constexpr std::size_t kAtATime = 2;

enum class Outcome {
  kClean,      ///< completed, nothing found
  kNamed,      ///< completed; what was found, the run told as an event
  kStopped,    ///< exit 3 with a cause and a checkpoint that opens
  kTimeLimit,  ///< stopped by its own wall-time limit, nothing found
  kRefused,    ///< exit 2: the generator's fault
  kCrashed,
  kHung,
  kNotFinite,
  kUnnoticed,  ///< the run found nothing wrong, the judge did
};
constexpr std::array kOutcomes{Outcome::kClean,     Outcome::kNamed,     Outcome::kStopped,
                               Outcome::kTimeLimit, Outcome::kRefused,   Outcome::kCrashed,
                               Outcome::kHung,      Outcome::kNotFinite, Outcome::kUnnoticed};
const char* name_of(Outcome outcome) {
  constexpr std::array kNames{"clean",   "named", "stopped",    "time_limit", "refused",
                              "crashed", "hung",  "not_finite", "unnoticed"};
  return kNames[static_cast<std::size_t>(outcome)];
}
bool is_failure(Outcome o) { return o >= Outcome::kRefused; }

/// What came of one scene.
struct Judgement {
  std::uint64_t seed = 0;
  Outcome outcome = Outcome::kClean;
  std::string cause;
  int cells = 0;
  double cpu_s = 0;
  std::map<std::string, int> events;  ///< how often each was told
};

/// Whether the run told of a finding itself, in the frame that shows it.
bool names(const std::vector<io::Event>& events, const Finding& f) {
  const char* code = f.defect == Defect::kCrossed     ? "self_intersection"
                     : f.defect == Defect::kTunnelled ? "deep_overlap"
                                                      : "";
  return std::ranges::any_of(events, [&](const io::Event& e) {
    return e.code == code && std::abs(e.time_s - f.time_s) < 1e-3;
  });
}

/// A folder for everything; a temporary one goes away at the end.
class Workplace {
 public:
  explicit Workplace(const std::string& folder) : keep_(!folder.empty()), path_(folder) {
    if (keep_) {
      std::error_code failed;
      fs::create_directories(path_, failed);
      if (failed) io::fail_on_disk(folder, "make the folder", failed.value());
      return;
    }
    path_ = io::make_temporary_folder("acinus_stress_");
  }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;
  ~Workplace() {
    std::error_code ignored;
    if (!keep_) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  bool keep_;
  fs::path path_;
};

/// One scene on its way: written, running, judged.
class Trial {
 public:
  Trial(std::uint64_t seed, bool life, const fs::path& root);
  const runs::Child& child() const { return *child_; }
  Judgement judge();
  void remove() const {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

 private:
  std::string file(const char* name) const { return (folder_ / name).string(); }
  std::vector<std::string> words(const char* how, const std::string& wall_time) const {
    return {"run",     file("scene.json"), how, "--out",          file("run"),
            "--quiet", "--threads",        "1", "--max-walltime", wall_time};
  }
  runs::ChildOptions child_options() const {
    return {.program = runs::program_beside("acinus"),
            .output = file("output.txt"),
            .limit_s = kHangTime};
  }
  Json summary() const;
  bool resumes() const;
  std::string last_line() const;

  Judgement result_;
  fs::path folder_;
  std::optional<runs::Child> child_;
};

Trial::Trial(std::uint64_t seed, bool life, const fs::path& root)
    : folder_(root / fmt::format("seed_{}", seed)) {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::create_directories(folder_, ignored);  // what fails shows when the scene is written
  const RandomScene scene = draw_scene(seed, life);
  result_.seed = seed;
  result_.cells = scene.cells;
  io::write_text_file(file("scene.json"), scene.text);
  if (!scene.network.empty()) io::write_text_file(file(kNetworkFile), scene.network);
  child_.emplace(words("--overwrite", fmt::format("{} s", kRunTime)), child_options());
}

Json Trial::summary() const {
  if (!fs::exists(file("run/summary.json"))) return Json::object();
  return Json::parse(io::read_text_file(file("run/summary.json")), nullptr, false);
}

/// Whether the checkpoint opens and the run goes on from it, be it into the same trouble.
bool Trial::resumes() const {
  runs::Child again(words("--resume", "0.000001 s"), child_options());
  runs::wait_for_any({&again});
  const runs::ChildEnd end = again.collect();
  return end.code == static_cast<int>(Exit::kDone) ||
         end.code == static_cast<int>(Exit::kStopped) ||
         end.code == static_cast<int>(Exit::kCannotContinue);
}

std::string Trial::last_line() const {
  std::ifstream in(file("output.txt"));
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

Judgement Trial::judge() {
  const runs::ChildEnd end = child_->collect();
  Judgement& j = result_;
  j.cpu_s = end.cpu_s;
  const auto settle = [&](Outcome outcome, const std::string& cause) {
    j.outcome = outcome;
    j.cause = cause;
    return j;
  };
  if (end.timed_out) return settle(Outcome::kHung, fmt::format("killed after {} s", kHangTime));
  if (end.signal != 0) return settle(Outcome::kCrashed, fmt::format("signal {}", end.signal));
  if (end.code == static_cast<int>(Exit::kBadInput)) return settle(Outcome::kRefused, last_line());
  const bool stopped = end.code == static_cast<int>(Exit::kCannotContinue);
  const bool late = end.code == static_cast<int>(Exit::kStopped);
  if (end.code != 0 && !stopped && !late)
    return settle(Outcome::kCrashed, fmt::format("exit {}: {}", end.code, last_line()));

  const Json s = summary();
  if (!s.is_object() || !s.contains("status"))
    return settle(Outcome::kCrashed, fmt::format("exit {} without summary.json", end.code));
  if (s["status"] != (stopped ? "failed" : late ? "stopped" : "completed"))
    return settle(Outcome::kCrashed,
                  fmt::format("exit {}, but status {}", end.code, s["status"].dump()));
  const runs::Scene scene = runs::read_scene(file("scene.json"));
  const io::RunReader run(file("run/run.vtkhdf"));
  std::vector<Finding> found =
      inspect_run(run, scene, runs::build_world(scene, Ranks::serial()).world);
  const std::vector<io::Event> events = run.events();
  for (const io::Event& e : events) ++j.events[e.code];
  const auto text = [&](const Finding& f) {
    return fmt::format("{} at {:.4g} s: {}", name_of(f.defect), f.time_s, f.what);
  };
  for (const Finding& f : found)
    if (f.defect == Defect::kNotFinite) return settle(Outcome::kNotFinite, text(f));
  for (const Finding& f : found)
    if (concerns_family(f.defect)) return settle(Outcome::kUnnoticed, text(f));
  if (stopped) {
    const std::string cause = s.value("cause", "");
    if (cause.empty()) return settle(Outcome::kUnnoticed, "exit 3 without a cause");
    if (!resumes())
      return settle(Outcome::kUnnoticed, "the checkpoint cannot be resumed: " + last_line());
    return settle(Outcome::kStopped, cause);
  }
  // A start that overlaps is the scene's own doing; what counts is whether contact mends it.
  std::erase_if(found, [&](const Finding& f) {
    return f.defect == Defect::kTunnelled && f.time_s == 0 && !scene.start_up.enabled;
  });
  if (!found.empty()) {
    const bool named =
        std::ranges::all_of(found, [&](const Finding& f) { return names(events, f); });
    return settle(named ? Outcome::kNamed : Outcome::kUnnoticed,
                  found.size() == 1
                      ? text(found.front())
                      : fmt::format("{} ... {}", text(found.front()), text(found.back())));
  }
  if (late) return settle(Outcome::kTimeLimit, s.value("cause", ""));
  return settle(Outcome::kClean, "");
}

/// What happened in scenes with life, as counted in the table.
constexpr std::array kLifeEvents{"division", "division_waits", "settling_failed", "death",
                                 "lysis",    "remeshed",       "mesh_degenerate"};

BenchRow row_of(Family family, bool life, const std::vector<Judgement>& all) {
  BenchRow row{name_of(family), 0, {}};
  std::map<Outcome, int> count;
  std::map<std::string, int> event;
  int n = 0;
  double cpu = 0;
  for (const Judgement& j : all) {
    if (family_of(j.seed) != family) continue;
    ++n;
    ++count[j.outcome];
    cpu += j.cpu_s;
    for (const auto& [code, times] : j.events) event[code] += times;
    row.cells += j.cells;
    row.passed = row.passed && !is_failure(j.outcome);
  }
  row.value.emplace_back("scenes", n);
  for (const Outcome o : kOutcomes) row.value.emplace_back(name_of(o), count[o]);
  if (life)
    for (const char* code : kLifeEvents) row.value.emplace_back(code, event[code]);
  row.value.emplace_back("cpu_s", cpu);
  return row;
}

}  // namespace

BenchTable bench_stress(const BenchOptions& options) {
  const Workplace place(options.folder);
  std::ofstream list;
  if (!options.folder.empty()) list.open(place.path() / "scenes.csv");
  list << "seed,family,outcome,cells,cpu_s,cause\n";
  const std::size_t most = options.threads == 1 ? 1 : kAtATime;
  const auto first = static_cast<std::uint64_t>(options.first);
  const std::uint64_t end = first + static_cast<std::uint64_t>(options.seeds);
  std::vector<Judgement> all;
  std::vector<Trial> running;
  for (std::uint64_t seed = first; seed < end || !running.empty();) {
    while (running.size() < most && seed < end)
      running.emplace_back(seed++, options.life, place.path());
    std::vector<const runs::Child*> children;
    for (const Trial& trial : running) children.push_back(&trial.child());
    const auto done = running.begin() + static_cast<std::ptrdiff_t>(*runs::wait_for_any(children));
    const Judgement j = done->judge();
    if (j.outcome == Outcome::kClean) done->remove();
    running.erase(done);
    all.push_back(j);
    list << fmt::format("{},{},{},{},{:.2f},\"{}\"\n", j.seed, name_of(family_of(j.seed)),
                        name_of(j.outcome), j.cells, j.cpu_s, j.cause)
         << std::flush;
  }
  std::ranges::sort(all, {}, &Judgement::seed);
  BenchTable table;
  for (const Family family : {Family::kNominal, Family::kWide}) {
    table.push_back(row_of(family, options.life, all));
    print_row(table.back());
  }
  for (const Judgement& j : all)
    if (j.outcome != Outcome::kClean)
      fmt::print("seed {} ({}, {:.1f} s): {}: {}\n", j.seed, name_of(family_of(j.seed)), j.cpu_s,
                 name_of(j.outcome), j.cause);
  return table;
}

}  // namespace acinus::bench
