#pragma once
/// Place of the scenes that come with the program.

#include <string>

namespace acinus::runs {

/// Folder of the shipped scenes: runs/scenes or share/acinus/scenes beside the folder of the
/// program, else that of the source tree.
/// @throws Error (kFileError) if there is none.
std::string scene_folder();

}  // namespace acinus::runs
