#pragma once
/// Assignment of a shape to a cell: nodes, rest shape of the cortex, and nucleus.

#include <cstddef>
#include <span>

#include "dcm/params.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

struct GivenShape {
  std::span<const Vec3> node;  ///< [n_node] um
  double radius = 0;           ///< um, reference radius
  double stretch = 1;  ///< of the surface, acts from the first moment on, see make_birth_shape
  Ramp weight;         ///< of the shape as the cortex's rest, from 1 to 0
};

/// Moves the nodes of a cell to a shape. The cortex is at rest in the shape and forgets it; a
/// nucleus is placed anew with links at rest.
void give_shape(const Params& params, const GivenShape& shape, std::size_t lane, State& state);

}  // namespace acinus::dcm
