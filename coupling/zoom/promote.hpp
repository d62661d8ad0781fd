#pragma once
/// A sphere becomes a deformable cell, and the other way round: the cell alone, without what the
/// change does to its neighbours (update.hpp).

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The mesh that a sphere becomes.
struct NewShell {
  bool ok = true;
  std::string why;         ///< not ok: what is in the way
  std::vector<Vec3> node;  ///< um
};

/// A mesh in the room of a sphere, as large as its cytosol is under the pressure of its contacts,
/// V0 exp(-p / K_V).
/// @param pressure  kPa, contact pressure; tension counts as none
/// @param radius    [cbm cells] um
NewShell shape_sphere(const World& world, std::size_t sphere, double pressure,
                      std::span<const double> radius);

/// The cell as a state of its own, with its reference volume, cycle and last move. Its cortex takes
/// the shape for rest and forgets it within dcm::kForgetShape.
State make_shell(const World& world, std::size_t sphere, const NewShell& shell);

/// A deformable cell as a sphere at the centre of its volume.
State make_sphere(const World& world, std::size_t lane);

}  // namespace acinus::coupling
