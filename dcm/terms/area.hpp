#pragma once
/// Membrane: resistance to changes of the area of the whole surface.

#include "dcm/group_view.hpp"
#include "dcm/params.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Adds E = K_A (A - A0)^2 / (2 A0), force = -K_A (A - A0)/A0 dA/dx, with the area A of the whole
/// cell. [VanLiedekerke2020, Eq. (12), in its energy form] Stiffness: (K_A / A0) g g^T, rank one,
/// and under tension sigma = K_A (A - A0)/A0 > 0 the geometric stiffness sigma/sqrt(3) (I - u u^T)
/// per edge, with the cotangent weight of near-equilateral triangles. Without that part stretched
/// cells chatter (decision 7).
void add_area(const Params& p, const GroupView& g, solve::System& system, solve::RankOne& family);

/// Surface areas of all lanes, um^2.
Lane compute_areas(const GroupView& g);

/// Energy of one lane, fJ.
double area_energy(const Params& p, const GroupView& g, int lane);

}  // namespace acinus::dcm
