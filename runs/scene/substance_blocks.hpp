#pragma once
/// Scene blocks of substances: fields, exchange with cells; rules of cells.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "coupling/world/region.hpp"
#include "coupling/world/signal.hpp"
#include "coupling/world/substance.hpp"

namespace acinus::runs {

/// Face of the box, in the order of substances::Medium::face.
enum class BoxFace { kXLow, kXHigh, kYLow, kYHigh, kZLow, kZHigh };

struct FaceEntry : substances::FaceCondition {
  BoxFace side = BoxFace::kXLow;
};

/// Source that stays in place: secretion (1 - c / saturation) wherever a voxel's centre is in the
/// region.
struct SourceEntry {
  coupling::Region region;
  double secretion = 0;   ///< concentration / s
  double saturation = 0;  ///< 0: none
};

/// Exchange of vessels along their walls: permeability (concentration - c) per area.
struct VesselFeed {
  double concentration = 0;
  double permeability = 0;  ///< um/s
};

/// Way of a substance through cells: through them freely, around them, through their membranes.
enum class CellPassage { kPass, kKeepOut, kMembrane };

struct SubstanceBlock {
  std::string name;
  std::string unit = coupling::Substance{}.unit;
  double diffusion = 0;  ///< um^2/s
  double decay = 0;      ///< 1/s
  double initial = 0;
  Schedule course;                     ///< factor on what the outside supplies; empty: 1
  substances::FaceCondition boundary;  ///< of all faces of the box but those in `faces`
  std::vector<FaceEntry> faces;
  std::vector<SourceEntry> sources;
  std::optional<VesselFeed> vessels;
  CellPassage cells = CellPassage::kPass;
  double permeability = 0;         ///< um/s, of membranes
  bool outside_obstacles = false;  ///< kept out of walls, vessels and static meshes
  bool outside_cells() const { return cells != CellPassage::kPass; }
};

struct SubstanceGridBlock {
  double spacing = 0;                      ///< um; 0: the radius of the smallest cell type
  std::optional<std::array<Vec3, 2>> box;  ///< empty: around cells, vessels and lobule
  double margin = 100;                     ///< um, around them
  bool grow = false;                       ///< the box keeps the margin around the cells
  double step = coupling::SubstanceParams{}.longest_step;  ///< s; 0: the step of the tissue
  double tolerance = coupling::SubstanceParams{}.tolerance;
};

/// Exchange of a cell type with one substance.
struct ExchangeEntry : coupling::CellExchange {
  std::string substance;
};

/// Response of cells to a signal.
struct SignalRuleEntry : coupling::SignalRule {
  std::string name;       ///< key "signal": a substance, or a signal of the cell itself
  std::string cell_type;  ///< empty: all
  std::string other;      ///< key "neighbour_type"; empty: all
  std::string exchanged;  ///< key "of"
};

}  // namespace acinus::runs
