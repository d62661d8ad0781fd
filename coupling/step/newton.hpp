#pragma once
/// Newton's method for a step of backward Euler, Gamma/h dx = F(x + dx; t + h); first order.

#include <functional>

#include "core/error.hpp"
#include "coupling/step/effort.hpp"
#include "coupling/step/system_loads.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Callback that assembles the system at a state, as assemble in step.hpp.
using Assembler = std::function<void(const World& world, const State& at, double step,
                                     Workspace& work, const SystemTerms& terms)>;

/// Iterates with line search from the displacement of a linearly implicit step in work.move.
[[nodiscard]] Status iterate_newton(const World& world, double step, const Assembler& assemble,
                                    Workspace& work, Effort& effort);

}  // namespace acinus::coupling
