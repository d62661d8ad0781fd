#pragma once
/// Compression of a clump in a capsule.

#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// True for a scene of the experiment "capsule" that has a capsule.
bool is_capsule_compression(const Scene& scene);

}  // namespace acinus::runs
