#pragma once
/// Which cells are deformable while a scene runs.

#include <cstdint>
#include <vector>

#include "core/vec.hpp"
#include "coupling/world/region.hpp"
#include "geometry/topology.hpp"

namespace acinus::coupling {

/// A zoom that moves. Cells change their model when they enter or leave its regions.
struct ZoomParams {
  double grid = 0;          ///< s between two looks; 0: cells keep the model they start with
  double margin = 24;       ///< um, how far a deformable cell may leave the regions
  double stay = 1800;       ///< s, for which a cell keeps a model it took
  double fade = 3600;       ///< s, in which forces fade that the new model does not have
  int at_once = 16;         ///< cells that change at one look, at most
  int most_deformable = 0;  ///< cells; 0: no limit
  std::vector<Region> region;
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical through it
  /// [cell type] mesh of its deformable cells
  std::vector<const geometry::Topology*> mesh;
  std::uint64_t seed = 1;  ///< of the orientation of new meshes, and of the moduli of new spheres

  bool moves() const { return grid > 0; }
};

}  // namespace acinus::coupling
