#pragma once
/// Promotion of a sphere to a deformable cell, and demotion. Only the cell itself; the effect on
/// its neighbours is in update.hpp.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Mesh of a promoted sphere.
struct NewShell {
  bool ok = true;
  std::string why;         ///< cause of a failure
  std::vector<Vec3> node;  ///< um
};

/// Shapes a mesh in the available volume of a sphere. Its volume is that of the cytosol under the
/// contact pressure, V0 exp(-p / K_V).
/// @param pressure  kPa, contact pressure; tension counts as 0
/// @param radius    [cbm cells] um
NewShell shape_sphere(const World& world, std::size_t sphere, double pressure,
                      std::span<const double> radius);

/// State of the promoted cell alone, with its reference volume, cycle and last move. The cortex
/// takes the shape as its rest shape and relaxes from it within dcm::kForgetShape.
State make_shell(const World& world, std::size_t sphere, const NewShell& shell);

/// State of the demoted cell alone: a sphere at the centroid of its volume.
State make_sphere(const World& world, std::size_t lane);

}  // namespace acinus::coupling
