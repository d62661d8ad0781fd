#pragma once
/// Preparation of submissions in child processes with resource limits, so that no client can crash
/// or block the service.

#include <memory>
#include <string>

#include "service/serve/async.hpp"
#include "service/serve/job.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/serve_options.hpp"

namespace acinus::service {

/// Preparation of submissions, at most a few at a time.
class Preparation {
 public:
  Preparation(const ServeOptions& options, JobStore& store) : options_(options), store_(store) {}

  /// Creates the run folder of a submission.
  /// @param body  of the request
  /// @return the job, not yet accepted
  /// @throws Error(kBadInput) listing the faults of the submission, or if it took too much time or
  /// memory
  Task<RunJob> prepare(const std::string& body);
  /// Creates the run folder of an evaluation.
  /// @param text  as made by evaluation_text()
  Task<RunJob> prepare_evaluation(const std::string& text);

 private:
  Task<RunJob> prepare_file(const char* name, const std::string& text);

  const ServeOptions& options_;
  JobStore& store_;
  /// Number of preparations in progress. Shared with their coroutines, which outlive this object:
  /// they are destroyed with the event loop.
  std::shared_ptr<int> n_running_ = std::make_shared<int>(0);
};

}  // namespace acinus::service
