#pragma once
/// Validity check of states read from checkpoints: finite numbers in range, indices that exist.

#include <cstddef>
#include <string>

#include "coupling/world/world.hpp"

namespace acinus::runs {

/// Numbers of cell types of a world, which bound the type indices of its state.
struct StateTypes {
  std::size_t dcm = 0, cbm = 0;
};
inline StateTypes types_of(const coupling::Params& p) { return {p.dcm.size(), p.cbm.size()}; }

/// Refuses a state that no run could have written.
/// @param source  checkpoint file, for messages
/// @throws Error(kFileError)
void check_state(const coupling::State& state, const StateTypes& types, const std::string& source);

}  // namespace acinus::runs
