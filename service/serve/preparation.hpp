#pragma once
/// Submissions on their way into the queue: each is prepared by a process of its own with limits,
/// so that nothing a client sends can take the service along or make others wait.

#include <memory>
#include <string>

#include "service/serve/async.hpp"
#include "service/serve/job.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/serve_options.hpp"

namespace acinus::runs {

class Preparation {
 public:
  Preparation(const ServeOptions& options, JobStore& store) : options_(options), store_(store) {}

  /// Makes the run folder of a submission.
  /// @return the job, not yet accepted
  /// @throws Error(kBadInput): what is wrong with it, or that it took too long or too much memory
  Task<RunJob> prepare(const std::string& body);
  /// The same of an evaluation.   @param text  as evaluation_text() makes it
  Task<RunJob> prepare_evaluation(const std::string& text);

 private:
  Task<RunJob> prepare_file(const char* name, const std::string& text);

  const ServeOptions& options_;
  JobStore& store_;
  /// Submissions that are being prepared. Owned by those, too: when the service ends, their
  /// coroutines go with the loop, after this object.
  std::shared_ptr<int> n_running_ = std::make_shared<int>(0);
};

}  // namespace acinus::runs
