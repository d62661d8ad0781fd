#pragma once
/// Cortex: bending resistance of the hinge at every edge, and of faces to collapse.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds hinges, E = k_b (1 - cos(theta - theta0) + fold_b^2) + k_t fold_t^2, with theta0 the angle
/// of the rest shape. Forces are the exact gradient, so net force and torque vanish.
/// [VanLiedekerke2020, Eq. (9), first two terms]
///
/// The paper's energy is largest for faces folded flat on each other and drives an edge beyond
/// that. Where strong adhesion closed the sharp rim of two cells, or of two daughters, faces were
/// folded into each other. fold_b = max(0, -1/2 - cos theta) / (1 + cos theta) prevents it while
/// the cortex is as stiff as adhesion is strong. fold_t = max(0, -0.9 - cos theta) / (1 + cos
/// theta) does so for any cortex, like contact between faces that are not neighbours; k_t is the
/// energy at Params::fold_repulsion of two faces pressed 0.1 um into each other. Stiffness: (k_b
/// max(0, cos(theta - theta0)) + 2 k_b fold_b'^2 + 2 k_t fold_t'^2) grad theta grad theta^T
/// (Gauss-Newton).
///
/// Faces get E = k_b max(0, a0 / (10 a) - 1)^2, which the paper lacks too: nothing in its cortex
/// keeps the corner of a face from passing through the opposite edge, and the direction of a hinge
/// is lost there. Stiffness: springs along the three edges that are at least as stiff as 2 k_b
/// compression'^2 grad a grad a^T.
void add_bending(const Params& p, const GroupView& g, solve::System& system);

/// Bending energy of one lane, fJ.
double bending_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
