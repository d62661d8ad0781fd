#pragma once
/// Passage of a cell through a narrow hole.

#include <optional>

#include "runs/experiments/measures.hpp"

namespace acinus::runs {

/// Time from when the cell first reaches into the hole to when it has passed, h; none if it has
/// not.
std::optional<double> passage_time(const Measures& measures);

}  // namespace acinus::runs
