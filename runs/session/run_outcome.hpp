#pragma once
/// Outcome of a run, as its summary and its run file name it.

#include "runs/scene/choices.hpp"

namespace acinus::runs {

/// kStopped: by a signal or a limit, with a checkpoint. kFailed: the simulation cannot continue.
enum class RunOutcome { kCompleted, kStopped, kFailed };
template <>
inline constexpr const char* kChoices<RunOutcome> = "completed|stopped|failed";

}  // namespace acinus::runs
