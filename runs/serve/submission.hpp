#pragma once
/// From what a client sends to a run folder ready to start.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "runs/serve/job.hpp"
#include "runs/serve/job_store.hpp"
#include "runs/serve/serve_options.hpp"

namespace acinus::runs {

/// Reads a submission, {"scene": NAME or {...}, "set": {PATH: VALUE}, "name": ..., "files":
/// {NAME: base64}}, checks scene and limits, and writes its run folder.
/// @return the job, not yet accepted
/// @throws Error(kBadInput): what is wrong with it, every fault of the scene; paths that are
///         absolute or climb among it
RunJob prepare_submission(const std::string& body, const ServeOptions& options, JobStore& store);

/// The same for a scene that is already read, as an evaluation.
RunJob prepare_evaluation(const Scene& scene, const std::string& key, const ServeOptions& options,
                          JobStore& store);

/// Identifies the result of a scene: its hash, and the program's version.
std::string result_key(const Scene& scene);

}  // namespace acinus::runs
