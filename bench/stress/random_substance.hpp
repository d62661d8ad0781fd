#pragma once
/// Random substances and rules of the scenes of the stress suite.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// Properties of a scene that its substances must match.
struct SubstanceSetting {
  std::uint64_t seed = 0;
  bool wide = false;  ///< extreme parameters, else common ones
  bool life = false;  ///< cells grow and die: rules of growth and death
  double end = 0;     ///< simulated time, s
  double radius = 0;  ///< of the cells, um
  bool vessels = false;
};

/// JSON text of substances, exchange and rules, to be merged into the scene: two scenes of five
/// have substances, one in eight rules without substances, "{}" for the rest. Uses a random stream
/// of its own, so that the rest of the scene is independent of it.
std::string draw_substances(const SubstanceSetting& setting);

}  // namespace acinus::bench
