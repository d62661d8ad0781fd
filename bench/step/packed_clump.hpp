#pragma once
/// The tissue that most measurements are made on: deformable cells packed closer than they are
/// wide, as in a growing tissue.

#include <optional>
#include <string>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

struct PackedClump {
  int count = 27;
  int nodes = 162;
  std::string quadrature = "3-point";
  std::optional<double> step = 120;   ///< s, kept throughout; nothing: time control by default
  std::optional<double> skin{};       ///< um, of contact; nothing: by default
  std::optional<double> tolerance{};  ///< of the linear solver; nothing: by default
  double local_area_modulus = 0;      ///< N/m
  std::string nucleus = "null";       ///< block of the cell type, as JSON
};

/// Skin of contact lists that costs least in such a clump, um.
inline constexpr double kClumpSkin = 0.6;

/// The clump as the text of a scene; its cells do not grow and nothing moves them.
std::string packed_clump_text(const PackedClump& clump);

/// From now on every deformable cell grows from birth volume to twice that in a day, as in steady
/// growth.
void grow(coupling::World& world);

/// A clump in the middle of a run: after five of its steps, with the contacts and the assembled
/// system of the next one.
struct AssembledClump {
  coupling::World world;
  coupling::Workspace work;

  /// @pre  the clump keeps its step
  explicit AssembledClump(const PackedClump& clump);
  AssembledClump(const AssembledClump&) = delete;  // the operator points at the system
  AssembledClump& operator=(const AssembledClump&) = delete;
};

}  // namespace acinus::bench
