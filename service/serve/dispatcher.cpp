#include "service/serve/dispatcher.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "io/checkpoint.hpp"
#include "runs/session/child.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/run_folder.hpp"
#include "runs/study/active_run.hpp"
#include "service/serve/run_end.hpp"

namespace acinus::service {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

constexpr auto kDispatchInterval = std::chrono::seconds(1);
constexpr int kMostKills = 5;           ///< consecutive kills without progress
constexpr double kEndGracePeriod = 60;  ///< time for a run to end after exceeding a limit, s
constexpr int kPollsPerSize = 10;       ///< folder sizes are measured every so many polls
/// Hard resource limits beyond those of a run, bytes: address space for program, stacks and thread
/// pools, and file size. They only catch runs that evade the ordinary limits.
constexpr double kMemoryMargin = 4e9, kMemoryMarginPerThread = 2e8;

std::string progress_file(const std::string& folder) { return folder + "/progress.txt"; }

}  // namespace

struct Dispatcher::Active {
  Active(asio::io_context& io, runs::Child process, double limit)
      : child(std::move(process)), ended(io, ::dup(child.descriptor())), limit_s(limit) {}
  runs::Child child;
  asio::posix::stream_descriptor ended;  ///< readable once the child has ended
  double started = wall_seconds();
  /// Summaries older than this belong to earlier attempts. One second of margin for the file
  /// system's clock.
  FileTime began = FileTime::clock::now() - std::chrono::seconds(1);
  double limit_s;  ///< wall time of this attempt
  int polls = 0;
  bool to_stop = false;  ///< at a client's request
  std::string too_much;  ///< exceeded limit; "" = none
};

struct Dispatcher::Timers {
  asio::steady_timer poll;
};

Dispatcher::Dispatcher(asio::io_context& io, const ServeOptions& options, JobStore& store)
    : io_(io),
      options_(options),
      store_(store),
      disk_bytes_(JobStore::size_of(store.folder())),
      cache_bytes_(JobStore::size_of(store.cache_folder())),
      timers_(std::make_unique<Timers>(Timers{asio::steady_timer(io)})) {
  for (RunJob& job : store_.load(warnings_)) {
    const std::string folder = store_.run_folder(job.id);
    job.bytes = JobStore::size_of(folder);
    // A run may have ended while no service ran.
    // A torn one: the run is resumed from its checkpoint.
    if (job.state != JobState::kStopped)
      if (const auto summary = find_summary(folder, FileTime::min())) {
        job.time_s = job.end_s = summary->simulated_s;
        job.dcm = summary->dcm;
        job.cbm = summary->cbm;
      }
    jobs_[job.id] = std::make_unique<RunJob>(job);
  }
}

Dispatcher::~Dispatcher() = default;

void Dispatcher::move(RunJob& job, JobState to) {
  store_.move(job, to);
  ++revision_;
}

RunJob* Dispatcher::find(const std::string& id) {
  const auto found = jobs_.find(id);
  return found == jobs_.end() ? nullptr : found->second.get();
}

void Dispatcher::check_room() const {
  check(!ending_, "the service is about to end");
  const auto waiting = std::ranges::count_if(
      jobs_, [](const auto& j) { return j.second->state == JobState::kWaiting; });
  check(
      waiting < options_.max_waiting,
      fmt::format("{} runs wait already, as many as this service allows (--max-waiting)", waiting));
  check(disk_bytes_ < options_.max_disk,
        fmt::format("the service has used {:.3g} GB of disk, as much as it may (--max-disk). "
                    "Delete runs that are not needed.",
                    1e-9 * disk_bytes_));
}

void Dispatcher::measure(RunJob& job) {
  disk_bytes_ -= job.bytes;
  job.bytes = JobStore::size_of(store_.run_folder(job.id));
  disk_bytes_ += job.bytes;
}

void Dispatcher::measure(const std::string& id) {
  if (RunJob* job = find(id)) measure(*job);
}

void Dispatcher::fail(RunJob& job, const std::string& cause) {
  job.failed = true;
  job.cause = cause;
  move(job, JobState::kFailed);
}

RunJob& Dispatcher::submit(RunJob job) {
  try {
    check_room();
  } catch (const Error&) {
    store_.remove(job);
    throw;
  }
  store_.accept(job);
  disk_bytes_ += job.bytes;
  const std::string id = job.id;
  RunJob& kept = *(jobs_[id] = std::make_unique<RunJob>(std::move(job)));
  ++revision_;
  // From the loop: the caller is still busy with the job.
  asio::post(io_, [this] { start_what_can(); });
  return kept;
}

void Dispatcher::begin() {
  start_what_can();
  schedule_poll();
}

