#pragma once
/// The folder of one run: whether it may be used, and whether its checkpoint fits the scene.

#include <string>

#include "core/io/checkpoint.hpp"
#include "runs/run.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Makes the folder, or checks that an existing one may be used.
/// @throws Error(kBadInput) when it holds results and neither resume nor overwrite was asked;
///         Error(kFileError) when it cannot be made or written
void prepare_folder(const std::string& folder, const RunOptions& options);

/// Refuses a checkpoint made from another scene: only the end time, the output and the name may
/// differ.
/// @throws Error(kBadInput) listing the differing keys
void check_same_scene(const io::CheckpointData& checkpoint, const Scene& scene);

}  // namespace acinus::runs
