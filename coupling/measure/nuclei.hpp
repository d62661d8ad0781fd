#pragma once
/// Check of nuclei outside their cortex.

#include <cstdint>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Nucleus node farthest outside its cortex.
struct NucleusLeak {
  double depth_um = 0;  ///< distance outside; 0: none
  std::int64_t cell = -1;
};

/// Measures the deepest node of a nucleus outside its cortex, without code shared with the contact
/// search (geometry/audit_body.hpp).
NucleusLeak measure_nucleus_leak(const State& state);

}  // namespace acinus::coupling
