#pragma once
/// Reference models of OpenVT, with results in its exchange formats. [OpenVT:
/// https://www.openvt.org]

#include <optional>
#include <string>
#include <vector>

#include "runs/scene/choices.hpp"

namespace acinus::runs {

/// Options of a reference model.
struct OpenVtOptions {
  CellModel model = CellModel::kCbm;
  std::vector<std::string> set;  ///< changes of the scene, PATH=VALUE
  std::string out;               ///< run folder; of monolayer: parent of its two runs
  std::string csv;               ///< result file; "" = none
  int threads = 0;               ///< 0 = all cores
  bool overwrite = false, resume = false, quiet = false;
  std::optional<int> cells;  ///< monolayer: number of cells at the end; empty = as in the scene
  std::string command_line;
};

/// Length of the row of cells over time, between the outermost centres.
struct RowLength {
  std::vector<double> time;   ///< s
  std::vector<double> width;  ///< cell diameters
};

/// Runs the scene openvt_relax11.
/// @param found  filled, and the result file written, if the run completes
/// @return exit code of the run
/// @throws Error as `acinus run` does, or if the row does not reach 90 % of its length
int run_relaxation(const OpenVtOptions& options, RowLength& found);
/// Time at which the row reaches nine of its ten diameters, interpolated linearly between frames,
/// s.
/// @throws Error if it never does
double time_to_90_percent(const RowLength& row);

/// Disc of one cell of the layer in top view.
struct Disc {
  double x = 0, y = 0, radius = 0;  ///< um
};
/// Shares of a disc's rim and area that no other disc covers.
struct FreeShares {
  double rim = 1, area = 1;
};
/// Free shares of every disc, by sampling to 1e-3.
std::vector<FreeShares> free_shares(const std::vector<Disc>& discs);

/// Cells of the monolayer at its end.
struct Layer {
  double cycle = 0;        ///< cell cycle, five relaxation times of the row, s
  std::vector<Disc> cell;  ///< at the end of the run
  /// [cell]; of deformable cells the share of the surface without contact
  std::vector<FreeShares> free;
};

/// Runs openvt_relax11, then openvt_monolayer with five of its relaxation times as cell cycle.
/// @param found  filled, and the result file written, if both runs complete
/// @return exit code of the last run
int run_monolayer(const OpenVtOptions& options, Layer& found);

/// Share of the pairs of cells in contact whose types differ, over time.
struct MixedShare {
  std::vector<double> time;   ///< in the workshop's unit: an isolated cell moves its diameter
                              ///< squared, in the mean of squares, in a hundred of them
  std::vector<double> mixed;  ///< [frame]
};

/// Runs openvt_sorting, openvt_engulfment or openvt_checkerboard, of OpenVT's workshop of 2026.
/// @param what   the scene's name without openvt_
/// @param found  filled, and the result file written, if the run completes
/// @return exit code of the run
int run_sorting(const std::string& what, const OpenVtOptions& options, MixedShare& found);

}  // namespace acinus::runs
