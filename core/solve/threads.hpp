#pragma once
/// When a system is worth more than one thread.

#include "core/solve/system.hpp"

namespace acinus::solve {

/// Below this many point rows starting threads costs more than it saves.
inline bool worth_threads(const System& s) { return s.n_row > 400; }

}  // namespace acinus::solve
