#include "runs/session/run_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/numbers/time_grid.hpp"
#include "core/parallel/clock.hpp"
#include "core/parallel/memory.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "core/parallel/timing.hpp"
#include "coupling/simulation.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/memory_need.hpp"
#include "runs/assemble/start_state.hpp"
#include "runs/scene/frame_times.hpp"
#include "runs/session/advice.hpp"
#include "runs/session/progress.hpp"
#include "runs/session/recorder.hpp"
#include "runs/session/result_text.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/session/shell_quote.hpp"
#include "runs/session/skipped.hpp"
#include "runs/session/together.hpp"
#include "runs/session/traffic.hpp"

namespace acinus::runs {
namespace {

/// Guard that restores the default logger after a run, since a process may run several scenes.
struct LoggerKept {
  std::shared_ptr<spdlog::logger> before = spdlog::default_logger();
  LoggerKept() = default;
  ~LoggerKept() {
    spdlog::set_default_logger(before);
    spdlog::drop("run");
  }
  LoggerKept(const LoggerKept&) = delete;
  LoggerKept& operator=(const LoggerKept&) = delete;
};

/// Command line that resumes the run with the same scene, changes and folder.
std::string resume_command(const RunOptions& options) {
  std::string command = "acinus run " + quote_for_shell(options.scene_file) + " --resume --out " +
                        quote_for_shell(options.out);
  for (const std::string& change : options.set) command += " --set " + quote_for_shell(change);
  if (options.until_s) command += fmt::format(" --until '{} s'", *options.until_s);
  if (options.until_cells) command += fmt::format(" --until-cells {}", *options.until_cells);
  return command;
}

/// One run from its first to its last step.
class SceneRun {
 public:
  SceneRun(const Scene& scene, const RunOptions& options, BuiltWorld built);
  int go();

 private:
  coupling::Observer observer();
  bool events_over();
  void end_phase(const std::string& what);
  void note(const std::string& text);
  void warn(const std::string& text);
  void report(const Notes& notes);
  void show_result();
  bool frame_is_due() const;
  void write_frame(bool last);
  bool is_last() const;
  int loop();
  void close(RunOutcome status, const std::string& cause);
  void stop(const std::string& why);
  int finish(const coupling::LoopResult& steps);
  int give_up(const std::string& cause, const std::vector<std::int64_t>& cells);
  bool uses_too_much_memory();
  std::string own_reason_to_stop();
  std::string reason_to_stop();
  const coupling::World& world() const { return simulation_.world(); }
  double time() const { return simulation_.time(); }

