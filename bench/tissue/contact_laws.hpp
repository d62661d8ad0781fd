#pragma once
/// The two laws of contact between deformable cells side by side: cohesive potential of the gap,
/// and the paper's Maugis-Dugdale stress between triangles.

#include "bench/output/table.hpp"

namespace acinus::bench {

/// Rows of a pair (scene adhering_pair) with 162 and 642 nodes, mean over `seeds` orientations of
/// the meshes: area of contact, pressure of the cytosol and distance of the centres at rest,
/// distance under a force of pi W R^ and how many bear it, largest attraction of rigid cells over
/// 2 pi W R^; of Maugis-Dugdale from a first touch, and from the contact that the cohesive law
/// makes. Before them rows of single triangles of several reduced radii: work per area to draw them
/// straight apart, over W. After them rows of 13 cells (scene clump13, spacing 0.99): contacts,
/// area and force of each, pressures.
BenchTable bench_contact_laws(const BenchOptions& options);

/// Pull-off force of the pair with 162 nodes under both laws, a row for each orientation.
BenchTable bench_contact_laws_pull_off(const BenchOptions& options);

}  // namespace acinus::bench
