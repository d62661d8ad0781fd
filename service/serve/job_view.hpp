#pragma once
/// Jobs as JSON and event streams for clients.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/serve/dispatcher.hpp"
#include "service/serve/http_message.hpp"

namespace acinus::service {

/// Job as JSON for GET /runs/ID.
nlohmann::ordered_json view_job(const RunJob& job);

/// Counts of jobs, and the newest runs without evaluations, newest first.
class JobList {
 public:
  explicit JobList(const Dispatcher& dispatcher) : dispatcher_(dispatcher) {}
  /// JSON text on one line; cached until a job changes.
  const std::string& text();

 private:
  const Dispatcher& dispatcher_;
  std::uint64_t revision_ = 0;
  std::string text_;
};

/// Event streams of one job and of all jobs: present state first, then every change, with comments
/// that keep the connection open. That of a job ends when it is deleted.
EventSource watch_job(Dispatcher& dispatcher, const std::string& id);
EventSource watch_list(const Dispatcher& dispatcher, JobList& list);

/// Observables of a run over time, {"NAME": {"unit", "time_s", "value"}}; empty before the first
/// frame.
/// @throws Error(kFileError)
std::string view_series(const std::string& run_folder);

}  // namespace acinus::service
