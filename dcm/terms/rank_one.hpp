#pragma once
/// Common part of the whole-cell terms (volume, area): a force along their gradient, and a rank-one
/// matrix of it.

#include <vector>

#include "core/numbers/lanes.hpp"

namespace acinus::dcm {

/// Zeros for a gradient, [n_node][3][lane], valid until the next call of the thread.
inline double* zero_gradient(int n_node) {
  thread_local std::vector<double> gradient;
  gradient.assign(static_cast<std::size_t>(n_node) * kPointStride, 0.0);
  return gradient.data();
}

/// Adds scale * vector to every node; scale is one number per lane.
inline void add_scaled(int n_node, const double* scale, const double* vector, double* to) {
  const Lane s = load(scale);
  for (int i = 0; i < n_node; ++i)
    add3(to + i * kPointStride, s * load3(vector + i * kPointStride));
}

/// Rounds the gradient of a quantity that no translation changes to floats that add up to zero
/// exactly, as the gradient does, so that its matrix exerts no net force. Every component of a lane
/// is in units of about 2^-24 of its largest. Most are wrong by half a unit at most; few, of which
/// one unit more or less makes the sum zero, by up to one.
/// @param gradient, to  [n_node][3][lane]
void round_gradient(int n_node, const double* gradient, float* to);

}  // namespace acinus::dcm
