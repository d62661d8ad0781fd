#include "runs/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>

#include "acinus_version.hpp"
#include "core/error.hpp"
#include "core/io/run_file.hpp"
#include "coupling/generate/vessel_surface.hpp"
#include "coupling/life/life.hpp"
#include "coupling/life/rules.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/start_up.hpp"
#include "coupling/step/stages.hpp"
#include "runs/advice.hpp"
#include "runs/build_world.hpp"
#include "runs/experiments/observer.hpp"
#include "runs/frame.hpp"
#include "runs/life_totals.hpp"
#include "runs/progress.hpp"
#include "runs/run_folder.hpp"
#include "runs/scene/frame_times.hpp"
#include "runs/skipped.hpp"
#include "runs/soundness.hpp"
#include "runs/start_state.hpp"
#include "runs/state_file.hpp"
#include "runs/stop_signals.hpp"
#include "runs/summary.hpp"

namespace acinus::runs {
namespace {

/// s, longest step after a wall or the capsule opened: what was before says nothing about it.
constexpr double kFirstFreeStep = 0.1;

/// The logger of a run goes with it: a process may run several scenes.
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

std::string now_text() {
  const std::time_t t = std::time(nullptr);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&t));
  return text;
}

/// What to type to go on: the same scene, changes and folder.
std::string resume_command(const RunOptions& options) {
  const auto quoted = [](const std::string& text) {
    constexpr const char* kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=-+,:";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string inside;
    for (char c : text) inside += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return "'" + inside + "'";
  };
  std::string command =
      "acinus resume " + quoted(options.scene_file) + " --out " + quoted(options.out);
  for (const std::string& change : options.set) command += " --set " + quoted(change);
  return command;
}

/// One run from its first to its last step.
class Run {
 public:
  Run(const Scene& scene, const RunOptions& options);
  int go();

 private:
  void start_or_resume();
  int loop();
  double time() const { return coupling::time_since_start(world()); }
  coupling::World& world() { return built_.world; }
  const coupling::World& world() const { return built_.world; }
  double time_to_next_event() const;
  /// @return why the run must not go on from this frame, with depth_um = 0 if it may
  Excess write_frame();
  void write_series(const coupling::StepResult& step);
  void add_event(const std::string& code, const std::string& message,
                 const std::vector<std::int64_t>& cells = {});
  void tell(const coupling::LifeReport& report);  ///< what happened to cells between steps
  /// Whether the step failed at cells that die anyway: they are gone now.
  bool goes_on_without(const coupling::StepResult& step);
  bool enough_cells() const;
  int count_cells() const;
  void start_anew();  ///< the next step is a first one
  void save();
  void close(const std::string& status, const std::string& cause);
  std::string reason_to_stop() const;
  int fail(const coupling::StepResult& step);
  int fail(const Excess& excess);
  int give_up(const std::string& cause, const std::vector<std::int64_t>& cells);

  const Scene& scene_;
  RunOptions options_;
  BuiltWorld built_;
  coupling::Workspace work_;
  coupling::VesselSurface vessel_surface_;
  std::optional<io::RunFile> file_;
  RunTotals totals_;
  LifeTotals life_;
  Observer observer_;
  double end_;
  double started_ = wall_seconds(), started_cpu_ = cpu_seconds();
  double wall_before_ = 0, cpu_before_ = 0;  ///< of the runs this one continues
  double last_save_ = wall_seconds();
  double last_frame_ = -1e300;  ///< s, time of the last written frame
  /// um beyond the limit in the last frame. The first one may overlap: contact is given a chance.
  Excess excess_{std::numeric_limits<double>::infinity(), {}, {}};
  Progress progress_;
};

Run::Run(const Scene& scene, const RunOptions& options)
    : scene_(scene),
      options_(options),
      built_(build_world(scene, Ranks::world())),
      end_(std::min(scene.time.end, options.until_s.value_or(scene.time.end))),
      progress_(scene, options_, end_) {}

