#pragma once
/// Compression of a cell between two plates.

#include "dcm/params.hpp"

namespace acinus::runs {

/// Force that compresses a thin shell which keeps its volume, nN: of the area that grows, as far as
/// the tension is the same everywhere, and of the shell that is flattened,
///   F = 2 pi (K + K_A) R e^3 + 8 sqrt(Y kappa) e,   e = 1 - gap / 2R
/// with K = (sqrt 3 / 2) k_s, Y = (2/sqrt 3) k_s, kappa = (sqrt 3 / 2) k_b of the net
/// (docs/science/models.md says where it holds).
double shell_force(const dcm::Params& cell, double radius, double gap);

}  // namespace acinus::runs
