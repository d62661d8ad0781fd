/// Experiment "lobule": closing of a central lesion, by its size in several readings, births by
/// layer, speeds, plates and sinusoids. Areas are relative to the first frame that the run
/// observed.

#include "runs/experiments/lobule_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coupling/measure/contact_forces.hpp"
#include "coupling/migration/lesion_layers.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/experiments/lobule_births.hpp"
#include "runs/experiments/plate_thickness.hpp"

namespace acinus::runs {
namespace {

using coupling::CellMeasure;

constexpr double kClosedArea = 0.05;  ///< relative area below which a lesion counts as closed
constexpr double kHour = 3600, kDay = 86400;

/// Value of the first frame.
double first_of(const std::string& name, double now, ObservedRun& o) {
  return o.start.try_emplace(name, now).first->second;
}

double distance_from(const Vec3& axis, const Vec3& x) { return (x - axis).head<2>().norm(); }

std::vector<LesionCell> lesion_cells(const ObservedFrame& frame, const LobuleDomain& lobule) {
  const std::vector<CellMeasure>& cells = frame.snapshot.cells;
  std::vector<coupling::LayerCell> all;
  for (const CellMeasure& c : cells) all.push_back({c.center, lobule.frame.cell_radius});
  const std::vector<int> layer = coupling::compute_layers(all, lobule.axis);
  std::vector<LesionCell> out;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double r = distance_from(lobule.axis, cells[k].center);
    out.push_back({cells[k].center.z(), r,
                   cells[k].deformable ? surface_distance(frame.work.dcm.body[k], lobule.axis)
                                       : r - cells[k].radius,
                   layer[k]});
  }
  return out;
}

void sample_radii(const std::vector<LesionCell>& cells, const LesionFrame& frame, ObservedRun& o) {
  Measures& m = o.measures;
  for (const LesionReading& reading : lesion_readings()) {
    const std::string name = "lesion_radius_" + reading.name + "_um",
                      area = "lesion_area_" + reading.name;
    const double r = lesion_radius(cells, frame, reading), r0 = first_of(name, r, o);
    m[name].push_back(r);
    m[area].push_back(relative_area(r, r0, 0));
    m[area + "_floor"].push_back(relative_area(r, r0, lesion_floor(frame, reading)));
  }
  m["lesion_radius_um"].push_back(m["lesion_radius_slices_centre_um"].back());
  m["lesion_area_relative"].push_back(m["lesion_area_slices_centre_floor"].back());
  m["lesion_area_surface"].push_back(m["lesion_area_slices_surface_floor"].back());
}

/// Endings of series by layer: "1" to "6" and "beyond".
std::vector<std::string> layer_names() {
  std::vector<std::string> names;
  for (int k = 1; k <= kLayers; ++k) names.push_back(std::to_string(k));
  names.emplace_back("beyond");
  return names;
}

void sample_layers(const std::vector<LesionCell>& cells, ObservedRun& o) {
  std::array<double, kLayers + 1> n{};
  for (const LesionCell& c : cells) ++n[std::min(c.layer, kLayers + 1) - 1];
  double births = 0;
  const std::vector<std::string> names = layer_names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    o.measures["cells_layer_" + names[i]].push_back(n[i]);
    o.measures["births_layer_" + names[i]].push_back(o.births[i]);
    births += o.births[i];
  }
  o.measures["births"].push_back(births);
}

/// Open area and front, plates, and the densities that depend on them.
void sample_sections(const ObservedFrame& frame, ObservedRun& o) {
  Measures& m = o.measures;
  const LobuleDomain& lobule = *o.lobule;
  const std::vector<CellMeasure>& cells = frame.snapshot.cells;
  if (!o.grid) {
    const geometry::Network& vessels = coupling::vessels_at_rest(frame.world.params);
    o.grid = make_lesion_grid(lobule, o.start.at("lesion_radius_slices_surface_um"), vessels);
    o.lattice = make_flood_lattice(*o.grid, lobule, vessels);
  }
  std::vector<Ball> balls;
  for (const CellMeasure& c : cells)
    if (!c.deformable) balls.push_back({c.center, c.radius});
  const std::vector<Section> sections = make_sections(frame.work.dcm.body, balls, o.grid->height);

  const Opening opening = measure_opening(*o.grid, sections);
  const auto relative = [&](const std::string& name, double now) {
    const double first = first_of(name, now, o);
    return first > 0 ? now / first : 0;
  };
  m["lesion_area_open_um2"].push_back(opening.area);
  m["lesion_area_open"].push_back(relative("lesion_area_open_um2", opening.area));
  m["lesion_area_seen"].push_back(relative("lesion_area_seen_um2", opening.seen));
  const double flooded = measure_flooded_area(*o.lattice, sections);
  m["lesion_area_flooded_um2"].push_back(flooded);
  m["lesion_area_flooded"].push_back(relative("lesion_area_flooded_um2", flooded));
  m["front_radius_mean_um"].push_back(opening.front);
  m["front_roughness_um"].push_back(opening.roughness);

  const Chords chords = measure_chords(sections);
  m["plate_thickness_um"].push_back(chords.mean);
  m["plate_chords"].push_back(chords.count);

  const double n = static_cast<double>(cells.size()), um3_per_mm3 = 1e9;
  const double tissue = lobule.free_volume - opening.area * lobule.frame.height;
  m["density_per_mm3"].push_back(lobule.free_volume > 0 ? um3_per_mm3 * n / lobule.free_volume : 0);
  m["density_tissue_per_mm3"].push_back(tissue > 0 ? um3_per_mm3 * n / tissue : 0);
}

