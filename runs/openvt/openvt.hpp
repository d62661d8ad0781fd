#pragma once
/// The first reference models of OpenVT, run with cells of this program and written as its
/// participants exchange them. [OpenVT: https://www.openvt.org]

#include <optional>
#include <string>
#include <vector>

namespace acinus::runs {

struct OpenVtOptions {
  std::string model = "cbm";     ///< "cbm" or "dcm"
  std::vector<std::string> set;  ///< PATH=VALUE
  std::string out;               ///< run folder; of monolayer: folder of its two runs
  std::string csv;               ///< "" = none
  int threads = 0;               ///< 0 = all cores
  bool overwrite = false, resume = false, quiet = false;
  std::optional<int> cells;  ///< monolayer: until there are so many; empty = those of the scene
  std::string command_line;
};

/// Length of the row from centre to centre over time.
struct RowLength {
  std::vector<double> time;   ///< s
  std::vector<double> width;  ///< in diameters
};

/// Runs openvt_relax11.
/// @return exit code of the run; `found` and the file are there when it is 0
/// @throws Error as `acinus run` does; where the row does not get to 90 % of its length
int run_relaxation(const OpenVtOptions& options, RowLength& found);
/// s, when the row has nine of ten diameters, between frames on a straight line.   @throws Error
double time_to_90_percent(const RowLength& row);

/// Of one cell of the layer, seen from above as a disc.
struct Disc {
  double x = 0, y = 0, radius = 0;  ///< um
};
/// Share of its rim, and of its area, that no other disc covers.
struct FreeShares {
  double rim = 1, area = 1;
};
/// To 1e-3, by sampling.
std::vector<FreeShares> free_shares(const std::vector<Disc>& discs);

struct Layer {
  double cycle = 0;              ///< s, five times that to 90 %
  std::vector<Disc> cell;        ///< at the end
  std::vector<FreeShares> free;  ///< of deformable cells the rim is that of their surface
};

/// Runs openvt_relax11, then openvt_monolayer with five times its time as cycle.
/// @return exit code of the last run; `found` and the file are there when it is 0
int run_monolayer(const OpenVtOptions& options, Layer& found);

}  // namespace acinus::runs
