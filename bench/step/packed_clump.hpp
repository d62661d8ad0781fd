#pragma once
/// Standard tissue of the measurements: deformable cells packed closer than their diameters, as in
/// growing tissue.

#include <optional>
#include <string>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::bench {

/// Parameters of the standard clump.
struct PackedClump {
  int count = 27;
  int nodes = 162;
  std::string quadrature = "3-point";
  std::optional<double> step = 120;   ///< fixed step, s; empty: default step-size control
  std::optional<double> skin{};       ///< contact skin, um; empty: default
  std::optional<double> tolerance{};  ///< of the linear solver; empty: default
  double local_area_modulus = 0;      ///< N/m
  std::string nucleus = "null";       ///< block of the cell type, JSON text
};

/// Contact skin of least cost in such a clump, um.
inline constexpr double kClumpSkin = 0.6;

/// Scene text of the clump; its cells neither grow nor move actively.
std::string packed_clump_text(const PackedClump& clump);

/// Sets all deformable cells to double their birth volume within a day, as in steady growth.
void grow(coupling::World& world);

/// Clump during a run: after five steps, with the contacts and the assembled system of the next
/// one.
struct AssembledClump {
  coupling::World world;
  coupling::Workspace work;

  /// Builds the clump.
  /// @pre the clump has a fixed step
  explicit AssembledClump(const PackedClump& clump);
  AssembledClump(const AssembledClump&) = delete;  // the operator points at the system
  AssembledClump& operator=(const AssembledClump&) = delete;
};

}  // namespace acinus::bench
