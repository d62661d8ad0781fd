#pragma once
/// Elastic vessel wall under a deformable cell.
///
/// Pressure = -k gap with 1/k = 1/k_rep + 1/k_w, where the wall is a Winkler bed matched to a Hertz
/// contact, as a sphere's surface under a deformable cell is:
///     k_w = 4 E* / (3 pi r sqrt(d)),   E* = E_sin / (1 - nu_sin^2)
/// with r the vessel's radius and d the indentation of the pair over r at the start of the step.
/// [VanLiedekerke2020, Table 1: E_sin]

#include "contact/vessel_yield.hpp"

namespace acinus::dcm {

/// Smallest indentation, in radii, that enters the stiffness: a Hertz contact begins with none. The
/// largest is contact::kMostIndentation: a bed that softened without limit would yield without end
/// under a uniform pressure p, whose balance lies at (3 pi p / 4 E*)^2 r.
inline constexpr double kLeastIndentation = 0.01;

/// Series stiffness k, nN/um^3. The pressure rises with the indentation by k / 2 to k, so the
/// matrix of a step, in which k is constant, is once to twice as stiff as the contact. A rigid wall
/// (modulus infinite) gives k_rep, to the bit.
/// @param radius       um, of the vessel at the contact
/// @param indentation  um, deepest point of the cell in the vessel
double wall_stiffness(double repulsion, const contact::Material& wall, double radius,
                      double indentation);

}  // namespace acinus::dcm
