#pragma once
/// Measured series of a run by name.

#include <map>
#include <string>
#include <vector>

namespace acinus::runs {

/// Named series, one number per written frame; a profile holds the numbers of the last frame only.
/// Kept in checkpoints. What has no value at a frame is NaN, in files null.
using Measures = std::map<std::string, std::vector<double>>;

}  // namespace acinus::runs
