#include "runs/study/scheduler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "io/file_lock.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/study/active_run.hpp"
#include "runs/study/run_status.hpp"
#include "runs/study/study_laws.hpp"
#include "runs/study/study_progress.hpp"

namespace acinus::runs {
namespace {

constexpr double kPollInterval = 1;  ///< interval between checks of other processes, s

class Scheduler {
 public:
  Scheduler(const StudyPlan& plan, const std::vector<ChosenRun>& chosen,
            const ScheduleOptions& options)
      : plan_(plan), options_(options), progress_(plan, options.root, options.jobs, options.quiet) {
    for (const ChosenRun& c : chosen) {
      waiting_.push_back(c);
      if (c.own) ++n_own_;
    }
  }

  ScheduleResult go() {
    const StopSignals signals;
    result_.stopped = calibrate();
    count_done();
    while (!result_.stopped) {
      if (count_stop_signals() != 0) {
        stop();
        break;
      }
      start_what_can();
      if (active_.empty() && waiting_.empty()) break;
      progress_.show(counts(), active_);
      wait();
    }
    result_.left = n_own_ - result_.done - result_.failed;
    progress_.finish();
    return result_;
  }

 private:
  /// Provides the stiffness laws that the waiting runs need.
  /// @return true if stopped by a signal
  bool calibrate() {
    std::vector<const StudyRun*> runs;
    for (const ChosenRun& c : waiting_) {
      if (is_left(inspect_run(options_.root, plan_.runs[c.run]).state))
        runs.push_back(&plan_.runs[c.run]);
    }
    return resolve_laws(runs, options_.jobs * options_.child.threads, options_.quiet, no_law_);
  }

  /// Counts the runs completed earlier, so that the first estimate of the time left includes them.
  void count_done() {
    std::erase_if(waiting_, [&](const ChosenRun& c) {
      if (!c.own || inspect_run(options_.root, run_of(c)).state != RunState::kDone) return false;
      count(c, true);
      return true;
    });
  }

  StudyCounts counts() const {
    StudyCounts c{n_own_, result_.done, result_.failed, {}};
    for (const ChosenRun& w : waiting_) c.waiting.push_back(w.run);
    return c;
  }

  const StudyRun& run_of(const ChosenRun& c) const { return plan_.runs[c.run]; }

  void count(const ChosenRun& c, bool done) {
    if (c.own) ++(done ? result_.done : result_.failed);
    if (!done) failed_.insert(c.run);
  }

  void fail(const ChosenRun& c, const std::string& cause) {
    progress_.note(fmt::format("{} failed: {}", run_of(c).name, cause));
    count(c, false);
  }

  void start_what_can() {
    for (std::size_t k = 0; k < waiting_.size();) {
      if (static_cast<int>(active_.size()) >= options_.jobs) return;
      if (try_start(waiting_[k]))
        waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(k));
      else
        ++k;
    }
  }

  /// Starts or settles a run if possible.
  /// @return false if the run must wait
  bool try_start(const ChosenRun& c) {
    const StudyRun& run = run_of(c);
    if (!c.own && (has_start(options_.root, run) || !needed(c.run))) return true;
    if (inspect_run(options_.root, run).state == RunState::kDone) {
      count(c, true);
      return true;
    }
    if (run.source >= 0 && !has_start(options_.root, source_of(run))) {
      const std::size_t source = run.source;
      if (is_pending(source) ||
          inspect_run(options_.root, source_of(run)).state == RunState::kRunning)
        return false;
      const RunStatus of_source = inspect_run(options_.root, source_of(run));
      fail(c, describe_missing_start(source_of(run), of_source) +
                  (failed_.contains(source) ? "" : "; remove its folder to run it again"));
      return true;
    }
    const std::string folder = options_.root + "/" + run.folder;
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    check(!code, fmt::format("{}: cannot be made: {}", folder, code.message()), Exit::kFileError);
    std::optional<io::FileLock> claim = io::FileLock::try_take(claim_file(options_.root, run));
    if (!claim || is_being_written(folder)) return false;  // another process has it
    settle(c, std::move(*claim));
    return true;
  }

  /// Settles a run whose claim is held: counts it as complete or failed, or starts it.
  void settle(const ChosenRun& c, io::FileLock claim) {
    const StudyRun& run = run_of(c);
    const RunStatus status = inspect_run(options_.root, run, true);
    if (status.state == RunState::kDone) return count(c, true);
    const bool again = options_.overwrite && again_.insert(c.run).second;
    if (status.state == RunState::kFailed && !again) return fail(c, status.cause);
    if (const auto law = no_law_.find(run.name); law != no_law_.end()) {
      write_record(options_.root, plan_, run, {law->second, false});
      return fail(c, law->second);
    }
    active_.push_back(start_run(plan_, c.run, options_.root, std::move(claim),
                                status.state == RunState::kToResume, options_.child));
    chosen_[c.run] = c;
  }

