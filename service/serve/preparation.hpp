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

  /// Scene of a submission with every default, as JSON; nothing is kept.
  /// @throws Error(kBadInput) as prepare()
  Task<std::string> check_submission(const std::string& body);
  /// Start of a submission as JSON (write_preview()); nothing is kept.
  /// @throws Error(kBadInput) as prepare(), or if the cells cannot be placed
  Task<std::string> preview(const std::string& body);

 private:
  struct Work;
  Task<RunJob> prepare_file(const char* name, const std::string& text);
  Task<std::string> read_result(const char* flag, const char* file, double limit_s,
                                const std::string& body);
  Task<void> wait_for_turn();
  Task<void> call_child(const Work& work);

  const ServeOptions& options_;
  JobStore& store_;
  /// Number of preparations in progress. Shared with their coroutines, which outlive this object:
  /// they are destroyed with the event loop.
  std::shared_ptr<int> n_running_ = std::make_shared<int>(0);
};

}  // namespace acinus::service
