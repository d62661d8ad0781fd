#pragma once
/// Files that tests read, wherever the sources lie. Paths in the command lines of all would make
/// compiler caches miss in every checkout; only paths.cpp knows them.

#include <string>

namespace acinus::test {

/// File below the root of the sources.
std::string source_path(const std::string& file);
/// File below tests/data/.
std::string data_path(const std::string& file);
/// Program acinus.
std::string program_path();

/// Presence of the folder of networks and meshes made by others, which is no part of the sources.
bool has_real_data();
/// File in that folder.
std::string real_path(const std::string& file);

}  // namespace acinus::test
