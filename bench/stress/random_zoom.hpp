#pragma once
/// A zoom that moves, drawn at random, for the scenes of the stress suite with life.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// What the zoom of a scene has to fit.
struct ZoomSetting {
  std::uint64_t seed = 0;
  bool wide = false;  ///< extremes, else what a user might write
  double end = 0;     ///< s, simulated time
  int cells = 0;
  double radius = 0;     ///< um, of the cells
  bool vessels = false;  ///< regions may follow them
  bool lobule = false;   ///< regions may follow the edge of its lesion
};

/// JSON text of the blocks to be merged into the scene, "{}" for a zoom that stays as it is. A
/// stream of random numbers of its own: what else the scene holds does not depend on it.
std::string draw_zoom(const ZoomSetting& setting);

}  // namespace acinus::bench
