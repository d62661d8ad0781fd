#pragma once
/// Transfer between the points of a block of cells and their rigid motions.

namespace acinus::solve {

/// Restriction: sums of r and of arm x r over the points of a block.
/// @param n    number of points
/// @param arm  [n][3][lane]
/// @param out  [6][lane]
void restrict_block(int n, const float* arm, const float* r, double* out);
void restrict_block(int n, const float* arm, const double* r, double* out);

/// Prolongation: z += motion + turn x arm.   @param in  [6][lane]
void prolong_block(int n, const float* arm, const double* in, float* z);
void prolong_block(int n, const float* arm, const double* in, double* z);

}  // namespace acinus::solve
