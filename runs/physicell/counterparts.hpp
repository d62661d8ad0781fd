#pragma once
/// Signals and behaviours of PhysiCell that have no counterpart here.

#include <string>

namespace acinus::runs {

/// Reason why a signal is left out, and what there is instead; null for one that has a counterpart
/// and for names of substances.
const char* missing_signal(const std::string& name);

/// The same for a behaviour, by the start of its name.
const char* missing_behaviour(const std::string& name);

}  // namespace acinus::runs
