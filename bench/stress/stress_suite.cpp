#include "bench/stress/stress_suite.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/stress/inspect.hpp"
#include "bench/stress/random_scene.hpp"
#include "bench/stress/verdict.hpp"
#include "core/error.hpp"
#include "io/disk.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/session/child.hpp"

namespace acinus::bench {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Wall-time limit given to a run, and time after which it counts as hung for ignoring that limit,
/// s.
constexpr double kRunTimeLimit = 60, kHangTimeLimit = 300;
constexpr std::size_t kMostConcurrentRuns = 2;

std::string hash_of_file(const std::string& path) {
  const std::string bytes = io::read_text_file(path);
  return fmt::format("{:016x}", XXH3_64bits(bytes.data(), bytes.size()));
}

/// True if the run itself reported the finding at the frame that shows it.
bool names(const std::vector<io::Event>& events, const Finding& f) {
  const char* code = f.defect == Defect::kCrossed     ? "self_intersection"
                     : f.defect == Defect::kTunnelled ? "deep_overlap"
                                                      : "";
  return std::ranges::any_of(events, [&](const io::Event& e) {
    return e.code == code && std::abs(e.time_s - f.time_s) < 1e-3;
  });
}

/// Substance with a concentration below 0 by more than the fields' solver may leave, or with a
/// number that is not finite; empty if none.
/// @param tolerance  of the solver, taken relative to the largest concentration
std::string wrong_substance(const Json& summary, double tolerance) {
  if (!summary.contains("substances")) return "";
  for (const auto& [name, figures] : summary["substances"].items()) {
    for (const auto& [figure, value] : figures.items())
      if (figure != "unit" && !value.is_number())
        return fmt::format("{} of {} is not finite", figure, name);
    if (figures["lowest"].get<double>() < -tolerance * figures["highest"].get<double>())
      return fmt::format("{} has a concentration of {}", name, figures["lowest"].dump());
  }
  return "";
}

/// Folder of all scenes; a temporary one is removed at the end.
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

/// Trial of one scene: written, run and inspected.
class RandomRun {
 public:
  RandomRun(std::uint64_t seed, const SceneKind& kind, const fs::path& root);
  const runs::Child& child() const { return *child_; }
  RunVerdict inspect();
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
            .limit_s = kHangTimeLimit};
  }
  Json summary() const;
  bool resumes() const;
  std::string last_line() const;

  RunVerdict result_;
  fs::path folder_;
  std::optional<runs::Child> child_;
};

RandomRun::RandomRun(std::uint64_t seed, const SceneKind& kind, const fs::path& root)
    : folder_(root / fmt::format("seed_{}", seed)) {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::create_directories(folder_, ignored);  // what fails shows when the scene is written
  const RandomScene scene = draw_scene(seed, kind);
  result_.seed = seed;
  result_.cells = scene.cells;
  io::write_text_file(file("scene.json"), scene.text);
  if (!scene.network.empty()) io::write_text_file(file(kNetworkFile), scene.network);
  child_.emplace(words("--overwrite", fmt::format("{} s", kRunTimeLimit)), child_options());
}

Json RandomRun::summary() const {
  if (!fs::exists(file("run/summary.json"))) return Json::object();
  return Json::parse(io::read_text_file(file("run/summary.json")), nullptr, false);
}

/// True if the run can be resumed from its checkpoint, even if it fails there again.
bool RandomRun::resumes() const {
  runs::Child again(words("--resume", "0.000001 s"), child_options());
  runs::wait_for_any({&again});
  const runs::ChildEnd end = again.collect();
  return end.code == static_cast<int>(Exit::kDone) ||
         end.code == static_cast<int>(Exit::kStopped) ||
         end.code == static_cast<int>(Exit::kCannotContinue);
}

std::string RandomRun::last_line() const {
  std::ifstream in(file("output.txt"));
  std::string line, last;
  while (std::getline(in, line))
    if (!line.empty()) last = line;
  return last;
}

