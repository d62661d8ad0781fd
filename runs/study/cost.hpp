#pragma once
/// What a run will cost, before it runs.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// CPU time of a run in s, roughly: cells x steps x the time of a cell-step on the machine of
/// docs/benchmarks.md. Within a factor of about three; good for balancing, not for booking.
/// @param shared_start  the run takes its cells at t = 0 from another one
double estimate_cost(const Scene& scene, bool shared_start);

}  // namespace acinus::runs
