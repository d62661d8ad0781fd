#pragma once
/// The folder of one run: whether it may be used, and whether its checkpoint fits the scene.

#include <string>

#include "io/checkpoint.hpp"
#include "io/file_lock.hpp"
#include "runs/scene/scene.hpp"
#include "runs/session/run_options.hpp"

namespace acinus::runs {

/// Looks at a folder without changing anything.
/// @throws Error(kBadInput) when it is a file, another process writes in it, it holds results and
///         neither resume nor overwrite was asked, or has no checkpoint to resume from
void check_folder(const std::string& folder, const RunOptions& options);

/// Makes the folder, or checks that an existing one may be used, and empties it if asked.
/// @return to be kept while the run writes: no other process can prepare the folder meanwhile
/// @throws Error(kBadInput) when it holds results and neither resume nor overwrite was asked, or
///         another process, which is named, writes in it; Error(kFileError) when it cannot be made
///         or written
io::FileLock prepare_folder(const std::string& folder, const RunOptions& options);

/// Whether a process writes in the folder of a run.
bool is_being_written(const std::string& folder);

/// Refuses a checkpoint made from another scene: only the end time, the output and the name may
/// differ.
/// @throws Error(kBadInput) listing the differing keys
void check_same_scene(const io::CheckpointData& checkpoint, const Scene& scene);

}  // namespace acinus::runs
