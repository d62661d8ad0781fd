#pragma once
/// Memory of a process by kind of data, to see which kinds grow with the tissue of other processes.

#include <cstddef>
#include <string>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Memory of one kind, bytes.
struct MemoryUse {
  std::string kind;
  std::size_t bytes = 0;
};

/// Memory of the state and of the workspace of a step, by kind: that of the arrays with the room
/// they keep, in pages that have been written.
std::vector<MemoryUse> measure_memory(const State& state, Workspace& work);

}  // namespace acinus::coupling