/// Mean speed toward the axis of the cells that were there at the last frame.
void sample_speeds(const ObservedFrame& frame, ObservedRun& o) {
  double sum[2] = {0, 0}, count[2] = {0, 0}, leaders = 0;
  const double hours = (frame.snapshot.time - o.last_time) / kHour;
  for (const CellMeasure& c : frame.snapshot.cells) {
    leaders += c.leader ? 1 : 0;
    const auto before = o.track.find(c.id);
    if (before == o.track.end() || hours <= 0) continue;
    const std::size_t k = before->second.leader ? 0 : 1;
    sum[k] += (distance_from(o.lobule->axis, before->second.center) -
               distance_from(o.lobule->axis, c.center)) /
              hours;
    ++count[k];
  }
  o.measures["leaders"].push_back(leaders);
  for (const std::size_t k : {0U, 1U}) {
    const std::string name = k == 0 ? "leader_speed_" : "follower_speed_";
    o.measures[name + "um_h"].push_back(count[k] > 0 ? sum[k] / count[k] : 0);
    o.measures[name + "cells"].push_back(count[k]);
  }
}

void sample_sinusoids(const ObservedFrame& frame, ObservedRun& o) {
  const LobuleDomain& lobule = *o.lobule;
  const coupling::Reactions r = coupling::compute_reactions(frame.world, frame.work);
  double area = 0;
  for (std::size_t s = 0; s < lobule.sinusoid.size(); ++s)
    if (lobule.sinusoid[s] != 0) area += r.of(contact::Partner::kVessel)[s].area;
  std::vector<Vec3> centers;
  for (const CellMeasure& c : frame.snapshot.cells) centers.push_back(c.center);
  o.measures["sinusoid_contact_area_um2"].push_back(area);
  o.measures["sinusoid_contact_area_per_cell_um2"].push_back(
      centers.empty() ? 0 : area / static_cast<double>(centers.size()));
  o.measures["sinusoid_distance_um"].push_back(
      mean_distance(centers, frame.world.params.boundary.vessels.network, lobule.sinusoid));
}

void sample_lobule(const ObservedFrame& frame, ObservedRun& o) {
  if (!o.lobule) {
    contact::Vessels vessels;
    contact::set_network(vessels, coupling::vessels_at_rest(frame.world.params));
    o.lobule = make_lobule_domain(frame.scene, vessels);
  }
  const std::vector<LesionCell> cells = lesion_cells(frame, *o.lobule);
  o.measures["time_d"].push_back(frame.snapshot.time / kDay);
  sample_radii(cells, o.lobule->frame, o);
  sample_layers(cells, o);
  sample_sections(frame, o);
  sample_speeds(frame, o);
  sample_sinusoids(frame, o);
  double pressure = 0;
  for (const CellMeasure& c : frame.snapshot.cells) pressure += c.pressure;
  o.measures["mean_pressure_Pa"].push_back(1e3 * pressure /
                                           std::max<double>(1, static_cast<double>(cells.size())));
}

/// Columns of the size of the lesion.
std::vector<Observable> lesion_columns() {
  std::vector<Observable> list{
      {"lesion_radius_um", "um", "lesion radius: the same as lesion_radius_slices_centre_um"},
      {"lesion_area_relative", "1",
       "relative lesion area, the measure of closing to use (closed: below 0.05): the same as "
       "lesion_area_slices_centre_floor. For uncovered space use lesion_area_flooded"},
      {"lesion_area_surface", "1",
       "relative lesion area by surfaces: the same as lesion_area_slices_surface_floor"}};
  for (const LesionReading& r : lesion_readings())
    append(
        list,
        {{fmt::format("lesion_radius_{}_um", r.name), "um", "lesion radius r, " + r.meaning},
         {"lesion_area_" + r.name, "1", "(r / r0)^2, r0 = r of the first frame; r: " + r.meaning},
         {"lesion_area_" + r.name + "_floor", "1",
          "((r - floor) / (r0 - floor))^2, floor = r of a lesion that is closed; r: " +
              r.meaning}});
  append(
      list,
      {{"lesion_area_open_um2", "um^2",
        "horizontal area inside the initial lesion outside vessels that no cell covers, mean "
        "over height"},
       {"lesion_area_open", "1", "lesion_area_open_um2 relative to the first frame"},
       {"front_radius_mean_um", "um",
        "mean over angle and height of the distance from the axis to the first cell surface, "
        "capped at one cell diameter beyond the initial lesion"},
       {"front_roughness_um", "um",
        "standard deviation of the distance that front_radius_mean_um averages"},
       {"lesion_area_seen", "1", "area within front_radius_mean_um relative to the first frame"},
       {"lesion_area_flooded_um2", "um^2",
        "horizontal area inside the initial lesion that is connected to the central vein through "
        "cubes of one cell radius of which cells cover less than half, mean over height"},
       {"lesion_area_flooded", "1", "lesion_area_flooded_um2 relative to the first frame"}});
  return list;
}