  const StudyRun& source_of(const StudyRun& run) const { return plan_.runs[run.source]; }

  bool is_pending(std::size_t run) const {
    const auto is_it = [run](const auto& other) { return other.run == run; };
    return std::ranges::any_of(waiting_, is_it) || std::ranges::any_of(active_, is_it);
  }

  bool needed(std::size_t source) const {
    return std::ranges::any_of(waiting_, [&](const ChosenRun& c) {
      return run_of(c).source == static_cast<int>(source) && c.run != source;
    });
  }

  void wait() {
    std::vector<const Child*> children;
    for (const ActiveRun& a : active_) children.push_back(&a.child);
    if (const auto ended = wait_for_any(children, kPollInterval)) finish(*ended);
  }

  void finish(std::size_t k) {
    ActiveRun ended = std::move(active_[k]);
    active_.erase(active_.begin() + static_cast<std::ptrdiff_t>(k));
    const ChildEnd end = ended.child.collect();
    const ChosenRun c = chosen_.at(ended.run);
    const StudyRun& run = run_of(c);
    std::error_code ignored;
    std::filesystem::remove(ended.folder + "/progress.txt", ignored);
    const RunStatus status = inspect_run(options_.root, run, true);
    if (end.code == static_cast<int>(Exit::kDone)) {
      progress_.add(run, status.cpu_s);
      return count(c, true);
    }
    std::string cause = printed_cause(ended.folder + "/output.txt");
    if (end.signal != 0)
      cause = fmt::format("ended by signal {}{}{}", end.signal, cause.empty() ? "" : ": ", cause);
    if (end.code == static_cast<int>(Exit::kStopped)) {
      cause = "stopped from outside, with a checkpoint";
    } else if (end.code == static_cast<int>(Exit::kBadInput) && run.source >= 0 &&
               !has_start(options_.root, source_of(run))) {
      waiting_.push_back(c);  // another task began that run anew just now
      return;
    }
    if (status.state == RunState::kFailed) cause = status.cause;
    if (cause.empty()) cause = fmt::format("exit code {}", end.code);
    if (count_stop_signals() == 0) {
      write_record(options_.root, plan_, run, {cause, end.signal != 0});
      fail(c, cause);
    }
  }

  /// Stops all children with a checkpoint and waits for them; a second signal kills them.
  void stop() {
    result_.stopped = true;
    progress_.note("stopping: every run writes a checkpoint");
    for (const ActiveRun& a : active_) a.child.send(SIGTERM);
    const int first = count_stop_signals();
    while (!active_.empty()) {
      if (count_stop_signals() != first)
        for (const ActiveRun& a : active_) a.child.send(SIGKILL);
      wait();
    }
  }

  const StudyPlan& plan_;
  ScheduleOptions options_;
  StudyProgress progress_;
  ScheduleResult result_;
  int n_own_ = 0;
  std::vector<ChosenRun> waiting_;
  std::vector<ActiveRun> active_;
  std::map<std::size_t, ChosenRun> chosen_;  ///< of the active runs
  std::set<std::size_t> failed_;
  std::set<std::size_t> again_;                ///< failed runs that are repeated
  std::map<std::string, std::string> no_law_;  ///< run name -> reason why its law is missing
};

void check_stale(const StudyPlan& plan, const std::vector<ChosenRun>& chosen,
                 const ScheduleOptions& options) {
  std::string list;
  int n = 0;
  for (const ChosenRun& c : chosen) {
    const StudyRun& run = plan.runs[c.run];
    if (inspect_run(options.root, run).state != RunState::kStale) continue;
    if (++n <= 10) list += "  " + options.root + "/" + run.folder + "\n";
  }
  if (n > 10) list += fmt::format("  ... and {} more\n", n - 10);
  check(n == 0 || options.overwrite,
        fmt::format("{} run folders hold results of another scene, seed or version:\n{}They are "
                    "never replaced unasked: run them again with --overwrite, or choose another "
                    "--out.",
                    n, list));
}

}  // namespace

ScheduleResult run_all(const StudyPlan& plan, const std::vector<ChosenRun>& chosen,
                       const ScheduleOptions& options) {
  check_stale(plan, chosen, options);
  return Scheduler(plan, chosen, options).go();
}

}  // namespace acinus::runs
