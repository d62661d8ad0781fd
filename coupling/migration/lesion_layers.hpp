#pragma once
/// Layers of cells behind the edge of a lesion around a vertical axis.

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

struct LayerCell {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
};

/// Distance of a cell behind the edge of the lesion, um: its distance from the axis minus that of
/// the edge in front of it. That edge is the smallest distance among the cells, itself included,
/// within one diameter in arc (at its own distance) and in height.
double distance_to_edge(const LayerCell& cell, std::span<const LayerCell> cells,
                        const Vec3& axis_point);

/// Layer of a cell, from 1: its distance to the edge in diameters of the cell, rounded, plus 1.
/// Cells in front of each other at centre distances of half a diameter and less share a layer.
/// @param axis_point  the axis is vertical through it
int local_layer_of(const LayerCell& cell, std::span<const LayerCell> cells, const Vec3& axis_point);

/// Layers of all cells. Cost: at most all pairs; a cell is compared with those nearer the axis
/// until one is before it.
std::vector<int> compute_layers(std::span<const LayerCell> cells, const Vec3& axis_point);

}  // namespace acinus::coupling
