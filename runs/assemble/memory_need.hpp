#pragma once
/// Whether a scene fits into memory, told before anything is placed.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// Memory that cells and vessels of a scene take at least, at its start, bytes: cells by number,
/// model and mesh, branches of a generated lobule. What zoom decides counts as spheres.
double estimate_memory(const Scene& scene);

/// @param limit  bytes
/// @throws Error(kBadInput) if the scene takes more, naming what takes most
void check_memory(const Scene& scene, double limit);

}  // namespace acinus::runs
