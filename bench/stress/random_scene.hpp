#pragma once
/// Random scenes of the stress suite; docs/developers/stress.md describes the distribution.

#include <cstdint>
#include <string>

namespace acinus::bench {

/// Family of random scenes. Nominal: parameters within the ranges of [VanLiedekerke2020, Table 1],
/// steps up to 120 s with step-size control, starts without deep overlap. Wide: parameters up to
/// ten times smaller or larger, adhesion up to 1e-3 J/m^2, steps of 1 to 1800 s also without
/// control, overlapping starts.
enum class Family { kNominal, kWide };
inline const char* name_of(Family family) { return family == Family::kWide ? "wide" : "nominal"; }

/// Family of a seed: odd seeds are nominal, even ones wide.
inline Family family_of(std::uint64_t seed) {
  return seed % 2 == 1 ? Family::kNominal : Family::kWide;
}

/// Files of a random scene.
struct RandomScene {
  std::string text;     ///< JSON in the scene format
  std::string network;  ///< SWC text of kNetworkFile beside the scene; "" = none
  int cells = 0;        ///< upper bound of the number at the start
};
inline constexpr const char* kNetworkFile = "vessels.swc";

/// Kind of the random scenes of a set. Of all of them two in five have substances
/// (random_substance.hpp).
struct SceneKind {
  /// Cells also grow, divide, die and rest (random_life.hpp) and may change their model
  /// (random_zoom.hpp).
  bool life = false;
  std::string law = "";  ///< contact.law of all scenes; "": drawn for each
};

/// Draws the scene of a seed, always the same text.
RandomScene draw_scene(std::uint64_t seed, const SceneKind& kind = {});

}  // namespace acinus::bench
