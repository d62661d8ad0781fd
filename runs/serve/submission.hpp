#pragma once
/// From what a client sends to a run folder ready to start.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "runs/serve/job.hpp"
#include "runs/serve/job_store.hpp"
#include "runs/serve/serve_options.hpp"

namespace acinus::runs {

/// File in a run folder that holds what a client sent, until it is prepared.
inline constexpr const char* kRequestFile = "request.json";

/// Reads a submission, {"scene": NAME or {...}, "set": {PATH: VALUE}, "name": ..., "files":
/// {NAME: base64}}, from the request file of a run folder, checks scene and limits, and completes
/// the folder with its record. A process of its own does it: what strangers send may be anything.
/// @throws Error(kBadInput): what is wrong with it, every fault of the scene; paths that are
///         absolute or climb among it
void prepare_submission(const std::string& folder, const ServeOptions& options);

/// Refuses a change of a scene, PATH=VALUE, that names a file.   @throws Error(kBadInput)
void check_names_no_file(const std::string& assignment);

/// The same for a scene that is already read, as an evaluation.
RunJob prepare_evaluation(const Scene& scene, const std::string& key, const ServeOptions& options,
                          JobStore& store);

/// Identifies the result of a scene: its hash, and the program's version.
std::string result_key(const Scene& scene);

}  // namespace acinus::runs
