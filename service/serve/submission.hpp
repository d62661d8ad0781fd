#pragma once
/// Conversion of a client's submission to a run folder ready to start.

#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "service/serve/job.hpp"
#include "service/serve/job_store.hpp"
#include "service/serve/serve_options.hpp"

namespace acinus::service {

/// Files of a run folder that hold the client's data until preparation: a submission, or an
/// evaluation of a model.
inline constexpr const char* kRequestFile = "request.json";
inline constexpr const char* kEvaluationFile = "evaluation.json";

/// Reads the submission in a run folder, {"scene": NAME or {...}, "set": {PATH: VALUE}, "name":
/// ..., "files": {NAME: base64}}, checks scene and limits, and completes the folder with its
/// record. Called in a child process, since submissions are untrusted.
/// @throws Error(kBadInput) listing all faults of the scene, among them paths that are absolute or
/// lead out of the folder
void prepare_submission(const std::string& folder, const ServeOptions& options);

/// Name of the file that write_preview() writes.
inline constexpr const char* kPreviewFile = "preview.json";

/// Prepares the submission in a folder like prepare_submission(), places its cells without a
/// start-up and writes kPreviewFile: scene (resolved), cells, end_s, vessel_length_um, notes,
/// warnings, and frames and walls as on report pages. Called in a child process.
/// @throws Error(kBadInput) listing all faults, or if the picture is larger than kMostPreviewBytes
void write_preview(const std::string& folder, const ServeOptions& options);
inline constexpr double kMostPreviewBytes = 16e6;

/// Refuses a change of a scene, PATH=VALUE, that names a file.
/// @throws Error(kBadInput)
void check_names_no_file(const std::string& assignment);

/// Text of an evaluation file.
/// @param name      of the model
/// @param resolved  JSON of the model's scene with all defaults
/// @param set       changes of the scene, PATH=VALUE
std::string evaluation_text(const std::string& name, const std::string& resolved,
                            const std::vector<std::string>& set);

/// Reads an evaluation file and completes the run folder like prepare_submission().
/// @throws Error(kBadInput) listing all faults of the scene
void prepare_evaluation(const std::string& folder, const ServeOptions& options);

/// Cache key of the result of a scene: its hash and the version of the program.
std::string result_key(const runs::Scene& scene);

}  // namespace acinus::service
