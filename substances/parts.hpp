#pragma once
/// Insides of bodies whose membranes part them from their surroundings: one part for each voxel
/// that a body reaches into. Parts of one body are linked, those of two bodies never.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "substances/cover.hpp"
#include "substances/shares.hpp"

namespace acinus::substances {

/// Parts of many bodies, in order: those of body k are [start[k], start[k + 1]), by voxel.
struct Parts {
  /// Face between two parts of a body.
  struct InnerFace {
    std::size_t a = 0, b = 0;  ///< parts
    int axis = 0;              ///< across which the face lies
    double fraction = 0;       ///< of the face, inside the body
  };
  /// Membrane between a part and the space around the body.
  struct Membrane {
    std::size_t part = 0, voxel = 0;
    double area = 0;  ///< um^2
  };
  std::vector<std::size_t> start{0};
  std::vector<std::size_t> voxel;  ///< [part]
  std::vector<double> volume;      ///< [part] um^3
  std::vector<InnerFace> inner;
  std::vector<Membrane> membrane;

  std::size_t n_body() const { return start.size() - 1; }
  std::size_t n() const { return voxel.size(); }
};

/// Adds the parts of a body, at least one. Voxels with less than kLeastOpen of it have none.
/// @param surface  shares by area
/// @param area     um^2, of the surface
void add_body(const VoxelGrid& grid, const Cover& cover, std::span<const VoxelShare> surface,
              double area, Parts& parts);

/// Part of a body at a voxel, else the nearest one.
std::size_t nearest_part(const VoxelGrid& grid, const Parts& parts, std::size_t body,
                         std::size_t voxel);

}  // namespace acinus::substances
