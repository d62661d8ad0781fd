#pragma once
/// One group of eight cells as the term kernels see it.

#include "core/lanes.hpp"
#include "core/mesh/topology.hpp"

namespace acinus::dcm {

struct GroupView {
  const mesh::Topology* topology;
  std::size_t index;                                  ///< group number
  std::size_t first_row;                              ///< first point row in the global arrays
  std::size_t first_spring, first_hinge, first_face;  ///< first elements in the global arrays
  const double* position;                             ///< [n_node][3][lane] um
  const double* radius;  ///< [lane] um, reference radius at the end of the step
  const double* active;  ///< [lane] 1 where a cell is, 0 in empty lanes
};

}  // namespace acinus::dcm
