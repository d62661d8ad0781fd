#pragma once
/// Parameters of a zoom: the choice of deformable cells in a run.

#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "coupling/world/region.hpp"
#include "geometry/topology.hpp"

namespace acinus::coupling {

/// Parameters of a moving zoom. Cells change their model as they enter or leave its regions.
struct ZoomParams {
  double grid = 0;          ///< s between updates; 0: cells keep their first model
  double margin = 24;       ///< um, distance outside the regions that demotes a cell
  double stay = 1800;       ///< s, least time between changes of a cell
  double fade = 3600;       ///< s, duration of fading forces
  int at_once = 16;         ///< largest number of changes in an update
  int most_deformable = 0;  ///< largest number of deformable cells; 0: no limit
  std::vector<Region> region;
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical through it
  /// [cell type] mesh of deformable cells
  std::vector<const geometry::Topology*> mesh;
  std::uint64_t seed = 1;  ///< seed of orientations of new meshes and moduli of new spheres

  bool moves() const { return grid > 0; }
};

}  // namespace acinus::coupling
