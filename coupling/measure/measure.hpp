#pragma once
/// Measures of each cell, from loads assembled at one time. Those of nodes: node_measures.hpp

#include <array>
#include <cstdint>
#include <vector>

#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

struct CellMeasure {
  std::int64_t id = 0;
  std::int64_t parent = -1;  ///< lineage; -1: initial cell
  bool deformable = false;
  int type = 0;
  bool leader = false;
  Vec3 center = Vec3::Zero();   ///< um
  double radius = 0;            ///< um, reference radius (3 V0 / 4 pi)^(1/3)
  double volume = 0, area = 0;  ///< um^3, um^2; intrinsic values of a sphere
  /// kPa, contact pressure of either model, p = tr(sum f (x) (x_contact - c)) / (-3 V0): positive
  /// in compression.
  double pressure = 0;
  double cytosol_pressure = 0;     ///< kPa, -K_V ln(V/V0); for a sphere its contact pressure
  std::array<double, 6> stress{};  ///< kPa, xx xy xz yy yz zz of (1/V0) sum f (x) (x_contact - c)
  double contact_area = 0;         ///< um^2, part of `area` in contact
  double strength = 1;             ///< strength of its forces, see cbm::CellData
  bool newborn = false;            ///< true in the first ten minutes after a division
  /// nN, sum of force magnitudes over partners: cells, walls, static meshes and segments of
  /// vessels.
  double contact_force = 0;
  /// nN, sum of normal forces over partners, positive in compression: along the line of centres
  /// with a cell, along the normal of each contact with boundary.
  double normal_force = 0;
  int contacts = 0;            ///< cells in contact
  double migration_force = 0;  ///< nN, active force on the cell
  Fate fate = Fate::kIdle;     ///< stage in its life
  double progress = 0;         ///< of its cycle by reference volume: 0 at birth, 1 at division
  bool in_cycle = false;       ///< true if it grows to a division, or would if nothing held it
  double growth_rate = 0;      ///< um^3/s, of the reference volume; negative in lysis
};

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::CellMeasure> = true;
}  // namespace acinus

namespace acinus::coupling {

/// Assembles the loads of the present time without a step; State is not changed.
void observe(const World& world, Workspace& work);

/// Computes contact forces of the present time alone, for visit_contacts.
void observe_contacts(const World& world, Workspace& work);

/// Measures of all cells, deformable ones first, in storage order, over all processes. Collective
/// call, like all measures below.   @pre observe
std::vector<CellMeasure> measure_cells(const World& world, const Workspace& work);

}  // namespace acinus::coupling
