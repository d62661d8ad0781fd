#pragma once
/// Friction with the medium at rest: matrix or liquid.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Medium friction per surface area of a cell, nN s/um^3: gamma_ECM, or the Stokes drag 6 pi eta R
/// of the whole cell spread evenly over its rest surface.
double medium_friction_per_area(const Params& p, double radius, double rest_area);

/// Adds gamma A_i v_i on every node, with A_i the part of the node's area in contact with
/// the medium. [VanLiedekerke2020, Eq. (1), term 3, and the text below Eq. (2)] Empty lanes get 1
/// so that the matrix stays regular.
/// @param medium_area  [n_node][lane] um^2
void add_medium(const Params& p, const GroupView& g, const double* medium_area,
                solve::System& system);

}  // namespace acinus::dcm
