#pragma once
/// From what a client sends to a run folder ready to start.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "service/serve/job.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/serve_options.hpp"

namespace acinus::runs {

/// Files in a run folder that hold what a client sent, until it is prepared: a submission, or an
/// evaluation of a model.
inline constexpr const char* kRequestFile = "request.json";
inline constexpr const char* kEvaluationFile = "evaluation.json";

/// Reads a submission, {"scene": NAME or {...}, "set": {PATH: VALUE}, "name": ..., "files":
/// {NAME: base64}}, from the request file of a run folder, checks scene and limits, and completes
/// the folder with its record. A process of its own does it: what strangers send may be anything.
/// @throws Error(kBadInput): what is wrong with it, every fault of the scene; paths that are
///         absolute or climb among it
void prepare_submission(const std::string& folder, const ServeOptions& options);

/// Refuses a change of a scene, PATH=VALUE, that names a file.   @throws Error(kBadInput)
void check_names_no_file(const std::string& assignment);

/// Text of an evaluation file.
/// @param resolved  JSON of the model's scene with every default
/// @param set       changes, PATH=VALUE
std::string evaluation_text(const std::string& name, const std::string& resolved,
                            const std::vector<std::string>& set);

/// Reads an evaluation file of a run folder and completes the folder as prepare_submission() does.
/// @throws Error(kBadInput): every fault of the scene
void prepare_evaluation(const std::string& folder, const ServeOptions& options);

/// Identifies the result of a scene: its hash, and the program's version.
std::string result_key(const Scene& scene);

}  // namespace acinus::runs
