#pragma once
/// The two laws of contact between deformable cells side by side: cohesive potential of the gap,
/// and the paper's Maugis-Dugdale stress between triangles.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Mean over `seeds` orientations of the meshes. Rows in this order:
/// - single triangles of several reduced radii under Maugis-Dugdale: work per area to draw them
///   straight apart, over W;
/// - a pair (scene adhering_pair) with 162 and 642 nodes that keeps its shape: largest attraction
///   over 2 pi W R^, push at two distances of the centres;
/// - the same pair at rest: area of contact (within the range of adhesion, and in touch), pressure
///   of the cytosol, distance of the centres; area and distance under a force of pi W R^; of
///   Maugis-Dugdale from a first touch and from the contact that the cohesive law makes;
/// - 13 cells (scene clump13, spacing 0.99) after 2 h: contacts, area and force of each, pressures.
BenchTable bench_contact_laws(const BenchOptions& options);

/// Pull-off force of the pair with 162 nodes under both laws for W from 1e-5 to 5e-5 J/m^2, a row
/// for each orientation. Forces are held 400 s at most, in steps of 2 s.
BenchTable bench_contact_laws_pull_off(const BenchOptions& options);

}  // namespace acinus::bench
