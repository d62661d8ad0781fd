#pragma once
/// Whether nuclei are where they belong.

#include <cstdint>

#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// The node of a nucleus that is farthest outside its cortex.
struct NucleusLeak {
  double depth_um = 0;  ///< outside; 0: none is
  std::int64_t cell = -1;
};

/// Shares no code with the contact search (geometry/audit_body.hpp).
NucleusLeak measure_nucleus_leak(const State& state);

}  // namespace acinus::coupling
