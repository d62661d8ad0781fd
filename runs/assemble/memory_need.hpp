#pragma once
/// Memory estimate of a scene, before anything is placed.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Lower bound of the memory of cells and vessels at the start, bytes: cells by number, model and
/// mesh, branches of a generated lobule. Zoomed cells count as spheres.
double estimate_memory(const Scene& scene);

/// Refuses a scene that needs more memory than allowed.
/// @param limit  bytes
/// @throws Error(kBadInput) naming the largest contribution
void check_memory(const Scene& scene, double limit);

}  // namespace acinus::runs
