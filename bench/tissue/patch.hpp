#pragma once
/// How well the two models meet: a compressed ball, part of it deformable cells and the rest
/// spheres, against the same ball of deformable cells only.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// The shipped patch_capsule with the zoom region moved and with plain spheres. Pressures are
/// looked at whenever the deformable ball bears between 5 Pa and 250 Pa; figures are means over
/// those moments. Runs stand in the folder "patch" of options.folder and are not made again.
BenchTable bench_patch(const BenchOptions& options);

}  // namespace acinus::bench
