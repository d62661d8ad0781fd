#pragma once
/// Folder of a run: permission to use it, and consistency of its checkpoint with the scene.

#include <string>

#include "io/checkpoint.hpp"
#include "io/file_lock.hpp"
#include "runs/scene/scene.hpp"
#include "runs/session/run_options.hpp"

namespace acinus::runs {

/// Checks that a run may use the folder, without changing it.
/// @throws Error(kBadInput) if it is a file, another process writes in it, it holds results and
/// neither resume nor overwrite was asked for, or it has no checkpoint to resume from
void check_folder(const std::string& folder, const RunOptions& options);

/// Creates the folder, or checks an existing one and empties it if asked.
/// @return lock to be kept while the run writes; it excludes other processes
/// @throws Error(kBadInput) if it holds results and neither resume nor overwrite was asked for, or
/// another process, which is named, writes in it; Error(kFileError) if it cannot be created or
/// written
io::FileLock prepare_folder(const std::string& folder, const RunOptions& options);

/// True if a process writes in the run folder.
bool is_being_written(const std::string& folder);

/// Refuses a checkpoint of another scene; only end time, output and name may differ.
/// @throws Error(kBadInput) listing the differing keys
void check_same_scene(const io::CheckpointData& checkpoint, const Scene& scene);

}  // namespace acinus::runs
