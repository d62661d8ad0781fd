#pragma once
/// Common part of the whole-cell terms (volume, area): a force along their gradient.

#include "core/numbers/lanes.hpp"

namespace acinus::dcm {

/// Adds scale * vector to every node; scale is one number per lane.
inline void add_scaled(int n_node, const double* scale, const double* vector, double* to) {
  const Lane s = load(scale);
  for (int i = 0; i < n_node; ++i)
    add3(to + i * kPointStride, s * load3(vector + i * kPointStride));
}

}  // namespace acinus::dcm