void Run::start_or_resume() {
  const std::string path = options_.out + "/run.vtkhdf";
  const io::RunFileOptions file_options{scene_.output.compression, 64};
  if (!options_.resume) {
    file_ = io::RunFile::create(path,
                                {{"scene", scene_.resolved_json},
                                 {"scene_sha", scene_.sha},
                                 {"command_line", options_.command_line},
                                 {"version", ACINUS_VERSION},
                                 {"git", ACINUS_GIT},
                                 {"compiler", ACINUS_COMPILER},
                                 {"flags", ACINUS_FLAGS},
                                 {"seed", std::to_string(scene_.seed)},
                                 {"ranks", std::to_string(world().ranks.size())},
                                 {"threads", std::to_string(options_.threads)},
                                 {"units", "um, s, nN"},
                                 {"start", now_text()}},
                                file_options);
    return;
  }
  const io::LoadedCheckpoint loaded = io::load_checkpoint(options_.out);
  if (!loaded.warning.empty()) progress_.note(loaded.warning);
  check_same_scene(loaded.data, scene_);
  get_state(loaded.data, world().state);
  const std::vector<double>& t = loaded.data.numbers("totals");
  check(t.size() == 16, loaded.data.source() + ": the run's totals are damaged.", Exit::kFileError);
  wall_before_ = t[0];
  cpu_before_ = t[1];
  totals_ = {t[0],  t[1],  t[2], t[13], t[3], t[4],  t[5], t[6], t[14],
             t[15], t[12], t[7], t[8],  t[9], t[10], 0,    0,    0};
  last_frame_ = t[11];
  life_ = get_totals(loaded.data);
  excess_ = {loaded.data.contains("file/excess") ? loaded.data.number("file/excess") : 0,
             "some cells overlap beyond what contact mends",
             {}};
  const std::vector<std::int64_t>& counts = loaded.data.integers("file/counts");
  check(counts.size() == 4, loaded.data.source() + ": the run file's counts are damaged.",
        Exit::kFileError);
  observer_ = get_observer(loaded.data);
  file_ = io::RunFile::open_for_append(path, {counts[0], counts[1], counts[2], counts[3]},
                                       file_options);
  progress_.note(fmt::format("resumed at {:.4g} h from {}", time() / 3600, loaded.file));
}

double Run::time_to_next_event() const {
  const coupling::Clock& c = world().state.clock;
  if (c.phase != coupling::Phase::kRun) return coupling::time_to_phase_event(world());
  const double t = time();
  auto to_next = [&](double every) {
    return (std::floor((t + kSameTime) / every) + 1) * every - t;
  };
  double limit = std::min(end_ - t, to_next(scene_.output.every));
  limit = std::min({limit, next_opening(scene_, t) - t, next_frame_of_opening(scene_, t) - t});
  limit = std::min(limit, coupling::time_to_event(world()));
  if (world().params.motility.leader_force > 0)
    limit = std::min(limit, to_next(world().params.motility.leader_grid));
  return limit;
}

Excess Run::write_frame() {
  const auto scope = work_.timings.scope("frames and audit");
  const Snapshot snapshot = take_snapshot(world(), work_);
  const coupling::AuditResult audit = audit_world(world(), work_, snapshot);
  add_audit(totals_, audit);
  std::vector<io::SeriesValue> observables;
  if (world().state.clock.phase == coupling::Phase::kRun)
    observables = observe_frame({scene_, world(), work_, snapshot, audit}, observer_);
  if (world().ranks.is_root())
    file_->append(make_frame(world(), work_, snapshot, vessel_surface_), observables);
  last_frame_ = snapshot.time;
  if (audit.n_self_intersecting > 0)
    add_event("self_intersection",
              fmt::format("{} cells cross themselves", audit.n_self_intersecting));
  Excess excess = find_excess(audit, world(), work_);
  if (excess.depth_um > 0) add_event("deep_overlap", excess.cause, excess.cells);
  // Overlaps of the start must shrink from frame to frame and be gone at the end.
  const bool shrinks = excess.depth_um < excess_.depth_um && time() < end_ - kSameTime;
  excess_ = excess;
  return shrinks ? Excess{} : excess;
}

void Run::write_series(const coupling::StepResult& step) {
  const coupling::State& s = world().state;
  const std::array<io::SeriesValue, 11> sample{
      {{"time", "s", time()},
       {"dt", "s", step.step},
       {"dcm_cells", "1", static_cast<double>(dcm::count_cells(s.dcm))},
       {"cbm_cells", "1", static_cast<double>(s.cbm.n_cell())},
       {"asleep", "1", static_cast<double>(coupling::count_asleep(s))},
       {"max_move", "um", step.max_move},
       {"error", "um", step.error},
       {"rejections", "1", static_cast<double>(step.rejections)},
       {"cg_iterations", "1", static_cast<double>(s.clock.cg_iterations)},
       {"balance_momentum", "1", s.balance.momentum},
       {"balance_torque", "1", s.balance.torque}}};
  file_->append_series(sample);
}

void Run::add_event(const std::string& code, const std::string& message,
                    const std::vector<std::int64_t>& cells) {
  file_->append_event({time(), code, cells, message});
}

int Run::count_cells() const { return coupling::count_cells(world().state); }

bool Run::enough_cells() const {
  const int most = options_.until_cells.value_or(scene_.time.until_cells);
  return most > 0 && count_cells() >= most;
}

