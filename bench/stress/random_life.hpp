#pragma once
/// Random life of the scenes of the stress suite: growth, division, death, rest, sleep.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// Properties of a scene that its life must match.
struct LifeSetting {
  std::uint64_t seed = 0;
  bool wide = false;  ///< extreme parameters, else accelerated physiological ones
  double end = 0;     ///< simulated time, s
  int cells = 0;
  double radius = 0;      ///< um
  bool vessels = false;   ///< division along vessels is possible
  bool confined = false;  ///< by walls, a capsule or a lobule
};

/// JSON text of the life blocks, to be merged into the scene. Uses a random stream of its own, so
/// that the rest of the scene is independent of it.
std::string draw_life(const LifeSetting& setting);

}  // namespace acinus::bench
