#pragma once
/// Rules of a scene by which cells respond to signals.

#include <string>

#include "coupling/world/cycle.hpp"
#include "coupling/world/signal.hpp"
#include "runs/assemble/notes.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::runs {

/// One rule of a scene in words: "growth of all cells falls with pressure: half at 200 Pa, power
/// 4".
std::string describe_rule(const Scene& scene, const SignalRuleEntry& rule);

/// Constants of the rules.
/// @param life   of build_life(), with the types of cells in lysis
/// @param notes  receives each in words
coupling::RuleParams build_rules(const Scene& scene, const coupling::LifeParams& life,
                                 Notes& notes);

}  // namespace acinus::runs
