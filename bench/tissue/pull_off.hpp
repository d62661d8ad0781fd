#pragma once
/// Pull-off force of two deformable cells over the adhesion energy, beside theory.

#include "bench/output/bench_table.hpp"

namespace acinus::bench {

/// Rows for W from 1e-5 to 1e-4 J/m^2 and 162 and 642 nodes: mean and scatter of F / (pi W R^) over
/// `seeds` pairs of random mesh orientations, F / (2 pi W R^) of rigid cells, contact radius and
/// distance of the centres without force and before the contact is lost; without force the mean
/// tension of the surface out of contact and the least in it [VanLiedekerke2020, Eq. (8)]. A row
/// per mesh has the straight line of the forces of all pairs over W and its R^2. Theory: vesicle 1,
/// JKR 1.5, DMT 2. [VanLiedekerke2020, Fig. 6 c]
BenchTable bench_pull_off(const BenchOptions& options);

/// One thing at a time is changed at W = 2e-5 J/m^2: mesh, range, quadrature, friction, time of
/// holding, bending and stretching stiffness.
BenchTable bench_pull_off_causes(const BenchOptions& options);

}  // namespace acinus::bench
