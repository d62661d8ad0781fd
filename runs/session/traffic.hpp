#pragma once
/// Communication between the processes of a run, as text.

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"

namespace acinus::runs {

/// One line per process with its messages per step; empty for a single process. Collective: to be
/// called by all processes.
/// @param steps  steps accepted by this process since its start
/// @param wall_s  wall time since then, s
std::vector<std::string> describe_traffic(const Ranks& ranks, std::int64_t steps, double wall_s);

}  // namespace acinus::runs