RunVerdict RandomRun::inspect() {
  const runs::ChildEnd end = child_->collect();
  RunVerdict& j = result_;
  j.cpu_s = end.cpu_s;
  const auto settle = [&](TrialOutcome outcome, const std::string& cause) {
    j.outcome = outcome;
    j.cause = cause;
    return j;
  };
  if (end.timed_out)
    return settle(TrialOutcome::kHung, fmt::format("killed after {} s", kHangTimeLimit));
  if (end.signal != 0) return settle(TrialOutcome::kCrashed, fmt::format("signal {}", end.signal));
  if (end.code == static_cast<int>(Exit::kBadInput))
    return settle(TrialOutcome::kRefused, last_line());
  const bool stopped = end.code == static_cast<int>(Exit::kCannotContinue);
  const bool late = end.code == static_cast<int>(Exit::kStopped);
  if (end.code != 0 && !stopped && !late)
    return settle(TrialOutcome::kCrashed, fmt::format("exit {}: {}", end.code, last_line()));

  const Json s = summary();
  if (!s.is_object() || !s.contains("status"))
    return settle(TrialOutcome::kCrashed, fmt::format("exit {} without summary.json", end.code));
  if (s["status"] != (stopped ? "failed" : late ? "stopped" : "completed"))
    return settle(TrialOutcome::kCrashed,
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
  if (const std::string wrong = wrong_substance(s, scene.substance_grid.tolerance); !wrong.empty())
    return settle(TrialOutcome::kNotFinite, wrong);
  for (const Finding& f : found)
    if (f.defect == Defect::kNotFinite) return settle(TrialOutcome::kNotFinite, text(f));
  for (const Finding& f : found)
    if (concerns_family(f.defect)) return settle(TrialOutcome::kUnnoticed, text(f));
  if (stopped) {
    const std::string cause = s.value("cause", "");
    if (cause.empty()) return settle(TrialOutcome::kUnnoticed, "exit 3 without a cause");
    if (!resumes())
      return settle(TrialOutcome::kUnnoticed, "the checkpoint cannot be resumed: " + last_line());
    return settle(TrialOutcome::kStopped, cause);
  }
  // A start that overlaps is the scene's own doing; what counts is whether contact mends it.
  std::erase_if(found, [&](const Finding& f) {
    return f.defect == Defect::kTunnelled && f.time_s == 0 && !scene.start_up.enabled;
  });
  if (!found.empty()) {
    const bool named =
        std::ranges::all_of(found, [&](const Finding& f) { return names(events, f); });
    return settle(named ? TrialOutcome::kNamed : TrialOutcome::kUnnoticed,
                  found.size() == 1
                      ? text(found.front())
                      : fmt::format("{} ... {}", text(found.front()), text(found.back())));
  }
  if (late) return settle(TrialOutcome::kTimeLimit, s.value("cause", ""));
  return settle(TrialOutcome::kClean, "");
}

}  // namespace

BenchTable bench_stress(const BenchOptions& options) {
  const Workplace place(options.folder);
  const SceneKind kind{options.life, options.law};
  const std::string program = hash_of_file(runs::program_beside("acinus"));
  VerdictFile file(options.folder.empty() ? "" : (place.path() / "verdicts.jsonl").string(),
                   program, kind);
  const std::size_t most = options.threads == 1 ? 1 : kMostConcurrentRuns;
  const auto first = static_cast<std::uint64_t>(options.first);
  const std::uint64_t end = first + static_cast<std::uint64_t>(options.seeds);
  std::vector<RunVerdict> all;
  std::vector<RandomRun> running;
  for (const auto& [seed, verdict] : file.before())
    if (seed >= first && seed < end) all.push_back(verdict);
  if (!all.empty()) fmt::print("{} scenes were judged before\n", all.size());
  for (std::uint64_t seed = first; seed < end || !running.empty();) {
    for (; running.size() < most && seed < end; ++seed)
      if (!file.before().contains(seed)) running.emplace_back(seed, kind, place.path());
    if (running.empty()) break;
    std::vector<const runs::Child*> children;
    for (const RandomRun& trial : running) children.push_back(&trial.child());
    const auto done = running.begin() + static_cast<std::ptrdiff_t>(*runs::wait_for_any(children));
    const RunVerdict j = done->inspect();
    if (j.outcome == TrialOutcome::kClean) done->remove();
    running.erase(done);
    all.push_back(j);
    file.add(j);
  }
  std::ranges::sort(all, {}, &RunVerdict::seed);
  BenchTable table;
  for (const Family family : {Family::kNominal, Family::kWide}) {
    table.push_back(row_of(family, options.life, all));
    print_row(table.back());
  }
  for (const RunVerdict& j : all)
    if (j.outcome != TrialOutcome::kClean)
      fmt::print("seed {} ({}, {:.1f} s): {}: {}\n", j.seed, name_of(family_of(j.seed)), j.cpu_s,
                 name_of(j.outcome), j.cause);
  return table;
}

}  // namespace acinus::bench
