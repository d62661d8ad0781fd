#pragma once
/// Cell chosen from a state of either model or of both, to be copied into another state.

#include <cstddef>

namespace acinus {

template <class State>
struct SelectedCell {
  const State* state = nullptr;
  std::size_t index = 0;  ///< lane of a deformable cell, index of a sphere
  int type = -1;          ///< cell type of the copy; -1: that of the cell
};

}  // namespace acinus