std::vector<Observable> lobule_columns() {
  std::vector<Observable> list = lesion_columns();
  for (const std::string& layer : layer_names()) {
    const std::string place =
        layer == "beyond" ? fmt::format("beyond layer {}", kLayers) : "in layer " + layer;
    append(list, {{"cells_layer_" + layer, "1",
                   fmt::format("cells {}, counted from the edge of the lesion", place)},
                  {"births_layer_" + layer, "1",
                   fmt::format("divisions so far {}; layers as life.proliferation counts them, if "
                               "the scene has it",
                               place)}});
  }
  append(
      list,
      {{"births", "1", "divisions so far in all layers"},
       {"density_per_mm3", "1/mm^3", "cells per volume of the domain outside vessels"},
       {"density_tissue_per_mm3", "1/mm^3", "density_per_mm3 without the open area of the lesion"},
       {"leaders", "1", "number of leaders"},
       {"leader_speed_um_h", "um/h",
        "mean speed toward the axis, since the last frame, of the cells that were leaders then; 0 "
        "without any"},
       {"leader_speed_cells", "1", "number of cells in leader_speed_um_h"},
       {"follower_speed_um_h", "um/h",
        "mean speed toward the axis, since the last frame, of all other cells; 0 without any"},
       {"follower_speed_cells", "1", "number of cells in follower_speed_um_h"},
       {"sinusoid_contact_area_um2", "um^2", "area of cells in contact with sinusoids"},
       {"sinusoid_contact_area_per_cell_um2", "um^2", "area in contact with sinusoids per cell"},
       {"sinusoid_distance_um", "um",
        "mean distance of a cell's centre from the nearest "
        "sinusoid's wall"},
       {"plate_thickness_um", "um",
        "mean length of the pieces of horizontal lines that run through cells"},
       {"plate_chords", "1", "number of pieces in plate_thickness_um"},
       {"mean_pressure_Pa", "Pa", "mean contact pressure of all cells"}});
  return list;
}

void check_lobule_block(const Scene& scene, Report& report) {
  if (!scene.lobule)
    report.add_relation({"/experiment", "/lobule"}, "\"lobule\"",
                        "needs a lobule block (acinus explain lobule)");
}

/// Series by which a lesion counts as closed, the one of `closed_d` first.
std::vector<std::string> closing_areas() {
  std::vector<std::string> names{"lesion_area_relative", "lesion_area_surface", "lesion_area_open",
                                 "lesion_area_seen", "lesion_area_flooded"};
  for (const LesionReading& r : lesion_readings())
    for (const char* ending : {"", "_floor"}) names.push_back("lesion_area_" + r.name + ending);
  return names;
}

/// Cells and births of every layer at the end, the last: deeper; and the closing time of the lesion
/// by every measure of its area, null if it did not close.
void add_lobule_figures(const Scene&, const Measures& m, nlohmann::ordered_json& figures) {
  for (const char* counted : {"cells", "births"})
    for (const std::string& layer : layer_names())
      if (const auto n = m.find(std::string(counted) + "_layer_" + layer); n != m.end())
        figures["layers"][counted].push_back(finite_number(n->second.back()));
  const auto time = m.find("time_d");
  nlohmann::ordered_json by_area = nlohmann::ordered_json::object();
  for (const std::string& name : closing_areas()) {
    const auto area = m.find(name);
    if (area == m.end() || time == m.end()) continue;
    by_area[name] = finite_number(closing_time(time->second, area->second));
  }
  figures["closed_d"] = by_area.value(closing_areas().front(), nlohmann::ordered_json(nullptr));
  figures["closed_d_by_area"] = by_area;
}

}  // namespace

std::optional<double> closing_time(const std::vector<double>& time_d,
                                   const std::vector<double>& area) {
  for (std::size_t k = 0; k < std::min(time_d.size(), area.size()); ++k) {
    if (area[k] >= kClosedArea) continue;
    if (k == 0) return time_d[0];
    const double share = (area[k - 1] - kClosedArea) / (area[k - 1] - area[k]);
    return time_d[k - 1] + share * (time_d[k] - time_d[k - 1]);
  }
  return {};
}

const ExperimentRow lobule_experiment{.meaning = "closing of a lesion in a liver lobule",
                                      .check = check_lobule_block,
                                      .columns = lobule_columns,
                                      .sample = sample_lobule,
                                      .count_births = count_births_by_layer,
                                      .add_figures = add_lobule_figures};

}  // namespace acinus::runs
