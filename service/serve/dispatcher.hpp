#pragma once
/// Dispatcher of the queue: starts waiting runs as child processes, supervises, stops and resumes
/// them.

#include <boost/asio/io_context.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "service/serve/job.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/serve_options.hpp"

namespace acinus::service {

/// Supervisor of all jobs of the service.
class Dispatcher {
 public:
  /// Takes over the jobs of the store.
  Dispatcher(boost::asio::io_context& io, const ServeOptions& options, JobStore& store);
  ~Dispatcher();

  /// Starts waiting runs, now and whenever there is capacity.
  void begin();
  /// Stops all runs with a checkpoint; they stay queued for the next service. Calls `done` when all
  /// have ended; after a minute the rest is killed.
  void end(std::function<void()> done);

  /// Checks that the queue and the disk have room and the service is not ending.
  /// @throws Error(kBadInput)
  void check_room() const;
  /// Accepts a job whose folder is complete.
  /// @throws Error(kBadInput) as check_room(), after removing the folder: room may have run out
  /// during preparation
  RunJob& submit(RunJob job);
  /// Stops, resumes or removes a job.
  /// @throws Error(kBadInput) if the state of the job does not allow it
  void stop(RunJob& job);
  void resume(RunJob& job);
  void remove(RunJob& job);

  /// Job by id, null if there is none.
  RunJob* find(const std::string& id);
  /// Updates the recorded size of a job's folder.
  void measure(const std::string& id);
  /// Adds bytes written outside the run folders.
  void add_disk(double bytes) { disk_bytes_ += bytes; }
  /// All jobs by id, oldest first.
  const std::map<std::string, std::unique_ptr<RunJob>>& jobs() const { return jobs_; }
  /// Counter of changes of any job.
  std::uint64_t revision() const { return revision_; }
  double disk_bytes() const { return disk_bytes_; }
  /// Damage found in the store at the start.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Callback for a completed evaluation, before its folder is removed.
  std::function<void(const RunJob&, const std::string& folder)> on_evaluated;

 private:
  struct Active;
  void start_what_can();
  void start(RunJob& job);
  void wait_for_end(RunJob& job, Active& active);
  void finish(RunJob& job);
  /// Finishes an attempt.
  /// @param since  older summaries belong to earlier attempts
  void finish_as(RunJob& job, int code, std::filesystem::file_time_type since);
  void wait_again_after_kill(RunJob& job);
  void schedule_poll();
  void poll(RunJob& job, Active& active);
  void read_progress_of(RunJob& job);
  void keep_limits(RunJob& job, Active& active);
  void measure(RunJob& job);
  void fail(RunJob& job, const std::string& cause);
  void move(RunJob& job, JobState to);

  boost::asio::io_context& io_;
  const ServeOptions& options_;
  JobStore& store_;
  std::map<std::string, std::unique_ptr<RunJob>> jobs_;
  std::map<std::string, std::unique_ptr<Active>> active_;
  std::vector<std::string> warnings_;
  std::uint64_t revision_ = 0;
  double disk_bytes_ = 0;
  double cache_bytes_ = 0;  ///< bytes of calibrated laws, part of disk_bytes_
  bool ending_ = false;
  std::function<void()> all_ended_;
  struct Timers;
  std::unique_ptr<Timers> timers_;
};

}  // namespace acinus::service
