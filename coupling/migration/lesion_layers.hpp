#pragma once
/// How many cells deep a cell lies behind the edge of a lesion round a vertical axis.

#include <span>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

struct LayerCell {
  Vec3 center = Vec3::Zero();  ///< um
  double radius = 0;           ///< um
};

/// How far a cell lies behind the edge of the lesion, um: its distance from the axis less that of
/// the edge before it. The edge before it is the smallest distance among cells, itself included,
/// less than one diameter away in arc (at the cell's own distance) and in height.
double distance_to_edge(const LayerCell& cell, std::span<const LayerCell> cells,
                        const Vec3& axis_point);

/// Layer of a cell, from 1: its distance to the edge in diameters of the cell, rounded, plus 1.
/// Cells in front of each other at centre distances of half a diameter and less share a layer.
/// @param axis_point  the axis is vertical through it
int local_layer_of(const LayerCell& cell, std::span<const LayerCell> cells, const Vec3& axis_point);

/// That of every cell. Cost: all pairs.
std::vector<int> compute_layers(std::span<const LayerCell> cells, const Vec3& axis_point);

}  // namespace acinus::coupling
