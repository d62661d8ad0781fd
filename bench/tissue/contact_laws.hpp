#pragma once
/// Comparison of the contact laws of deformable cells: cohesive potential of the gap, and the
/// Maugis-Dugdale stress between triangles of the paper.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Rows, as means over `seeds` mesh orientations:
/// - single triangles of several curvature radii under Maugis-Dugdale: work per area of separation
///   over W;
/// - pair (scene adhering_pair) of rigid cells with 162 and 642 nodes: largest attraction over 2 pi
///   W R^, repulsion at two distances of the centres;
/// - the same pair at rest: contact area (within the range of adhesion, and touching), cytosol
///   pressure, distance of the centres; area and distance under a force of pi W R^; with
///   Maugis-Dugdale from a first touch and from the contact of the cohesive law;
/// - 13 cells (scene clump13, spacing 0.99) after 2 h: contacts, area and force of each, pressures.
BenchTable bench_contact_laws(const BenchOptions& options);

/// Pull-off force of the pair with 162 nodes under both laws for W from 1e-5 to 5e-5 J/m^2, a row
/// per orientation. Forces are held for at most 400 s in steps of 2 s.
BenchTable bench_contact_laws_pull_off(const BenchOptions& options);

}  // namespace acinus::bench
