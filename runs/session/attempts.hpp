#pragma once
/// Attempts of a run: the first start and its resumptions, with their wall and CPU time per stage.

#include <cstdint>
#include <string>
#include <vector>

#include "core/parallel/timing.hpp"
#include "io/checkpoint.hpp"

namespace acinus::runs {

/// Number of attempts and the sums of their times per stage. A killed attempt counts up to its last
/// checkpoint, like the wall time of the run.
struct Attempts {
  std::int64_t count = 0;
  std::vector<StageTime> stages;
};

/// Adds an attempt with its times.
/// @return the sums with it; stages of `before` come first
Attempts add_attempt(Attempts before, const Timings& timings);

/// Times per stage, a line each: those of the last attempt, then the sums if there were several.
/// @param all  with the last one
std::vector<std::string> describe_stages(const Timings& last, const Attempts& all);

/// Writes the attempts to a checkpoint.
void put_attempts(const Attempts& attempts, io::CheckpointData& data);
/// Reads the attempts of a checkpoint; none from a checkpoint of a version that did not count them.
/// @throws Error(kFileError) if they are damaged
Attempts get_attempts(const io::CheckpointData& data);

}  // namespace acinus::runs
