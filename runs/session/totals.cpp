#include "runs/session/totals.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <type_traits>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

double count_of(std::size_t k) { return std::pow(10.0, static_cast<double>(k) + 1); }

/// Prefixes of the names in the checkpoint.
const std::string kTotals = "totals/", kLife = "life_totals/";

/// Calls f(name, value) for every number of the totals.
template <class Totals, class F>
void visit(Totals& t, F f) requires std::same_as<std::remove_const_t<Totals>, RunTotals> {
  f("wall_s", t.wall_s);
  f("cpu_s", t.cpu_s);
  f("max_penetration_um", t.max_penetration_um);
  f("max_penetration_grown_um", t.max_penetration_grown_um);
  f("dcm_dcm_um", t.dcm_dcm_um);
  f("dcm_vessel_um", t.dcm_vessel_um);
  f("dcm_wall_um", t.dcm_wall_um);
  f("dcm_cbm_um", t.dcm_cbm_um);
  f("cbm_vessel_um", t.cbm_vessel_um);
  f("cbm_wall_um", t.cbm_wall_um);
  f("dcm_cbm_beyond_um", t.dcm_cbm_beyond_um);
  f("max_overlap_cbm_um", t.max_overlap_cbm_um);
  f("min_triangle_quality", t.min_triangle_quality);
  f("self_intersecting", t.self_intersecting);
  f("inverted", t.inverted);
}

template <class Totals, class F>
void visit(Totals& t, F f) requires std::same_as<std::remove_const_t<Totals>, LifeTotals> {
  f("start_cells", t.start_cells);
  f("volume_error", t.volume_error);
  f("outside_um", t.outside_um);
  f("settled_shift_um", t.settled_shift_um);
  f("pressure_change_kPa", t.pressure_change);
  f("settled_pressure_change_kPa", t.settled_pressure_change);
  f("planes", t.planes);
  f("steps", t.steps);
  f("waits", t.waits);
  f("min_quality", t.min_quality);
  f("remeshed", t.remeshed);
  f("degenerate", t.degenerate);
}

}  // namespace

void add_life(LifeTotals& t, const coupling::LifeReport& report, int n_cell, double wall_s) {
  for (std::size_t k = 0; k < t.wall_s_at.size(); ++k)
    if (t.wall_s_at[k] == 0 && n_cell >= count_of(k)) t.wall_s_at[k] = wall_s;
  for (const coupling::DivisionFigures& f : report.divisions) {
    t.volume_error = std::max(t.volume_error, f.volume_error);
    t.outside_um = std::max(t.outside_um, f.outside);
    t.settled_shift_um = std::max(t.settled_shift_um, f.settled_shift);
    t.settled_pressure_change = std::max(t.settled_pressure_change, f.settled_pressure_change);
    t.pressure_change = std::max(t.pressure_change, f.pressure_change);
    t.planes = std::max(t.planes, static_cast<double>(f.planes));
    t.min_quality = std::min(t.min_quality, f.min_quality);
    t.steps += f.steps;
  }
  for (const coupling::LifeEvent& e : report.events) {
    if (e.kind == coupling::EventKind::kDivisionWaits) t.waits += 1;
    if (e.kind == coupling::EventKind::kRemeshed) t.remeshed += 1;
    if (e.kind == coupling::EventKind::kMeshDegenerate) t.degenerate += 1;
  }
}

void add_audit(RunTotals& t, const coupling::AuditResult& a) {
  t.max_penetration_um = std::max(t.max_penetration_um, a.max_penetration_um);
  t.max_penetration_grown_um = std::max(t.max_penetration_grown_um, a.max_penetration_grown_um);
  t.dcm_dcm_um = std::max(t.dcm_dcm_um, a.dcm_dcm.depth_um);
  t.dcm_vessel_um = std::max(t.dcm_vessel_um, a.dcm_vessel.depth_um);
  t.dcm_wall_um = std::max(t.dcm_wall_um, a.dcm_wall.depth_um);
  t.cbm_vessel_um = std::max(t.cbm_vessel_um, a.cbm_vessel.depth_um);
  t.cbm_wall_um = std::max(t.cbm_wall_um, a.cbm_wall.depth_um);
  t.dcm_cbm_um = std::max(t.dcm_cbm_um, a.dcm_cbm.depth_um);
  t.dcm_cbm_beyond_um = std::max(t.dcm_cbm_beyond_um, a.dcm_cbm_beyond_indentation.depth_um);
  t.max_overlap_cbm_um = std::max(t.max_overlap_cbm_um, a.max_overlap_cbm_um);
  t.min_triangle_quality = std::min(t.min_triangle_quality, a.min_triangle_quality);
  t.self_intersecting = std::max(t.self_intersecting, static_cast<double>(a.n_self_intersecting));
  t.inverted = std::max(t.inverted, static_cast<double>(a.n_inverted));
}

void put_totals(const RunTotals& totals, io::CheckpointData& data) {
  visit(totals, [&](const char* name, double value) { data.put_number(kTotals + name, value); });
}

void put_totals(const LifeTotals& totals, io::CheckpointData& data) {
  visit(totals, [&](const char* name, double value) { data.put_number(kLife + name, value); });
  data.put(kLife + "wall_s_at",
           std::vector<double>(totals.wall_s_at.begin(), totals.wall_s_at.end()));
}

void get_totals(const io::CheckpointData& data, RunTotals& totals) {
  visit(totals, [&](const char* name, double& value) { value = data.number(kTotals + name); });
}

void get_totals(const io::CheckpointData& data, LifeTotals& totals) {
  visit(totals, [&](const char* name, double& value) { value = data.number(kLife + name); });
  const std::vector<double>& wall = data.numbers(kLife + "wall_s_at");
  check(wall.size() == totals.wall_s_at.size(),
        data.source() + ": the run's totals of growth are damaged.", Exit::kFileError);
  std::ranges::copy(wall, totals.wall_s_at.begin());
}

std::vector<std::pair<std::string, double>> wall_times(const LifeTotals& t) {
  std::vector<std::pair<std::string, double>> list;
  for (std::size_t k = 0; k < t.wall_s_at.size(); ++k)
    if (t.wall_s_at[k] > 0)
      list.emplace_back(std::to_string(static_cast<long>(count_of(k))), t.wall_s_at[k]);
  return list;
}

}  // namespace acinus::runs
