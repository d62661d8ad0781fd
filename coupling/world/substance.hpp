#pragma once
/// Substances that diffuse around cells: constants and state.

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

struct SubstanceParams {
  substances::VoxelGrid grid;        ///< present; see substances/growing_box.hpp
  substances::VoxelGrid first_grid;  ///< at t = 0; with `grows`
  bool grows = false;                ///< the box keeps `margin` around the cells
  double margin = 0;                 ///< um
  std::vector<Substance> substance;
  double longest_step = 0;  ///< s; 0: the step of the tissue
  double tolerance = 1e-6;
  int leader_signal = -1;  ///< substance whose gradient leaders follow; -1: toward the vein axis
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
  substances::Layers layers{};  ///< added to the first grid, the same of all substances
};

}  // namespace acinus::coupling
