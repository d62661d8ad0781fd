#pragma once
/// Where a zoom wants deformable cells.

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/migration/lesion_layers.hpp"
#include "coupling/world/zoom.hpp"
#include "geometry/network.hpp"

namespace acinus::coupling {

/// A cell as regions look at it.
struct ZoomCell : LayerCell {
  std::int64_t lineage = -1, founder = -1;
  double pressure = 0;  ///< kPa, contact pressure
};

/// How far outside the nearest region of the zoom each cell is. In parts of space and near what is
/// followed: um, 0 and less inside. In regions by pressure: 0 for cells at and above the upper
/// threshold, infinite for those at and below the lower one, and half the margin between, where
/// cells stay what they are.
std::vector<double> distances_from_zoom(const ZoomParams& zoom, const geometry::Network& vessels,
                                        std::span<const ZoomCell> cells);

/// Whether a region of the zoom goes by pressure.
bool zoom_needs_pressure(const ZoomParams& zoom);

}  // namespace acinus::coupling
