#pragma once
/// Refuses states of checkpoints that no run could have written: numbers that are none, places that
/// are not there.

#include <cstddef>
#include <string>

#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Cell types of a world, which a state of it may name.
struct StateTypes {
  std::size_t dcm = 0, cbm = 0;
};
inline StateTypes types_of(const coupling::Params& p) { return {p.dcm.size(), p.cbm.size()}; }

/// @param source  the file, for messages
/// @throws Error(kFileError)
void check_state(const coupling::State& state, const StateTypes& types, const std::string& source);

}  // namespace acinus::runs