void Run::tell(const coupling::LifeReport& report) {
  add_life(life_, report, count_cells(), wall_before_ + wall_seconds() - started_);
  observe_births(scene_, world(), report, observer_);
  for (const coupling::LifeEvent& e : report.events) add_event(e.code, e.message, e.cells);
}

bool Run::goes_on_without(const coupling::StepResult& step) {
  const coupling::LifeReport report =
      coupling::remove_dying(world(), work_, step.cells, step.cause);
  tell(report);
  return !report.events.empty();
}

void Run::start_anew() {
  coupling::Clock& clock = world().state.clock;
  clock.last_step = 0;
  clock.step = std::min(clock.step, kFirstFreeStep);
}

void Run::save() {
  const auto scope = work_.timings.scope("checkpoints");
  file_->flush();
  io::CheckpointData data;
  data.put("scene", scene_.resolved_json);
  put_state(world().state, data);
  const double wall = wall_before_ + wall_seconds() - started_,
               cpu = cpu_before_ + cpu_seconds() - started_cpu_;
  const RunTotals& t = totals_;
  data.put("totals", std::vector<double>{
                         wall, cpu, t.max_penetration_um, t.dcm_dcm_um, t.dcm_vessel_um,
                         t.dcm_wall_um, t.dcm_cbm_um, t.max_overlap_cbm_um, t.min_triangle_quality,
                         t.self_intersecting, t.inverted, last_frame_, t.dcm_cbm_beyond_um,
                         t.max_penetration_grown_um, t.cbm_vessel_um, t.cbm_wall_um});
  put_totals(life_, data);
  put_observer(observer_, data);
  const io::RunFileCounts c = file_->counts();
  data.put_number("file/excess", excess_.depth_um);
  data.put("file/counts", std::vector<std::int64_t>{c.frame, c.series, c.event, c.observable});
  io::save_checkpoint(options_.out, data);
  last_save_ = wall_seconds();
}

void Run::close(const std::string& status, const std::string& cause) {
  save();
  file_->set_provenance("end", now_text());
  file_->set_provenance("status", status);
  file_->close();
  totals_.wall_s = wall_before_ + wall_seconds() - started_;
  totals_.cpu_s = cpu_before_ + cpu_seconds() - started_cpu_;
  if (work_.cbm.beyond > 0) {
    built_.notes.push_back(fmt::format(
        "the stiffness of spheres was asked beyond the range of its law in {:.2g} % of cases",
        100 * static_cast<double>(work_.cbm.beyond) / static_cast<double>(work_.cbm.corrected)));
    progress_.note(built_.notes.back());
  }
  std::vector<std::string> skip = list_skipped(world());
  const std::vector<std::string> unneeded = list_skipped_work(world(), work_);
  skip.insert(skip.end(), unneeded.begin(), unneeded.end());
  if (!unneeded.empty()) progress_.note(fmt::format("also skipped: {}", fmt::join(unneeded, ", ")));
  write_summary(options_.out, {scene_, options_, world(), totals_, life_, observer_.measures,
                               work_.timings, skip, built_.notes, status, cause, options_.threads});
  progress_.finish();
}

std::string Run::reason_to_stop() const {
  if (const int signal = stop_signal(); signal != 0) return fmt::format("signal {}", signal);
  if (options_.max_walltime_s && wall_seconds() - started_ > *options_.max_walltime_s)
    return "the wall-time limit";
  if (std::filesystem::exists(options_.out + "/STOP")) return "the file STOP";
  return {};
}

int Run::fail(const coupling::StepResult& step) {
  return give_up(
      fmt::format("a step of {} s still fails at t = {:.4g} h: {}. Cells concerned: {}. The last "
                  "good state is in {}. {}",
                  world().params.numerics.min_step, time() / 3600, step.cause,
                  step.cells.empty() ? std::string("none named")
                                     : fmt::format("{}", fmt::join(step.cells, ", ")),
                  options_.out, advise(world(), step)),
      step.cells);
}

int Run::fail(const Excess& excess) {
  return give_up(fmt::format("at t = {:.4g} h {}. The last frame in {} shows it. {}", time() / 3600,
                             excess.cause, options_.out, advise(world(), excess)),
                 excess.cells);
}

int Run::give_up(const std::string& cause, const std::vector<std::int64_t>& cells) {
  spdlog::error(cause);
  add_event("cannot_continue", cause, cells);
  if (time() > last_frame_ + kSameTime) write_frame();
  close("failed", cause);
  fmt::print(stderr, "acinus: simulation cannot continue: {}\n", cause);
  return static_cast<int>(Exit::kCannotContinue);
}

