#pragma once
/// Shapes of cells for the matrix, from which it takes the directions of springs and hinges.

#include "dcm/group_view.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Writes System::shape of a group: places of its nodes from their mean, um. Places in the world
/// would lose digits far from its origin. Must precede the terms.
void write_shape(const GroupView& g, solve::System& s);

/// Shape of a group, [n_node][3][lane] um.
inline const float* shape_of(const GroupView& g, const solve::System& s) {
  return s.shape.data() + g.first_shape * kPointStride;
}

/// Squared length of an edge of a shape as the matrix sees it, um^2.
ACINUS_INLINE Lane squared_length(const float* shape, int i, int j) {
  const Lane3 d = load3(shape + j * kPointStride) - load3(shape + i * kPointStride);
  return dot(d, d);
}

}  // namespace acinus::dcm
