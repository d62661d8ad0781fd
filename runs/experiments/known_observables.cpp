#include "runs/experiments/known_observables.hpp"

namespace acinus::runs {
namespace {
using Units = std::map<std::string, std::string>;

Units growth_units(bool flat) {
  const char* density = flat ? "1/mm^2" : "1/mm^3";
  Units units{{"cells", "1"},
              {"radius_of_gyration", "um"},
              {"mean_pressure", "Pa"},
              {"inner_pressure", "Pa"},
              {"outer_pressure", "Pa"},
              {"inner_cytosol_pressure", "Pa"},
              {"outer_cytosol_pressure", "Pa"},
              {"inner_density", density},
              {"outer_density", density},
              {"sphericity", "1"}};
  if (flat) units.insert({{"height", "um"}, {"height_to_width", "1"}});
  return units;
}

Units units_of(const std::string& experiment) {
  if (experiment == "lobule")
    return {{"cells", "1"},
            {"lesion_radius", "um"},
            {"lesion_area_relative", "1"},
            {"mean_pressure", "Pa"}};
  if (experiment == "patch")
    return {{"box_length", "um"},
            {"pressure_dcm", "Pa"},
            {"pressure_cbm", "Pa"},
            {"density_dcm", "1/mm^3"},
            {"density_cbm", "1/mm^3"}};
  if (experiment == "capsule")
    return {{"capsule_radius", "um"}, {"overlap", "1"},       {"shell_overlap", "1"},
            {"contact_force", "nN"},  {"normal_force", "nN"}, {"contacts", "1"},
            {"pressure", "Pa"},       {"volume_relative", "1"}};
  if (experiment == "spheroid" || experiment == "monolayer")
    return growth_units(experiment == "monolayer");
  return {};
}

}  // namespace

std::map<std::string, std::string> known_observables(const std::string& experiment) {
  Units units{{"dt", "s"},           {"dcm_cells", "1"},        {"cbm_cells", "1"},
              {"asleep", "1"},       {"max_move", "um"},        {"error", "um"},
              {"rejections", "1"},   {"cg_iterations", "1"},    {"balance_momentum", "1"},
              {"balance_torque", "1"}};
  units.merge(units_of(experiment));
  return units;
}

}  // namespace acinus::runs