int Run::loop() {
  if (!options_.resume &&
      (world().state.clock.phase == coupling::Phase::kRun || scene_.output.start_up))
    if (const Excess excess = write_frame(); excess.depth_um > 0) return fail(excess);
  bool first = true;
  for (;;) {
    const bool running = world().state.clock.phase == coupling::Phase::kRun;
    if (running && time() >= end_ - kSameTime) break;
    if (const std::string why = reason_to_stop(); !why.empty() && !first) {
      add_event("stopped", "stopped by " + why);
      close("stopped", "stopped by " + why);
      progress_.note(
          fmt::format("stopped by {}; continue with: {}", why, resume_command(options_)));
      std::filesystem::remove(options_.out +
                              "/STOP");  // obeyed; left there it would stop the resumed run too
      return static_cast<int>(Exit::kStopped);
    }
    first = false;
    const double opening = next_opening(scene_, time()),
                 extra_frame = next_frame_of_opening(scene_, time());
    const coupling::StepResult step = coupling::advance(world(), work_, time_to_next_event());
    if (!step.accepted) {
      if (goes_on_without(step)) continue;
      return fail(step);
    }
    write_series(step);
    progress_.step(world());
    if (!running) {
      const std::string what = coupling::update_phase(world(), work_);
      if (!what.empty()) {
        progress_.note(what);
        built_.notes.push_back(what);
        add_event("start_up", what);
      }
      if (world().state.clock.phase == coupling::Phase::kRun) {
        save_start(options_.out, scene_, world().state);
        coupling::begin_life(world());
      }
    }
    const bool now_running = world().state.clock.phase == coupling::Phase::kRun;
    if (running && time() > opening - kSameTime) start_anew();
    if (running) tell(coupling::live(world(), work_));
    const bool last = time() >= end_ - kSameTime || (running && enough_cells());
    const double t = time(), part = t / scene_.output.every;
    const bool on_grid = std::abs(part - std::round(part)) * scene_.output.every < kSameTime ||
                         (running && t > extra_frame - kSameTime);
    if ((now_running || scene_.output.start_up) && t > last_frame_ + kSameTime &&
        (on_grid || last || (now_running && !running)))
      if (const Excess excess = write_frame(); excess.depth_um > 0) return fail(excess);
    if (last && now_running) break;
    if (wall_seconds() - last_save_ > options_.checkpoint_every_s) save();
  }
  if (excess_.depth_um > 0) return fail(excess_);
  close("completed", "");
  return static_cast<int>(Exit::kDone);
}

int Run::go() {
  if (options_.threads <= 0) options_.threads = omp_get_num_procs();
  omp_set_num_threads(options_.threads);
  check(world().ranks.size() == 1,
        "this version runs on one rank; start it without mpirun and use --threads.");
  const io::FileLock writing = prepare_folder(options_.out, options_);
  const LoggerKept keeping;
  auto log = spdlog::basic_logger_mt("run", options_.out + "/run.log", !options_.resume);
  log->flush_on(spdlog::level::info);  // few lines; someone may be following them, and a kill must
                                       // not lose them
  spdlog::set_default_logger(log);
  spdlog::info("acinus {} {}: {}", ACINUS_VERSION, ACINUS_GIT, options_.command_line);
  const StopSignals signals;

  vessel_surface_ = coupling::make_vessel_surface(world().params.around.vessels.network);
  start_or_resume();
  coupling::size_workspace(world(), work_);
  if (!options_.resume) life_.start_cells = count_cells();
  const coupling::State& s = world().state;
  progress_.note(fmt::format("{}: {} DCM + {} CBM cells, {:.0f} um of vessels, {} threads",
                             scene_.name, dcm::count_cells(s.dcm), s.cbm.n_cell(),
                             built_.vessel_length, options_.threads));
  for (const std::string& note : built_.notes) progress_.note(note);
  if (const auto skip = list_skipped(world()); !skip.empty())
    progress_.note(fmt::format("skipped: {}", fmt::join(skip, ", ")));
  progress_.begin(world());
  int code = 0;
  try {
    code = loop();
  } catch (const std::exception& error) {
    spdlog::error(error.what());
    throw;
  }
  if (code == 0) {
    progress_.note(fmt::format("completed {:.4g} h in {:.1f} s; results in {}", time() / 3600,
                               totals_.wall_s, options_.out));
    progress_.note(
        "to look at it: ParaView 5.12 or newer opens run.vtkhdf; older ones open run.xmf with "
        "\"XDMF Reader\"");
  }
  if (options_.timings)
    for (const StageTime& stage : work_.timings.stages())
      fmt::print("{:20s} {:9.3f} s wall {:9.3f} s CPU {:8d} calls\n", stage.name, stage.wall,
                 stage.cpu, stage.calls);
  return code;
}

}  // namespace

int run_scene(const Scene& scene, const RunOptions& options) {
  Run run(scene, options);
  return run.go();
}

}  // namespace acinus::runs