void Dispatcher::start_what_can() {
  for (const auto& [id, job] : jobs_) {
    if (ending_ || static_cast<int>(active_.size()) >= options_.jobs) return;
    if (job->state != JobState::kWaiting) continue;
    // A run of a service that was killed may still be writing its checkpoint.
    if (runs::is_being_written(store_.run_folder(id))) continue;
    try {
      start(*job);
    } catch (const std::exception& error) {
      fail(*job, error.what());
    }
  }
}

void Dispatcher::start(RunJob& job) {
  const std::string folder = store_.run_folder(job.id);
  std::error_code ignored;
  // It may have ended while no service ran.
  if (const auto summary = find_summary(folder, FileTime::min()))
    if (summary->status != runs::RunOutcome::kStopped)
      return finish_as(job, summary->status == runs::RunOutcome::kCompleted ? 0 : 3,
                       FileTime::min());
  job.cause.clear();
  const double limit_s = options_.max_walltime_s - job.used_s;
  if (limit_s <= 0) {
    job.cause = "the wall-time limit of this service (--max-walltime)";
    return move(job, JobState::kStopped);
  }
  move(job, JobState::kRunning);
  fs::remove(progress_file(folder), ignored);
  fs::remove(output_file(folder), ignored);
  const std::vector<std::string> words{"run",
                                       folder + "/scene.json",
                                       "--out",
                                       folder,
                                       "--threads",
                                       std::to_string(options_.threads),
                                       "--progress",
                                       "json",
                                       "--checkpoint-every",
                                       fmt::format("{} s", options_.checkpoint_every_s),
                                       "--max-walltime",
                                       fmt::format("{} s", limit_s),
                                       "--max-memory",
                                       fmt::format("{} MB", 1e-6 * options_.max_memory),
                                       "--max-cells",
                                       std::to_string(options_.max_cells),
                                       io::has_checkpoint(folder) ? "--resume" : "--overwrite"};
  runs::Child child(words, {.output = output_file(folder),
                            .progress = progress_file(folder),
                            .follows_parent = true,
                            .most_memory = options_.max_memory + kMemoryMargin +
                                           kMemoryMarginPerThread * options_.threads,
                            .largest_file = options_.max_run_bytes + kMemoryMargin});
  auto active = std::make_unique<Active>(io_, std::move(child), limit_s);
  wait_for_end(job, *(active_[job.id] = std::move(active)));
}

void Dispatcher::wait_for_end(RunJob& job, Active& active) {
  active.ended.async_wait(asio::posix::stream_descriptor::wait_read,
                          [this, &job](const boost::system::error_code& failed) {
                            if (failed) return;
                            try {
                              finish(job);
                            } catch (const std::exception& error) {
                              fail(job, error.what());
                            }
                          });
}

void Dispatcher::finish(RunJob& job) {
  const std::unique_ptr<Active> active = std::move(active_.extract(job.id).mapped());
  poll(job, *active);
  const runs::ChildEnd end = active->child.collect();
  job.used_s += wall_seconds() - active->started;
  const std::string folder = store_.run_folder(job.id);
  measure(job);
  disk_bytes_ -= cache_bytes_;
  cache_bytes_ = JobStore::size_of(store_.cache_folder());
  disk_bytes_ += cache_bytes_;
  job.left_s = -1;
  job.phase.clear();
  job.cause = active->too_much;
  if (ending_ && end.code != 0 && end.code != static_cast<int>(Exit::kCannotContinue)) {
    move(job, JobState::kWaiting);
  } else if (end.code == static_cast<int>(Exit::kStopped) ||
             (end.signal != 0 && (active->to_stop || !active->too_much.empty()))) {
    if (job.cause.empty() && !active->to_stop) job.cause = find_stop_cause(folder, active->began);
    move(job, JobState::kStopped);
  } else if (end.signal != 0) {
    wait_again_after_kill(job);
  } else if (end.code == static_cast<int>(Exit::kBadInput) && runs::is_being_written(folder)) {
    move(job, JobState::kWaiting);
  } else {
    finish_as(job, end.code, active->began);
  }
  if (ending_ && active_.empty() && all_ended_) return all_ended_();
  start_what_can();
}

void Dispatcher::finish_as(RunJob& job, int code, FileTime since) {
  const std::string folder = store_.run_folder(job.id);
  job.failed = code != 0;
  if (const auto summary = find_summary(folder, since)) {
    job.time_s = summary->simulated_s;
    job.dcm = summary->dcm;
    job.cbm = summary->cbm;
    if (code != 0) job.cause = summary->cause;
  }
  if (job.failed && job.cause.empty()) job.cause = printed_messages(folder);
  if (job.failed && job.cause.empty()) job.cause = fmt::format("exit code {}", code);
  if (!job.failed && job.dcm + job.cbm >= options_.max_cells)
    job.cause = fmt::format("ended at {} cells, the limit of this service", options_.max_cells);
  if (!job.failed && job.evaluation && on_evaluated) try {
      on_evaluated(job, folder);
    } catch (const std::exception& error) {
      job.failed = true;
      job.cause = error.what();
    }
  move(job, job.failed ? JobState::kFailed : JobState::kCompleted);
}

