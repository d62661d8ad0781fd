#pragma once
/// A cell takes a shape of its own: nodes, what its cortex takes for rest, and a nucleus in it.

#include <cstddef>
#include <span>

#include "dcm/params.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

struct GivenShape {
  std::span<const Vec3> node;  ///< [n_node] um
  double radius = 0;           ///< um, reference radius
  double stretch = 1;          ///< of the surface, felt from the first moment, see make_birth_shape
  Ramp weight;                 ///< of the shape as the cortex's rest, from 1 to 0
};

/// Moves the nodes of a cell there. The cortex is at rest in the shape and forgets it; a nucleus is
/// placed anew with links at rest.
void give_shape(const Params& params, const GivenShape& shape, std::size_t lane, State& state);

}  // namespace acinus::dcm
