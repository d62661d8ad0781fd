#pragma once
/// The queue at work: starts waiting runs as child processes, follows them, stops and resumes them.

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

namespace acinus::runs {

class Dispatcher {
 public:
  /// Takes up what the store holds.
  Dispatcher(boost::asio::io_context& io, const ServeOptions& options, JobStore& store);
  ~Dispatcher();

  /// Starts what waits, now and from now on.
  void begin();
  /// Stops all runs with a checkpoint; they wait for the next service. Calls `done` when all have
  /// ended, those that do not within a minute killed.
  void end(std::function<void()> done);

  /// @throws Error(kBadInput) when the queue or the disk is full, or the service ends
  void check_room() const;
  /// Accepts a job whose folder is complete.
  /// @throws Error(kBadInput) as check_room(), having removed the folder: others may have come
  /// while
  ///         it was prepared
  RunJob& submit(RunJob job);
  /// @throws Error(kBadInput) where the state of the job does not allow it
  void stop(RunJob& job);
  void resume(RunJob& job);
  void remove(RunJob& job);

  RunJob* find(const std::string& id);
  /// Updates the size of a job's folder.
  void measure(const std::string& id);
  /// Counts what was written beside the runs.
  void add_disk(double bytes) { disk_bytes_ += bytes; }
  /// All jobs, oldest first.
  const std::map<std::string, std::unique_ptr<RunJob>>& jobs() const { return jobs_; }
  /// Counts every change of any job.
  std::uint64_t revision() const { return revision_; }
  double disk_bytes() const { return disk_bytes_; }
  /// What was found damaged at the start.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Called when an evaluation is completed, before its folder goes.
  std::function<void(const RunJob&, const std::string& folder)> on_evaluated;

 private:
  struct Active;
  void start_what_can();
  void start(RunJob& job);
  void wait_for_end(RunJob& job, Active& active);
  void finish(RunJob& job);
  /// @param since  summaries before are of earlier attempts
  void finish_as(RunJob& job, int code, std::filesystem::file_time_type since);
  void wait_again_after_kill(RunJob& job);
  void look_again();
  void look(RunJob& job, Active& active);
  void read_news(RunJob& job);
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
  double cache_bytes_ = 0;  ///< of them, what runs calibrated
  bool ending_ = false;
  std::function<void()> all_ended_;
  struct Timers;
  std::unique_ptr<Timers> timers_;
};

}  // namespace acinus::runs
