#pragma once
/// Differences of two scenes, key by key.

#include <functional>
#include <string>
#include <vector>

namespace acinus::runs {

/// Lines "path: then -> now", one for every leaf of two canonical scenes that differs, but for the
/// paths that may. A list that became longer is one line. A key that the earlier scene lacks, since
/// the program had it not yet, is no difference where it has its default.
std::vector<std::string> list_scene_differences(
    const std::string& then, const std::string& now,
    const std::function<bool(const std::string& path)>& may_differ);

}  // namespace acinus::runs
