#pragma once
/// Keeps processes from waiting for each other: what cells cost is measured, and they are shared
/// anew.

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// To be called after every accepted step. Every now and then looks at how long the processes were
/// busy, notes what cells cost, and shares them anew if some waited for others.
void balance_shares(const World& world, Workspace& work);

}  // namespace acinus::coupling