void Dispatcher::wait_again_after_kill(RunJob& job) {
  const bool got_further = job.time_s > job.checkpoint_s;
  job.checkpoint_s = job.time_s;
  job.kills = got_further ? 1 : job.kills + 1;
  job.failed = job.kills >= kMostKills;
  if (job.failed) job.cause = fmt::format("killed {} times without getting any further", job.kills);
  move(job, job.failed ? JobState::kFailed : JobState::kWaiting);
}

void Dispatcher::schedule_poll() {
  timers_->poll.expires_after(kDispatchInterval);
  timers_->poll.async_wait([this](const boost::system::error_code& failed) {
    if (failed) return;
    // Whatever goes wrong with one run, the others are still polled.
    for (const auto& [id, active] : active_) poll(*jobs_.at(id), *active);
    try {
      start_what_can();
    } catch (const std::exception& error) {
      fmt::print(stderr, "acinus: warning: {}\n", error.what());
    }
    schedule_poll();
  });
}

void Dispatcher::poll(RunJob& job, Active& active) {
  try {
    read_progress_of(job);
    if (++active.polls % kPollsPerSize == 0) measure(job);
  } catch (const std::exception& error) {
    fmt::print(stderr, "acinus: warning: run {}: {}\n", job.id, error.what());
  }
  keep_limits(job, active);
}

void Dispatcher::read_progress_of(RunJob& job) {
  const runs::RunProgress progress =
      runs::parse_progress(runs::take_progress_line(progress_file(store_.run_folder(job.id))));
  if (!progress.printed) return;
  const bool news = progress.time_s != job.time_s || progress.phase != job.phase;
  job.time_s = progress.time_s;
  job.end_s = progress.end_s;
  job.left_s = progress.left_s.value_or(-1);
  job.phase = progress.phase;
  job.dcm = progress.dcm;
  job.cbm = progress.cbm;
  if (news) ++job.revision, ++revision_;
}

void Dispatcher::keep_limits(RunJob& job, Active& active) {
  if (job.bytes > options_.max_run_bytes && active.too_much.empty()) {
    active.too_much =
        fmt::format("{:.3g} GB on disk, more than this service allows for one run (--max-run-disk)",
                    1e-9 * job.bytes);
    active.child.send(SIGTERM);
  }
  // A run checks its limits itself; this is for one that does not get there.
  if (wall_seconds() > active.started + active.limit_s + kEndGracePeriod) {
    active.too_much = "the wall-time limit of this service (--max-walltime)";
    active.child.send(SIGKILL);
  }
}

void Dispatcher::stop(RunJob& job) {
  if (job.state == JobState::kWaiting) return move(job, JobState::kStopped);
  check(
      job.state == JobState::kRunning,
      fmt::format("the run is {}; only one that waits or runs can be stopped", name_of(job.state)));
  Active& active = *active_.at(job.id);
  active.to_stop = true;
  active.child.send(SIGTERM);
}

void Dispatcher::resume(RunJob& job) {
  const std::string folder = store_.run_folder(job.id);
  const bool again = job.state == JobState::kFailed && io::has_checkpoint(folder);
  check(job.state == JobState::kStopped || again,
        fmt::format("the run is {}; only one that was stopped, or failed with a checkpoint, can be "
                    "resumed",
                    name_of(job.state)));
  check_room();
  // Else its end would be taken for that of the new attempt.
  std::error_code ignored;
  if (again) fs::remove(folder + "/summary.json", ignored);
  job.failed = false;
  job.cause.clear();
  job.kills = 0;
  move(job, JobState::kWaiting);
  asio::post(io_, [this] { start_what_can(); });
}

void Dispatcher::remove(RunJob& job) {
  check(job.state != JobState::kRunning, "the run goes on; stop it first");
  disk_bytes_ -= job.bytes;
  store_.remove(job);
  ++revision_;
  jobs_.erase(std::string(job.id));
}

void Dispatcher::end(std::function<void()> done) {
  ending_ = true;
  all_ended_ = std::move(done);
  if (active_.empty()) return all_ended_();
  for (const auto& [id, active] : active_) active->child.send(SIGTERM);
  timers_->poll.expires_after(std::chrono::seconds(static_cast<int>(kEndGracePeriod)));
  timers_->poll.async_wait([this](const boost::system::error_code& failed) {
    if (failed) return;
    for (const auto& [id, active] : active_) active->child.send(SIGKILL);
  });
}

}  // namespace acinus::service
