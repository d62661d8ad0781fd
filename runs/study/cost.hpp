#pragma once
/// A-priori cost estimate of a run.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Estimated CPU time of a run, s: cells x steps x CPU time per cell and step on the machine of
/// docs/developers/benchmarks.md. Correct within a factor of about three: enough for load balance.
/// @param shared_start  the run takes its state at t = 0 from another run
double estimate_cost(const Scene& scene, bool shared_start);

}  // namespace acinus::runs
