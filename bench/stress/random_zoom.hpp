#pragma once
/// Random moving zoom of the scenes of the stress suite with life.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// Properties of a scene that its zoom must match.
struct ZoomSetting {
  std::uint64_t seed = 0;
  bool wide = false;  ///< extreme parameters, else common ones
  double end = 0;     ///< simulated time, s
  int cells = 0;
  double radius = 0;     ///< of the cells, um
  bool vessels = false;  ///< regions may follow vessels
  bool lobule = false;   ///< regions may follow the edge of the lesion
};

/// JSON text of the zoom blocks, to be merged into the scene; "{}" for a fixed zoom. Uses a random
/// stream of its own, so that the rest of the scene is independent of it.
std::string draw_zoom(const ZoomSetting& setting);

}  // namespace acinus::bench
