#include "runs/session/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "acinus_version.hpp"
#include "core/parallel/machine.hpp"
#include "core/parallel/memory.hpp"
#include "coupling/substances/fields.hpp"
#include "io/disk.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/figures.hpp"
#include "runs/session/sphere_overlaps.hpp"

namespace acinus::runs {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Worst figures of all divisions of deformable cells.
OrderedJson division_figures(const LifeTotals& t) {
  return {{"max_volume_error", finite_number(t.volume_error)},
          {"max_outside_um", finite_number(t.outside_um)},
          {"max_pressure_change_Pa", finite_number(1e3 * t.pressure_change)},
          {"max_settled_shift_um", finite_number(t.settled_shift_um)},
          {"max_settled_pressure_change_Pa", finite_number(1e3 * t.settled_pressure_change)},
          {"min_triangle_quality", finite_number(t.min_quality)},
          {"most_planes", static_cast<int>(t.planes)},
          {"sub_steps", static_cast<int>(t.steps)},
          {"put_off", static_cast<int>(t.waits)}};
}

OrderedJson mesh_figures(const LifeTotals& t) {
  return {{"mended", static_cast<int>(t.remeshed)},
          {"left_degenerate", static_cast<int>(t.degenerate)}};
}

/// Adds identity and outcome of the run.
void add_run(const SummaryInput& in, OrderedJson& j) {
  const coupling::State& s = in.world.state;
  j["scene"] = in.scene.name;
  j["scene_hash"] = in.scene.hash;
  j["version"] = ACINUS_VERSION;
  j["git"] = ACINUS_GIT;
  j["seed"] = in.scene.seed;
  j["status"] = name_of_choice(in.status);
  if (!in.cause.empty()) j["cause"] = in.cause;
  j["simulated_s"] = finite_number(std::max(0.0, coupling::time_since_start(in.world)));
  j["start_up_s"] =
      finite_number(s.clock.phase == coupling::Phase::kRun ? s.clock.origin : s.clock.time);
  if (!in.scene.start_up.from.empty())
    j["start"] = {{"from", in.scene.start_up.from}, {"state_hash", in.scene.start_state}};
}

void add_cost(const SummaryInput& in, OrderedJson& j) {
  const coupling::Clock& clock = in.world.state.clock;
  j["wall_s"] = finite_number(in.totals.wall_s);
  j["cpu_s"] = finite_number(in.totals.cpu_s);
  j["peak_rss_bytes"] = peak_rss_bytes();
  j["ranks"] = in.world.ranks.size();
  j["threads"] = in.threads;
  j["instruction_set"] = std::string(best_instruction_set());
  j["steps"] = {{"accepted", clock.accepted},
                {"rejected", clock.rejected},
                {"shortened", clock.shortened},
                {"solves", clock.solves},
                {"cg", clock.cg_iterations}};
}

void add_cells(const SummaryInput& in, OrderedJson& j) {
  const coupling::State& s = in.world.state;
  const int dcm_cells = dcm::count_cells(s.dcm), cbm_cells = static_cast<int>(s.cbm.n_cell());
  j["cells"] = {{"dcm", dcm_cells},
                {"cbm", cbm_cells},
                {"start", static_cast<int>(in.life.start_cells)},
                {"end", dcm_cells + cbm_cells},
                {"divisions", s.divisions},
                {"deaths", s.deaths}};
  if (dcm_cells > 0 && s.divisions > 0) j["division"] = division_figures(in.life);
  if (in.life.remeshed + in.life.degenerate > 0) j["meshes"] = mesh_figures(in.life);
}

/// Adds the error measures of the run.
void add_errors(const SummaryInput& in, OrderedJson& j) {
  const coupling::State& s = in.world.state;
  const RunTotals& t = in.totals;
  j["balance"] = {{"momentum", finite_number(s.balance.momentum)},
                  {"torque", finite_number(s.balance.torque)},
                  {"friction_torque", finite_number(s.balance.friction_torque)}};
  j["state_hash"] = fmt::format("{:016x}", in.state_hash);
  j["max_penetration_um"] = finite_number(t.max_penetration_um);
  if (s.divisions > 0) j["max_penetration_grown_um"] = finite_number(t.max_penetration_grown_um);
  j["penetration_um"] = {{"dcm_dcm", finite_number(t.dcm_dcm_um)},
                         {"dcm_vessel", finite_number(t.dcm_vessel_um)},
                         {"dcm_wall", finite_number(t.dcm_wall_um)},
                         {"dcm_cbm_beyond_indentation", finite_number(t.dcm_cbm_beyond_um)}};
  j["overlap_of_spheres_um"] = {{"cbm_vessel", finite_number(t.cbm_vessel_um)},
                                {"cbm_wall", finite_number(t.cbm_wall_um)},
                                {"radius", finite_number(in.largest_sphere_um)}};
  j["max_overlap_dcm_cbm_um"] = finite_number(t.dcm_cbm_um);
  j["max_overlap_cbm_um"] = finite_number(t.max_overlap_cbm_um);
  j["min_triangle_quality"] = finite_number(t.min_triangle_quality);
  j["self_intersecting_cells"] = static_cast<int>(t.self_intersecting);
}

/// Amounts of every substance: in the box at the end, gained and lost since t = 0.
OrderedJson list_substances(const coupling::World& world) {
  OrderedJson list = OrderedJson::object();
  const coupling::SubstanceParams& p = world.params.substances;
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const coupling::SubstanceState& field = world.state.substance[k];
    auto [low, high] = std::ranges::minmax(field.concentration);
    for (const double c : field.inside.concentration) {
      low = std::min(low, c);
      high = std::max(high, c);
    }
    list[p.substance[k].name] = {{"unit", p.substance[k].unit},
                                 {"lowest", finite_number(low)},
                                 {"highest", finite_number(high)},
                                 {"amount_um3", finite_number(coupling::amount_of(p, field))},
                                 {"secreted_um3", finite_number(field.secreted)},
                                 {"through_faces_um3", finite_number(field.entered)},
                                 {"from_sources_um3", finite_number(field.supplied)},
                                 {"decayed_um3", finite_number(field.decayed)}};
  }
  return list;
}

