#include "solve/coarse_kernels.hpp"

#include "core/numbers/lanes.hpp"

namespace acinus::solve {
namespace {

/// Restriction: sums of r and of arm x r over the points of a block, [6][lane].
template <class T>
ACINUS_INLINE void restrict_points(int n, const float* arm, const T* r, double* out) {
  Lane3Of<T> force = {}, torque = {};
  for (int i = 0; i < n; ++i) {
    const Lane3Of<T> ri = load3<T>(r + i * kPointStride);
    force = force + ri;
    torque = torque + cross(load3<T>(arm + i * kPointStride), ri);
  }
  store3(out, force);
  store3(out + 3 * kLanes, torque);
}
/// Prolongation: z += motion + turn x arm.
template <class T>
ACINUS_INLINE void prolong_points(int n, const float* arm, const double* in, T* z) {
  const Lane3Of<T> motion = load3<T>(in), turn = load3<T>(in + 3 * kLanes);
  for (int i = 0; i < n; ++i)
    add3(z + i * kPointStride, motion + cross(turn, load3<T>(arm + i * kPointStride)));
}

}  // namespace

ACINUS_KERNEL void restrict_block(int n, const float* arm, const float* r, double* out) {
  restrict_points<float>(n, arm, r, out);
}
ACINUS_KERNEL void restrict_block(int n, const float* arm, const double* r, double* out) {
  restrict_points<double>(n, arm, r, out);
}
ACINUS_KERNEL void prolong_block(int n, const float* arm, const double* in, float* z) {
  prolong_points<float>(n, arm, in, z);
}
ACINUS_KERNEL void prolong_block(int n, const float* arm, const double* in, double* z) {
  prolong_points<double>(n, arm, in, z);
}

}  // namespace acinus::solve
