#pragma once
/// Distances of cells from the regions of a zoom.

#include <cstdint>
#include <span>
#include <vector>

#include "coupling/migration/lesion_layers.hpp"
#include "coupling/world/zoom.hpp"
#include "geometry/network.hpp"

namespace acinus::coupling {

/// Cell properties that regions depend on.
struct ZoomCell : LayerCell {
  std::int64_t lineage = -1, founder = -1;
  double pressure = 0;  ///< kPa, contact pressure
};

/// Distance of each cell outside the nearest region of the zoom. In parts of space and near
/// followed objects: um, 0 and less inside. In regions by pressure: 0 at and above the upper
/// threshold, infinite at and below the lower one, and half the margin between, which changes no
/// model.
std::vector<double> distances_from_zoom(const ZoomParams& zoom, const geometry::Network& vessels,
                                        std::span<const ZoomCell> cells);

/// True if a region of the zoom depends on pressure.
bool zoom_needs_pressure(const ZoomParams& zoom);

}  // namespace acinus::coupling
