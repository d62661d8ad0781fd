#pragma once
/// Where generators take their random numbers from.

#include <functional>

namespace acinus::coupling {

/// Returns the next number of a stream, uniform in [0, 1). Generators draw in a fixed order, so the
/// same stream gives the same result on every machine.
using Uniform = std::function<double()>;

}  // namespace acinus::coupling
