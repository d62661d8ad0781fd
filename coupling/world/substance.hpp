#pragma once
/// Substances that diffuse around cells, and the responses of cells to them: constants and state.

#include <cstdint>
#include <string>
#include <vector>

#include "core/numbers/schedule.hpp"
#include "core/vec.hpp"
#include "substances/grid.hpp"
#include "substances/medium.hpp"

namespace acinus::coupling {

/// Exchange of a cell type with a substance: per volume of the cell, and per area of its surface.
struct CellExchange : substances::Exchange {
  double secretion_per_area = 0;  ///< concentration um/s
  double uptake_per_area = 0;     ///< um/s
};

/// Concentrations are in a unit of the user's choice, the same in all that concerns a substance.
struct Substance {
  std::string name;
  std::string unit = "1";
  substances::Medium medium;
  double initial = 0;
  Schedule course;  ///< factor on the values of faces, vessels and sources, s since t = 0; empty: 1
  std::vector<CellExchange> exchange;  ///< [cell type]
  bool outside_cells = false;          ///< kept out of cells
  /// um/s; > 0 with outside_cells: also inside cells, behind membranes that let it through.
  double permeability = 0;
  bool outside_obstacles = false;  ///< kept out of walls, vessels and static meshes
  bool has_membranes() const { return permeability > 0; }
  bool is_kept_out() const { return outside_cells || outside_obstacles; }
};

/// Behaviour of a cell that a substance changes.
enum class Behaviour : std::uint8_t {
  kGrowth,
  kDeath,
  kMotility,
  kChemotaxis,
  kSecretion,
  kUptake
};

/// Response of cells to a substance: a Hill function of the concentration at the cell,
/// c^power / (half_max^power + c^power), or 1 minus it.
struct SignalRule {
  int signal = 0;  ///< index of the substance
  Behaviour behaviour = Behaviour::kGrowth;
  bool decreases = false;  ///< the response falls with the concentration
  int type = -1;           ///< cell type; -1: all
  double half_max = 1;     ///< concentration
  double power = 4;
  int of = -1;       ///< kSecretion, kUptake: index of the substance that is exchanged
  double rate = 0;   ///< 1/s, kDeath: rate at full response
  double force = 0;  ///< nN, kChemotaxis: force up the gradient at full response; < 0: down
  double sensitivity =
      0.01;  ///< kChemotaxis: relative difference across the cell of half the force
};

struct SubstanceParams {
  substances::VoxelGrid grid;
  std::vector<Substance> substance;
  std::vector<SignalRule> rule;
  double longest_step = 0;  ///< s; 0: the step of the tissue
  double tolerance = 1e-6;
  int leader_signal = -1;  ///< substance whose gradient leaders follow; -1: toward the vein axis
  double leader_sensitivity = 0.01;
  bool exists() const { return !substance.empty(); }
};

/// Concentrations inside cells behind membranes, one for each voxel that a cell reaches into; cells
/// one after the other.
struct InsideState {
  std::vector<std::int64_t> cell, voxel;      ///< [part] lineage of the cell; voxel
  std::vector<double> volume, concentration;  ///< [part] um^3 in the voxel; concentration there
};

/// Field of one substance, and what it gained and lost since t = 0 (amounts).
struct SubstanceState {
  std::vector<double> concentration;  ///< [n_voxel] in the open space; values around it if closed
  std::vector<double> open;           ///< [n_voxel] open fraction of a voxel; empty: all is open
  InsideState inside;                 ///< empty without membranes
  double secreted = 0, entered = 0, supplied = 0, decayed = 0;
};

/// Motion of a cell that substances change.
struct Guidance {
  double motility = 1;          ///< factor on the diffusion coefficient of random motion
  Vec3 force = Vec3::Zero();    ///< nN, chemotaxis
  Vec3 heading = Vec3::Zero();  ///< of leaders; shorter than 1 where the gradient is weak
};

}  // namespace acinus::coupling
