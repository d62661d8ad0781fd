/// The registry. It is longer than other files because it is a table.

#include "runs/experiments/observables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/lesion.hpp"
#include "runs/experiments/sample_lobule.hpp"

namespace acinus::runs {
namespace {

using List = std::vector<Observable>;

void append(List& list, const List& more) { list.insert(list.end(), more.begin(), more.end()); }

List pressures() {
  List list;
  for (const auto& [model, cells] :
       {std::pair("dcm", "deformable cells"), std::pair("cbm", "spheres")})
    for (const auto& [kind, what] :
         {std::pair("contact_pressure", "contact pressure"),
          std::pair("cytosol_pressure", "pressure within (of spheres: contact pressure)")})
      append(list, {{fmt::format("{}_mean_{}_Pa", kind, model), "Pa",
                     fmt::format("mean {} of the {}; 0 without any", what, cells)},
                    {fmt::format("{}_max_{}_Pa", kind, model), "Pa",
                     fmt::format("largest {} of the {}; 0 without any", what, cells)}});
  return list;
}

/// Of every scene.
List tissue() {
  List list{{"cells", "1", "number of cells"},
            {"cells_dcm", "1", "number of deformable cells"},
            {"cells_cbm", "1", "number of spheres"},
            {"divisions", "1", "divisions so far"},
            {"deaths", "1", "deaths so far"}};
  append(list, pressures());
  append(
      list,
      {{"overlap_dcm_dcm_um", "um", "deepest overlap of two deformable cells"},
       {"overlap_dcm_cbm_um", "um", "deepest point of a deformable cell in a round sphere"},
       {"overlap_dcm_cbm_beyond_um", "um", "the same beyond the indentation their force explains"},
       {"overlap_cbm_cbm_um", "um", "deepest overlap of two spheres"},
       {"overlap_dcm_vessels_um", "um", "deepest overlap of a deformable cell with a vessel"},
       {"overlap_cbm_vessels_um", "um", "deepest overlap of a sphere with a vessel"},
       {"overlap_vessels_um", "um", "deepest overlap of a cell with a vessel"},
       {"overlap_dcm_walls_um", "um", "deepest overlap of a deformable cell with a wall"},
       {"overlap_cbm_walls_um", "um", "deepest overlap of a sphere with a wall"},
       {"detached_cells", "1", "cells in contact with no other cell"},
       {"cells_in_small_clusters", "1", "cells that hang together in clusters of 1 or 2"},
       {"clusters", "1", "clusters of cells in contact, single cells included"},
       {"interface_pairs", "1", "pairs of a deformable cell and a sphere that exert a force"},
       {"interface_force_nN", "nN", "sum over those pairs of the size of their force"},
       {"interface_residual", "1",
        "what their forces and torques, spread over nodes and spheres, leave, over the sum of "
        "their sizes"},
       {"vessels_force_nN", "nN", "normal force of the cells on the vessels, pressing positive"},
       {"vessels_net_x_nN", "nN", "net normal force on the vessels along x"},
       {"vessels_net_y_nN", "nN", "net normal force on the vessels along y"},
       {"vessels_net_z_nN", "nN", "net normal force on the vessels along z"}});
  return list;
}

List capsule() {
  return {{"capsule_radius_um", "um", "radius of the capsule; 0 once it is open"},
          {"overlap", "1", "relative overlap d of the cell nearest the centre"},
          {"shell_overlap", "1", "mean d of the 14 cells nearest to it"},
          {"contact_force_nN", "nN", "sum of the sizes of the forces on that cell"},
          {"normal_force_nN", "nN", "sum of the normal forces on it, pressing positive"},
          {"contacts", "1", "cells in contact with it"},
          {"pressure_Pa", "Pa", "its contact pressure"},
          {"volume_relative", "1", "its volume over its reference volume"}};
}

List relaxation() {
  return {{"overlap", "1", "mean relative overlap of a cell and its 14 nearest, over all cells"},
          {"height_um", "um", "extent of the clump along the axis of compression"},
          {"width_um", "um", "extent of the clump across it"}};
}

List patch() {
  return {{"box_length_um", "um", "distance of the walls across x"},
          {"pressure_dcm_Pa", "Pa", "mean contact pressure of the deformable half; 0 without"},
          {"pressure_cbm_Pa", "Pa", "mean contact pressure of the half of spheres; 0 without"},
          {"density_dcm_per_mm3", "1/mm^3", "density of the deformable half; 0 without"},
          {"density_cbm_per_mm3", "1/mm^3", "density of the half of spheres; 0 without"}};
}

List growth(bool flat) {
  const char* density = flat ? "1/mm^2" : "1/mm^3";
  List list{
      {"radius_of_gyration_um", "um", "sqrt(1/N sum |x_i - x_com|^2) of the cells' centres"},
      {"mean_pressure_Pa", "Pa", "mean contact pressure"},
      {"mean_cytosol_pressure_Pa", "Pa", "mean pressure within, the paper's pressure"},
      {"inner_cells", "1", "cells below 1/3 of the largest distance from the middle"},
      {"inner_pressure_Pa", "Pa", "their mean contact pressure"},
      {"inner_cytosol_pressure_Pa", "Pa", "their mean pressure within"},
      {"inner_density", density, "their density"},
      {"outer_cells", "1", "cells from 2/3 of the largest distance on"},
      {"outer_pressure_Pa", "Pa", "their mean contact pressure"},
      {"outer_cytosol_pressure_Pa", "Pa", "their mean pressure within"},
      {"outer_density", density, "their density"},
      {"sphericity", "1", "mean pi^(1/3) (6 V)^(2/3) / A of the deformable cells; 0 without"}};
  if (flat)
    append(list, {{"height_um", "um", "mean height of the deformable cells; 0 without"},
                  {"height_to_width", "1", "mean ratio of their height to their width"}});
  append(list, {{"shell_width_um", "um", "width of each of the ten shells (rings)"}});
  for (int k = 1; k <= kShells; ++k)
    append(list,
           {{fmt::format("shell_{}_cells", k), "1", fmt::format("cells in shell {}", k)},
            {fmt::format("shell_{}_cytosol_pressure_Pa", k), "Pa", "their mean pressure within"},
            {fmt::format("shell_{}_contact_pressure_Pa", k), "Pa", "their mean contact pressure"},
            {fmt::format("shell_{}_density", k), density, "their density"}});
  return list;
}

List stretcher() {
  return {{"long_axis_um", "um", "extent of the cell along the beams"},
          {"short_axis_um", "um", "mean extent across them"},
          {"long_axis_strain", "1", "growth of the former since the first frame, relative"},
          {"short_axis_strain", "1", "the same of the latter"},
          {"stress_Pa", "Pa", "stress where the axis of the beams meets the cell"},
          {"cortex_friction_factor", "1", "friction of the cortex over that of the cell type"}};
}

List plates() {
  return {
      {"gap_um", "um", "distance of the plates"},
      {"force_nN", "nN", "normal force on a plate, mean of the two"},
      {"contact_radius_um", "um",
       "radius of a circle as large as the area in touch with a plate, mean of the two"},
      {"cytosol_pressure_Pa", "Pa", "pressure within the cell"},
      {"shell_force_nN", "nN", "force on a thin shell that keeps its volume, at this distance"}};
}

List aspiration() {
  return {{"suction_Pa", "Pa", "by how much the pressure in the pipette is below that outside"},
          {"aspirated_length_um", "um", "how far the cell reaches beyond the pipette's mouth"}};
}

List narrow_gap() {
  return {{"position_um", "um", "the cell's centre along the axis of the hole, from its mouth"},
          {"length_um", "um", "extent of the cell along the axis"},
          {"width_um", "um", "mean extent across it"},
          {"waist_um", "um",
           "diameter of a circle as large as the cell's section halfway through the hole"},
          {"passed", "1", "1 once all of the cell is beyond the hole"}};
}

List pull_off() {
  return {{"pull_force_nN", "nN", "force that pulls the two cells apart, mean of the two"},
          {"pull_force_relative", "1", "the same over pi W R1 R2 / (R1 + R2), that of vesicles"},
          {"distance_um", "um", "distance of their centres"},
          {"contact_area_um2", "um^2", "area in contact, half of it from either cell"},
          {"contact_radius_um", "um", "radius of a circle as large"},
          {"tension_outside_mN_m", "mN/m", "mean tension of the surface out of contact"},
          {"tension_contact_mN_m", "mN/m", "the same in contact; 0 without contact"},
          {"tension_contact_min_mN_m", "mN/m", "least tension in contact; 0 without contact"}};
}

List lesion() {
  List list{{"lesion_radius_um", "um", "as lesion_radius_slices_centre_um"},
            {"lesion_area_relative", "1", "as lesion_area_slices_centre_floor"},
            {"lesion_area_surface", "1", "as lesion_area_slices_surface_floor"}};
  for (const LesionReading& r : lesion_readings())
    append(list, {{fmt::format("lesion_radius_{}_um", r.name), "um", "lesion radius, " + r.meaning},
                  {"lesion_area_" + r.name, "1", "(r / r0)^2, " + r.meaning},
                  {"lesion_area_" + r.name + "_floor", "1",
                   "((r - floor) / (r0 - floor))^2, " + r.meaning}});
  append(
      list,
      {{"lesion_area_open_um2", "um^2",
        "horizontal area inside the initial lesion outside vessels that no cell covers, mean "
        "over height"},
       {"lesion_area_open", "1", "the same relative to the first frame"},
       {"front_radius_mean_um", "um",
        "mean over angle and height of the distance from the axis to the first cell surface, "
        "one cell diameter beyond the initial lesion at most"},
       {"front_roughness_um", "um", "standard deviation of that distance"},
       {"lesion_area_seen", "1", "area up to that distance relative to the first frame"},
       {"lesion_area_flooded_um2", "um^2",
        "horizontal area inside the initial lesion that is connected to the central vein through "
        "cubes of one cell radius of which cells cover less than half, mean over height"},
       {"lesion_area_flooded", "1", "the same relative to the first frame"}});
  for (const std::string& layer : layer_names()) {
    append(list,
           {{"cells_layer_" + layer, "1", "cells in this layer from the lesion's edge"},
            {"births_layer_" + layer, "1",
             "divisions so far in this layer when they happened, counted as life.proliferation "
             "counts layers if the scene has it"}});
  }
  append(list,
         {{"births", "1", "divisions so far in all layers"},
          {"density_per_mm3", "1/mm^3", "cells per volume of the domain outside vessels"},
          {"density_tissue_per_mm3", "1/mm^3", "the same without the open area of the lesion"},
          {"leaders", "1", "cells that lead"},
          {"leader_speed_um_h", "um/h",
           "mean speed toward the axis of those that led at the last "
           "frame; 0 without"},
          {"leader_speed_cells", "1", "their number"},
          {"follower_speed_um_h", "um/h", "mean speed toward the axis of all others; 0 without"},
          {"follower_speed_cells", "1", "their number"},
          {"sinusoid_contact_area_um2", "um^2", "area of cells in touch with sinusoids"},
          {"sinusoid_contact_area_per_cell_um2", "um^2", "the same per cell"},
          {"sinusoid_distance_um", "um",
           "mean distance of a cell's centre from the nearest "
           "sinusoid's wall"},
          {"plate_thickness_um", "um",
           "mean length of the pieces of horizontal lines that run through cells"},
          {"plate_chords", "1", "number of such pieces"},
          {"mean_pressure_Pa", "Pa", "mean contact pressure of all cells"}});
  return list;
}

}  // namespace

std::vector<Observable> known_observables(Experiment experiment) {
  List list = tissue();
  switch (experiment) {
    case Experiment::kFree:
      break;
    case Experiment::kLobule:
      append(list, lesion());
      break;
    case Experiment::kPatch:
      append(list, patch());
      break;
    case Experiment::kCapsule:
      append(list, capsule());
      break;
    case Experiment::kRelaxation:
      append(list, relaxation());
      break;
    case Experiment::kSpheroid:
    case Experiment::kMonolayer:
      append(list, growth(experiment == Experiment::kMonolayer));
      break;
    case Experiment::kOpticalStretcher:
      append(list, stretcher());
      break;
    case Experiment::kPlates:
      append(list, plates());
      break;
    case Experiment::kAspiration:
      append(list, aspiration());
      break;
    case Experiment::kNarrowGap:
      append(list, narrow_gap());
      break;
    case Experiment::kPullOff:
      append(list, pull_off());
      break;
  }
  return list;
}

std::string name_in_columns(std::string name) {
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '.') c = '_';
  return name;
}

std::vector<Observable> wall_observables(const std::string& wall) {
  const std::string name = "wall_" + name_in_columns(wall);
  List list{
      {name + "_force_nN", "nN", "normal force of the cells on this wall, pressing positive"}};
  for (const char axis : {'x', 'y', 'z'})
    append(list, {{fmt::format("{}_net_{}_nN", name, axis), "nN",
                   fmt::format("net normal force on this wall along {}", axis)}});
  return list;
}

}  // namespace acinus::runs
