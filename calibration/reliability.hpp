#pragma once
/// Reliability of a law for cells outside its own clump.

#include <string>
#include <vector>

namespace acinus::calibration {

/// Fewest inner cells whose mean represents tissue. At one pressure d differs by a tenth from cell
/// to cell, and where the law is steepest a tenth of d is a factor of two in the modulus
/// (docs/science/calibration.md): the mean of n cells gives the modulus to a factor 2^(1 / sqrt n),
/// with twelve to a fifth.
inline constexpr int kFewestInner = 12;

/// Largest acceptable error of spheres with the law where it was not fitted, compressed by
/// themselves: that same fifth. Clumps of 59 cells have 3 to 8 %, one of 113 has 17 %; those that
/// buckle or have one inner cell 44 to 83 %.
inline constexpr double kLargestError = 0.2;

/// Objections to the use of a law, each with advice; empty: none.
/// @param n_inner  number of inner cells
/// @param error    relative, of corrected spheres compressed by themselves; NaN: not known
std::vector<std::string> list_warnings(int n_inner, double error);

}  // namespace acinus::calibration
