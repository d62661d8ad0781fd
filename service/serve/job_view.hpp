#pragma once
/// Jobs as clients see them.

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "service/serve/dispatcher.hpp"
#include "service/serve/http_message.hpp"

namespace acinus::runs {

nlohmann::ordered_json view_job(const RunJob& job);

/// Counts, and the newest runs without evaluations, newest first.
class JobList {
 public:
  explicit JobList(const Dispatcher& dispatcher) : dispatcher_(dispatcher) {}
  /// One line of JSON; made anew when something has changed.
  const std::string& text();

 private:
  const Dispatcher& dispatcher_;
  std::uint64_t revision_ = 0;
  std::string text_;
};

/// Both tell the present state at once, then every change; a comment now and then keeps the
/// connection. The first ends when the job is deleted.
EventSource watch_job(Dispatcher& dispatcher, const std::string& id);
EventSource watch_list(const Dispatcher& dispatcher, JobList& list);

/// Observables of a run over time, {"NAME": {"unit", "time_s", "value"}}; none
/// before the first frame.   @throws Error(kFileError)
std::string view_series(const std::string& run_folder);

}  // namespace acinus::runs
