#pragma once
/// Pull-off force of two deformable cells over the adhesion energy, compared with theory.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Rows for W from 1e-5 to 1e-4 J/m^2 and 162 and 642 nodes: mean and scatter of F / (pi W R^) over
/// `seeds` random mesh orientations, F / (2 pi W R^) of rigid cells, contact radius and distance of
/// the centres without force and before separation; without force the mean surface tension outside
/// the contact and its minimum inside [VanLiedekerke2020, Eq. (8)]. A row per mesh gives the line
/// of force over W and its R^2. Theory: vesicle 1, JKR 1.5, DMT 2 [VanLiedekerke2020, Fig. 6 c].
BenchTable bench_pull_off(const BenchOptions& options);

/// Variation of one parameter at a time at W = 2e-5 J/m^2: mesh, range, quadrature, friction, hold
/// time, bending and stretching stiffness.
BenchTable bench_pull_off_causes(const BenchOptions& options);

}  // namespace acinus::bench