OrderedJson list_measures(const SummaryInput& in) {
  OrderedJson measures = OrderedJson::object();
  for (const auto& [name, values] : in.measures) {
    OrderedJson list = OrderedJson::array();
    for (double v : values) list.push_back(finite_number(v));
    measures[name] = list;
  }
  for (const auto& [cells, wall] : wall_times(in.life))
    measures["wall_s_at_cells"][cells] = finite_number(wall);
  if (!in.world.params.boundary.vessels.network.segment.empty())
    measures["max_overlap_with_vessels_um"] =
        finite_number(std::max(in.totals.dcm_vessel_um, in.totals.cbm_vessel_um));
  if (in.world.params.tree.exists())
    measures["largest_vessel_displacement_um"] =
        finite_number(coupling::largest_displacement(in.world.params.tree, in.world.state.tree));
  if (const auto add_figures = experiment_row(in.scene.experiment).add_figures)
    add_figures(in.scene, in.measures, measures);
  return measures;
}

/// Wall time of each stage, s.
OrderedJson wall_of_stages(const std::vector<StageTime>& stages) {
  OrderedJson j = OrderedJson::object();
  for (const StageTime& stage : stages) j[stage.name] = finite_number(stage.wall);
  return j;
}

}  // namespace

void write_summary(const std::string& folder, const SummaryInput& in) {
  OrderedJson j;
  add_run(in, j);
  add_cost(in, j);
  add_cells(in, j);
  j["vessel_length_um"] =
      finite_number(geometry::total_length(in.world.params.boundary.vessels.network));
  add_errors(in, j);
  if (in.world.params.substances.exists()) j["substances"] = list_substances(in.world);
  j["skipped"] = in.skipped;
  j["notes"] = in.notes.info;
  j["warnings"] = in.notes.warnings;
  j["attempts"] = in.attempts.count;
  j["timings"] = wall_of_stages(in.attempts.stages);
  j["timings_last_attempt"] = wall_of_stages(in.timings.stages());
  j["measures"] = list_measures(in);
  io::write_text_file(folder + "/summary.json",
                      j.dump(2, ' ', false, OrderedJson::error_handler_t::replace) + "\n");
}

}  // namespace acinus::runs
