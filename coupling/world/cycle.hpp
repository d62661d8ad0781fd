#pragma once
/// Cell cycle: constants of growth, division and death per cell type, and the record of every cell.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/vec.hpp"

namespace acinus::coupling {

enum class DivisionAxis { kRandom, kPlane, kGiven, kVessel };  // kPlane: random, horizontal
enum class InhibitedBy { kNothing, kPressure, kVolume, kDensity };

/// Contact inhibition of growth, a Hill function (growth_factor of life/cell_cycle.hpp).
struct Inhibition {
  InhibitedBy by = InhibitedBy::kNothing;
  double threshold = 0;  ///< kPa, V / V0, or cells per um^3
  double power = 4;
};

struct DeathParams {
  bool lysis = false;          ///< false: removal at once
  double duration = 6 * 3600;  ///< s, duration of lysis
  double final_volume = 0.2;   ///< share of the volume at removal
  int type = -1;               ///< cell type with the constants of lysis
};

/// Life of one cell type.
struct CycleParams {
  double time = 0;          ///< s, mean cycle time; 0: cells of this type neither grow nor divide
  double spread = 0.1;      ///< relative standard deviation, truncated at 3
  double mitosis = 3600;    ///< s, relaxation time of the shape of birth of new daughters
  double force_ramp = 0.1;  ///< share of the cycle over which forces on new spheres rise
  DivisionAxis axis = DivisionAxis::kRandom;
  Vec3 direction = Vec3::UnitX();  ///< kGiven: division axis
  bool random_start = false;       ///< true: initial cells have random ages in their cycle
  Inhibition inhibition;
  DeathParams death;
};

/// Rule that makes cells rest or die.
struct LifeRule {
  bool die = false;
  std::function<bool(const Vec3&)> inside;  ///< test of a cell's centre; empty: everywhere
  std::vector<std::int64_t> cells;          ///< lineage numbers; empty: all
  bool descendants = true;                  ///< true: offspring of `cells` too
  double from = 0, until = std::numeric_limits<double>::infinity();  ///< s since t = 0
  double share = 1;                                                  ///< probability per cell
};

/// Rate at which cells of some layers enter the cycle during a time window.
struct EntryRate {
  int first_layer = 1, last_layer = 1;
  double rate = 0;                                                   ///< 1/s
  double from = 0, until = std::numeric_limits<double>::infinity();  ///< s since t = 0
};

/// Proliferation pattern: cells are quiescent until they enter the cycle, and again after division.
struct Proliferation {
  std::vector<EntryRate> rate;
  double thickness = 24;           ///< um, of a layer
  bool edge_at_start = false;      ///< true: layers are counted from start_edge at all times
  double start_edge = 0;           ///< um from the vein axis
  int cells = 0;                   ///< target number; 0: no limit
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical through it
};

struct LifeParams {
  std::vector<CycleParams> type;  ///< [cell type]
  std::vector<LifeRule> rule;
  std::optional<Proliferation> proliferation;  ///< empty: all cells are always in the cycle
  double grid = 600;                           ///< s between updates of rules and inhibition
  std::uint64_t seed = 1;
  bool remesh = true;  ///< true: degenerate meshes are repaired
};

/// Stage of a cell in its life. kRest: arrested by a rule or by inhibition; kQuiescent: outside the
/// cycle.
enum class Fate : std::int8_t { kIdle, kGrow, kRest, kLyse, kQuiescent };

/// Record of the life of a cell.
struct Cycle {
  std::int64_t parent = -1;   ///< lineage; -1: initial cell
  std::int64_t founder = -1;  ///< lineage of its initial ancestor
  Fate fate = Fate::kIdle;
  double birth = 0;         ///< s, clock time
  double birth_volume = 0;  ///< um^3; a cell divides when its reference volume has doubled
  double duration = 0;      ///< s, cycle time without inhibition
  double wait_until = 0;    ///< s, clock time of the next attempt after a failed division
};

}  // namespace acinus::coupling
