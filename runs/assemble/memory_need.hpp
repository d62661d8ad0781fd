#pragma once
/// Memory estimate of a scene, before anything is placed.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Most memory of one of several processes on this machine by default, bytes.
double share_of_memory(int n_process);

/// Lower bound of the memory of cells and vessels at the start, bytes: cells by number, model and
/// mesh, branches of a generated lobule. Zoomed cells count as spheres.
/// @param n_process  processes that share the run; the estimate is that of one of them
double estimate_memory(const Scene& scene, int n_process = 1);

/// Refuses a scene that needs more memory than allowed.
/// @param limit  bytes, of one process
/// @throws Error(kBadInput) naming the largest contribution
void check_memory(const Scene& scene, double limit, int n_process = 1);

}  // namespace acinus::runs