  const Scene& scene_;
  const RunOptions& options_;
  Notes notes_;           ///< on the construction of the world
  double vessel_length_;  ///< total length, um
  coupling::Simulation simulation_;
  Recorder recorder_;
  double end_;  ///< simulated time at which the run ends, s
  Progress progress_;
  double started_ = wall_seconds(), last_save_ = started_;
  std::int64_t accepted_before_ = 0;  ///< steps of the runs this one continues
  double memory_limit_;               ///< bytes
  double next_memory_poll_ = 0;       ///< of memory use, on the clock of wall_seconds()
  bool was_running_ = false;          ///< before this step
  std::string stopped_by_;            ///< empty: not stopped
  Excess excess_;                     ///< overlaps that end the run if depth_um > 0
};

SceneRun::SceneRun(const Scene& scene, const RunOptions& options, BuiltWorld built)
    : scene_(scene),
      options_(options),
      notes_(std::move(built.notes)),
      vessel_length_(built.vessel_length),
      simulation_(std::move(built.world)),
      recorder_(scene, options, simulation_),
      end_(std::min(scene.time.end, options.until_s.value_or(scene.time.end))),
      progress_(options, end_, simulation_.world().ranks),
      memory_limit_(*options.max_memory) {}

bool SceneRun::uses_too_much_memory() {
  constexpr double kMemoryPollInterval =
      0.5;  // s between checks: steps of small scenes are shorter than one
  const double now = wall_seconds();
  if (now < next_memory_poll_) return false;
  next_memory_poll_ = now + kMemoryPollInterval;
  return static_cast<double>(rss_bytes()) > memory_limit_;
}

std::string SceneRun::reason_to_stop() { return first_text(world().ranks, own_reason_to_stop()); }

std::string SceneRun::own_reason_to_stop() {
  if (const std::string asked = describe_stop(); !asked.empty()) return asked;
  if (uses_too_much_memory()) return "the memory limit";
  if (std::filesystem::exists(options_.out + "/STOP")) return "the file STOP";
  return {};
}

bool SceneRun::is_last() const {
  const int most = options_.until_cells.value_or(scene_.time.until_cells);
  return time() >= end_ - kSameTime ||
         (was_running_ && most > 0 && coupling::count_cells(world().state) >= most);
}

bool SceneRun::frame_is_due() const {
  const bool starts = simulation_.is_running() && !was_running_;
  if (!(simulation_.is_running() || scene_.output.start_up)) return false;
  if (time() <= recorder_.last_frame() + kSameTime) return false;
  const double part = time() / scene_.output.every;
  return starts || is_last() ||
         std::abs(part - std::round(part)) * scene_.output.every < kSameTime ||
         (was_running_ &&
          next_frame_of_opening(scene_, time() - 2 * kSameTime) < time() + kSameTime);
}

void SceneRun::note(const std::string& text) {
  progress_.note(text);
  recorder_.add_note(text);
}

void SceneRun::warn(const std::string& text) {
  progress_.warn(text);
  recorder_.add_warning(text);
}

void SceneRun::end_phase(const std::string& what) {
  note(what);
  recorder_.add_event("start_up", what);
}

/// Writes a frame. Overlaps of the first frame are reported at once, since the run may stop because
/// of them hours later.
void SceneRun::write_frame(bool last) {
  if (const std::string text = recorder_.warn_of_outside(); !text.empty()) warn(text);
  const bool first = !recorder_.has_frame();
  excess_ = recorder_.write_frame(last);
  const Excess& start = recorder_.excess();
  if (!first || start.depth_um <= 0) return;
  simulation_.complete_points();  // for the advice
  warn(fmt::format(
      "the scene starts with overlaps: {}. Until contact has pushed them apart, forces and "
      "pressures mean nothing; if they do not shrink from frame to frame, the run stops. {}",
      start.cause, advise_start(scene_, world(), start)));
}

/// Writes frames and checkpoints that are due, after the life events of a step.
/// @return true if the run continues
bool SceneRun::events_over() {
  if (frame_is_due()) write_frame(time() >= end_ - kSameTime);
  if (excess_.depth_um > 0) return false;
  if (is_last() && simulation_.is_running()) return false;
  if (const std::string why = recorder_.completion_reason(); !why.empty()) {
    note("the experiment is over: " + why);
    return false;
  }
  was_running_ = simulation_.is_running();
  const bool is_due = wall_seconds() - last_save_ > options_.checkpoint_every_s;
  if (world().ranks.any(world().ranks.is_root() && is_due)) {
    recorder_.save();
    last_save_ = wall_seconds();
  }
  stopped_by_ = reason_to_stop();
  return stopped_by_.empty();
}

coupling::Observer SceneRun::observer() {
  return {.next_moment = [this](double time) { return next_frame(scene_, time); },
          .step =
              [this](const coupling::StepResult& step) {
                recorder_.write_series(step);
                progress_.step(world());
              },
          .phase = [this](const std::string& what) { end_phase(what); },
          .start = [this] { save_start(options_.out, scene_, world()); },
          .life = [this](const coupling::LifeReport& report) { recorder_.add_life(report); },
          .events_over = [this] { return events_over(); }};
}

void SceneRun::close(RunOutcome status, const std::string& cause) {
  if (const auto& spheres = simulation_.work().cbm; spheres.beyond > 0) {
    note(fmt::format(
        "the stiffness of spheres was evaluated beyond the range of its law in {:.2g} % of cases",
        100 * static_cast<double>(spheres.beyond) / static_cast<double>(spheres.corrected)));
  }
  if (const auto skipped = list_skipped_work(world(), simulation_.work()); !skipped.empty())
    progress_.detail(fmt::format("also skipped: {}", fmt::join(skipped, ", ")));
  if (status == RunOutcome::kCompleted)
    for (const std::string& idle : recorder_.idle_rules()) note(idle);
  recorder_.close(status, cause);
  progress_.finish();
}

int SceneRun::give_up(const std::string& cause, const std::vector<std::int64_t>& cells) {
  spdlog::error(cause);
  recorder_.add_event("cannot_continue", cause, cells);
  if (time() > recorder_.last_frame() + kSameTime) recorder_.write_frame(true);
  close(RunOutcome::kFailed, cause);
  if (world().ranks.is_root())
    fmt::print(stderr, "acinus: simulation cannot continue: {}\n", cause);
  return static_cast<int>(Exit::kCannotContinue);
}

void SceneRun::stop(const std::string& why) {
  recorder_.add_event("stopped", "stopped by " + why);
  close(RunOutcome::kStopped, "stopped by " + why);
  progress_.note(fmt::format("stopped by {} {}", why, describe_progress(world(), end_)) +
                 (options_.is_part ? "" : "; continue with: " + resume_command(options_)));
  // Obeyed; left there it would stop the resumed run too.
  if (world().ranks.is_root()) std::filesystem::remove(options_.out + "/STOP");
}

int SceneRun::loop() {
  was_running_ = simulation_.is_running();
  if (!options_.resume && (was_running_ || scene_.output.start_up)) write_frame(false);
  return finish(excess_.depth_um > 0 ? coupling::LoopResult{}
                                     : simulation_.run_until(end_, observer()));
}

int SceneRun::finish(const coupling::LoopResult& steps) {
  if (steps.last.interrupted) stopped_by_ = reason_to_stop();
  if (!steps.ok && stopped_by_.empty()) {
    simulation_.complete_points();  // for the advice
    return give_up(
        fmt::format(
            "a step of {} s still fails at t = {:.4g} h: {}. Cells concerned: {}. The last good "
            "state is in {}. {}",
            world().params.numerics.min_step, time() / 3600, steps.last.cause,
            steps.last.cells.empty() ? std::string("none named")
                                     : fmt::format("{}", fmt::join(steps.last.cells, ", ")),
            options_.out, advise(world(), steps.last)),
        steps.last.cells);
  }
  if (!stopped_by_.empty()) {
    stop(stopped_by_);
    return static_cast<int>(Exit::kStopped);
  }
  if (excess_.depth_um == 0) excess_ = recorder_.excess();
  if (excess_.depth_um > 0) simulation_.complete_points();
  if (excess_.depth_um > 0)
    return give_up(
        fmt::format("at t = {:.4g} h {}. The last frame in {} shows it. {}", time() / 3600,
                    excess_.cause, options_.out, advise(world(), excess_)),
        excess_.cells);
  close(RunOutcome::kCompleted, "");
  return static_cast<int>(Exit::kDone);
}

void SceneRun::report(const Notes& notes) {
  for (const std::string& text : notes.warnings) warn(text);
  for (const std::string& text : notes.info) note(text);
}

void SceneRun::show_result() {
  progress_.note(fmt::format("completed {} in {}; results in {}", format_duration(time()),
                             format_duration(recorder_.wall_s()), options_.out));
  for (const std::string& line :
       describe_result(world(), recorder_.totals(), recorder_.start_cells()))
    progress_.note(line);
  for (const std::string& line : describe_pressures(recorder_.measures())) progress_.note(line);
  if (options_.is_part) return;
  for (const std::string& line : advise_viewing(options_.out)) progress_.note(line);
}

int SceneRun::go() {
  if (options_.resume) {
    report(recorder_.resume());
    accepted_before_ = world().state.clock.accepted;
  } else {
    recorder_.create();
  }
  const coupling::State& s = world().state;
  const Ranks& ranks = world().ranks;
  const std::string threads =
      fmt::format("{} thread{}", options_.threads, options_.threads == 1 ? "" : "s");
  progress_.note(fmt::format(
      "{}: {}{}, {}", scene_.name,
      describe_cells(dcm::count_cells(s.dcm), static_cast<int>(s.cbm.n_cell())),
      vessel_length_ > 0 ? fmt::format(", {:.0f} um of vessels", vessel_length_) : "",
      ranks.is_alone() ? threads : fmt::format("{} processes of {}", ranks.size(), threads)));
  if (simulation_.work().system.ownership.is_whole() && !ranks.is_alone())
    progress_.note(
        "there are too few cells to share: until there are more, every process does all the work");
  report(notes_);
  if (const auto skipped = list_skipped(world()); !skipped.empty())
    progress_.detail(fmt::format("skipped: {}", fmt::join(skipped, ", ")));
  progress_.begin(world());
  const int code = loop();
  if (code == 0) show_result();
  if (options_.timings)
    for (const std::string& line : describe_traffic(
             ranks, world().state.clock.accepted - accepted_before_, wall_seconds() - started_))
      if (ranks.is_root()) fmt::print("{}\n", line);
  if (options_.timings && ranks.is_root())
    for (const std::string& line :
         describe_stages(simulation_.work().timings, recorder_.attempts()))
      fmt::print("{}\n", line);
  return code;
}

std::shared_ptr<spdlog::logger> open_log(const RunOptions& options, const Ranks& ranks) {
  if (!ranks.is_root()) return spdlog::null_logger_mt("run");
  auto log = spdlog::basic_logger_mt("run", options.out + "/run.log", !options.resume);
  // Few lines; someone may be following them, and a kill must not lose them.
  log->flush_on(spdlog::level::info);
  return log;
}

/// Ends all processes because this one failed. A failure common to all is reported by the first
/// process only; the others wait for it.
[[noreturn]] void end_all(const Ranks& ranks, const std::exception& failed) {
  constexpr unsigned kWaitForRoot = 3;  // s
  const auto* error = dynamic_cast<const Error*>(&failed);
  if (!ranks.is_root()) sleep(kWaitForRoot);
  fmt::print(stderr, "{}{}\n", failed.what(),
             ranks.is_root() ? "" : fmt::format(" (process {})", ranks.rank()));
  ranks.abort(static_cast<int>(error != nullptr ? error->code() : Exit::kInternal));
}

}  // namespace

int run_scene(const Scene& scene, const RunOptions& asked) {
  const Ranks ranks = Ranks::world();
  RunOptions options = asked;
  const ThreadShare threads = share_processors(ranks, options.threads);
  options.threads = threads.threads;
  if (!options.max_memory) options.max_memory = share_of_memory(threads.processes);
  set_threads(options.threads);
  BuiltWorld built = together(ranks, [&] {
    const ExitAtLimit nothing_to_save;
    check_alike(ranks, fmt::format("{} {}", ACINUS_VERSION, ACINUS_FLAGS), "program");
    check_alike(ranks, scene.resolved_json, "scene");
    check_memory(scene, *options.max_memory, ranks.size());
    BuiltWorld world = build_world(scene, ranks);
    world.world.sharing = options.sharing;
    return world;
  });
  if (!threads.warning.empty()) built.notes.warnings.push_back(threads.warning);
  std::optional<io::FileLock> writing;
  together(ranks, [&] {
    if (ranks.is_root()) writing.emplace(prepare_folder(options.out, options));
  });
  const LoggerKept keeping;
  spdlog::set_default_logger(open_log(options, ranks));
  spdlog::info("acinus {} {}: {}", ACINUS_VERSION, ACINUS_GIT, options.command_line);
  const StopSignals signals;
  try {
    return SceneRun(scene, options, std::move(built)).go();
  } catch (const std::exception& error) {
    spdlog::error(error.what());
    if (!ranks.is_alone()) end_all(ranks, error);
    throw;
  }
}

}  // namespace acinus::runs
