#pragma once
/// Life drawn at random, for the scenes of the stress suite: growth, division, death, rest, sleep.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// What the life of a scene has to fit.
struct LifeSetting {
  std::uint64_t seed = 0;
  bool wide = false;  ///< extremes, else what tissue could do if it were in a hurry
  double end = 0;     ///< s, simulated time
  int cells = 0;
  double radius = 0;      ///< um
  bool vessels = false;   ///< cells may divide along one
  bool confined = false;  ///< by walls, a capsule or a lobule
};

/// JSON text of the blocks to be merged into the scene. A stream of random numbers of its own: what
/// else the scene holds does not depend on it.
std::string draw_life(const LifeSetting& setting);

}  // namespace acinus::bench
