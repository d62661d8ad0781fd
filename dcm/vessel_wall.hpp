#pragma once
/// A vessel wall yields under a deformable cell.
///
/// Pressure = -k gap with 1/k = 1/k_rep + 1/k_w, where the wall is a Winkler bed matched to a Hertz
/// contact, as a sphere's surface under a deformable cell is:
///     k_w = 4 E* / (3 pi r sqrt(d)),   E* = E_sin / (1 - nu_sin^2)
/// with r the vessel's radius and d the indentation of the pair over r at the start of the step.
/// [VanLiedekerke2020, Table 1: E_sin]

#include "core/contact/boundary.hpp"

namespace acinus::dcm {

/// Smallest indentation, in radii, that enters the stiffness: a Hertz contact begins with none.
inline constexpr double kLeastIndentation = 0.01;

/// Largest that does, and the deepest a wall yields: what is linear in small indentations says
/// nothing beyond. A bed that went on softening would give way without end under a uniform pressure
/// p, whose balance lies at (3 pi p / 4 E*)^2 r; one that went on yielding lets a cell close over
/// a thin vessel.
inline constexpr double kMostIndentation = 0.15;

/// The series stiffness k, nN/um^3. The pressure rises with the indentation by k / 2 to k, so the
/// matrix of a step, in which k stands still, is once to twice as stiff as the contact. A rigid
/// wall (modulus infinite) leaves k_rep as it is, to the bit.
/// @param radius       um, of the vessel at the contact
/// @param indentation  um, deepest point of the cell in the vessel
double wall_stiffness(double repulsion, const contact::Material& wall, double radius,
                      double indentation);

/// Depth, um, to which a wall yields; beyond it the surfaces push with k_rep. 0 if it is rigid.
double yield_limit(const contact::Material& wall, double radius);

}  // namespace acinus::dcm
