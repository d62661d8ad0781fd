#pragma once
/// Cases of the community benchmark of PerMedCoE (OpenEBench OEBC009), with results as CSV.
/// [https://github.com/PerMedCoE/observatory_benchmark]

#include <string>
#include <vector>

#include "runs/openvt/openvt.hpp"

namespace acinus::runs {

/// Distance of two cells that are pushed together, over time.
struct Pushing {
  std::vector<double> time;      ///< min
  std::vector<double> distance;  ///< um, of the centres
};

/// Runs permedcoe_pushing.
/// @param found  filled, and the result file written, if the run completes
/// @return exit code of the run
int run_pushing(const OpenVtOptions& options, Pushing& found);

/// Size of a growing population over time.
struct Growth {
  std::vector<double> time;      ///< h
  std::vector<double> cells;     ///< number
  std::vector<double> diameter;  ///< um, mean extent along x and y, of surfaces
};

/// Runs permedcoe_monolayer or permedcoe_spheroid.
/// @param what   the scene's name without permedcoe_
/// @param found  filled, and the result file written, if the run completes
/// @return exit code of the run
int run_growth(const std::string& what, const OpenVtOptions& options, Growth& found);

}  // namespace acinus::runs
