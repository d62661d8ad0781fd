#pragma once
/// What the processes of a run sent each other, for people to read.

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel/ranks.hpp"

namespace acinus::runs {

/// A line for each process, with what it sent per step; empty where there is one. To be called by
/// all of them.
/// @param steps   accepted by this process since its start
/// @param wall_s  s, since then
std::vector<std::string> describe_traffic(const Ranks& ranks, std::int64_t steps, double wall_s);

}  // namespace acinus::runs
