#pragma once
/// Source of random numbers for generators.

#include <functional>

namespace acinus::coupling {

/// Next number of a stream, uniform in [0, 1). Generators draw in a fixed order, so the same stream
/// gives the same result on every machine.
using Uniform = std::function<double()>;

}  // namespace acinus::coupling
