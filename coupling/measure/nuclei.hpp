#pragma once
/// Check of nuclei outside their cortex.

#include <cstdint>
#include <span>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Nucleus node farthest outside its cortex.
struct NucleusLeak {
  double depth_um = 0;  ///< distance outside; 0: none
  std::int64_t cell = -1;
};

/// Measures the deepest node of a nucleus outside its cortex, without code shared with the contact
/// search (geometry/audit_body.hpp).
/// @param ghost  [lanes] not 0: the cell is left out; empty: none is
NucleusLeak measure_nucleus_leak(const State& state, std::span<const std::uint8_t> ghost = {});

}  // namespace acinus::coupling
