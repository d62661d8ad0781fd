#pragma once
/// Scenes drawn at random, for the stress suite. docs/stress.md gives the distribution in words.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// Nominal: every parameter inside the ranges of [VanLiedekerke2020, Table 1], time steps up to
/// 120 s with step-size control, starts without deep overlap. Wide: parameters up to ten times
/// smaller or larger, adhesion up to 1e-3 J/m^2, steps of 1 to 1800 s also without control, starts
/// that overlap.
enum class Family { kNominal, kWide };
const char* name_of(Family family);

/// Odd seeds are nominal, even ones wide: a seed alone names a scene.
Family family_of(std::uint64_t seed);

struct RandomScene {
  std::string text;     ///< JSON in the scene format
  std::string network;  ///< SWC text for the file kNetworkFile beside the scene; "" = none
  int cells = 0;        ///< at the start, at most; darts may find less room
};
inline constexpr const char* kNetworkFile = "vessels.swc";

/// The scene of a seed, the same text every time.
/// @param life  the cells of the same scene also grow, divide, die and rest (random_life.hpp), and
/// may change their
///              model (random_zoom.hpp)
RandomScene draw_scene(std::uint64_t seed, bool life = false);

}  // namespace acinus::bench
