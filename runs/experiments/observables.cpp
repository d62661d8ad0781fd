#include "runs/experiments/observables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/experiments/experiment.hpp"

namespace acinus::runs {
namespace {

using List = std::vector<Observable>;

List pressures() {
  List list;
  for (const auto& [model, cells] :
       {std::pair("dcm", "deformable cells"), std::pair("cbm", "spheres")})
    for (const std::string kind : {"contact", "cytosol"}) {
      const std::string what = fmt::format("{} pressure of the {}", kind, cells);
      const bool same = kind == "cytosol" && std::string(model) == "cbm";
      const std::string more = same ? ", which is their contact pressure" : "";
      append(list, {{fmt::format("{}_pressure_mean_{}_Pa", kind, model), "Pa",
                     fmt::format("mean {}{}; 0 without any", what, more)},
                    {fmt::format("{}_pressure_max_{}_Pa", kind, model), "Pa",
                     fmt::format("largest {}{}; 0 without any", what, more)}});
    }
  return list;
}

/// Observables of every scene.
List tissue() {
  List list{{"cells", "1", "number of cells"},
            {"cells_dcm", "1", "number of deformable cells"},
            {"cells_cbm", "1", "number of spheres"},
            {"divisions", "1", "divisions so far"},
            {"deaths", "1", "deaths so far"},
            {"slowest_growth", "1", "smallest inhibition factor of any cell (1: none)"},
            {"resting_cells", "1", "cells in the cycle that a rule keeps from growing"}};
  append(list, pressures());
  append(
      list,
      {{"overlap_dcm_dcm_um", "um", "deepest overlap of two deformable cells"},
       {"overlap_dcm_cbm_um", "um", "deepest point of a deformable cell in a round sphere"},
       {"overlap_dcm_cbm_beyond_um", "um",
        "overlap of a deformable cell with a sphere in excess of the indentation that is "
        "expected from their contact force, largest of all pairs"},
       {"overlap_cbm_cbm_um", "um", "deepest overlap of two spheres"},
       {"overlap_dcm_vessels_um", "um", "deepest overlap of a deformable cell with a vessel"},
       {"overlap_cbm_vessels_um", "um", "deepest overlap of a sphere with a vessel"},
       {"overlap_vessels_um", "um", "deepest overlap of a cell with a vessel"},
       {"overlap_dcm_walls_um", "um", "deepest overlap of a deformable cell with a wall"},
       {"overlap_cbm_walls_um", "um", "deepest overlap of a sphere with a wall"},
       {"detached_cells", "1", "cells in contact with no other cell"},
       {"cells_in_small_clusters", "1", "cells in clusters of one or two cells"},
       {"clusters", "1", "clusters of cells in contact, single cells included"},
       {"interface_pairs", "1", "pairs of a deformable cell and a sphere that exert a force"},
       {"interface_force_nN", "nN",
        "sum over pairs of a deformable cell and a sphere of the magnitude of their force"},
       {"interface_residual", "1",
        "resultant of the forces and torques of those pairs over the sum of their magnitudes; 0 in "
        "balance"},
       {"vessels_force_nN", "nN",
        "sum of the normal forces of the cells on the vessels, compression positive"},
       {"vessels_net_x_nN", "nN", "net normal force on the vessels along x"},
       {"vessels_net_y_nN", "nN", "net normal force on the vessels along y"},
       {"vessels_net_z_nN", "nN", "net normal force on the vessels along z"}});
  return list;
}

}  // namespace

std::vector<Observable> known_observables(Experiment experiment) {
  List list = tissue();
  if (const auto columns = experiment_row(experiment).columns) append(list, columns());
  return list;
}

std::string name_in_columns(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
  return name;
}

std::vector<Observable> substance_observables(const std::string& substance,
                                              const std::string& unit) {
  const std::string name = "substance_" + name_in_columns(substance);
  const std::string amount = unit == "1" ? "um^3/s" : unit + " um^3/s";
  return {{name + "_mean", unit, "mean concentration in its box"},
          {name + "_mean_of_cells", unit,
           "mean over the cells of the mean concentration in each; 0 without any"},
          {name + "_lowest_of_cells", unit, "smallest mean concentration in a cell; 0 without any"},
          {name + "_highest_of_cells", unit, "largest mean concentration in a cell; 0 without any"},
          {name + "_exchange", amount, "secretion minus uptake of all cells"}};
}

std::vector<Observable> rule_observables(std::size_t rule) {
  const std::string name = fmt::format("rule_{}", rule);
  return {
      {name + "_response", "1",
       fmt::format("mean response to rule {} of the cells that it is for; a mean over no cells "
                   "is 0",
                   rule)},
      {name + "_cells", "1",
       fmt::format("cells on which rule {} acts: it halves their behaviour or more, or for death "
                   "and chemotaxis its response is above one half",
                   rule)}};
}

std::vector<Observable> wall_observables(const std::string& wall) {
  const std::string name = "wall_" + name_in_columns(wall);
  List list{{name + "_force_nN", "nN",
             "sum of the normal forces of the cells on this wall, compression positive"}};
  for (const char axis : {'x', 'y', 'z'})
    append(list, {{fmt::format("{}_net_{}_nN", name, axis), "nN",
                   fmt::format("net normal force on this wall along {}", axis)}});
  return list;
}

}  // namespace acinus::runs
