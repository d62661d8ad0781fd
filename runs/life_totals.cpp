#include "runs/life_totals.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

double count_of(std::size_t k) { return std::pow(10.0, static_cast<double>(k) + 1); }

constexpr std::size_t kNumbers = 12;

}  // namespace

void add_life(LifeTotals& t, const coupling::LifeReport& report, int n_cell, double wall_s) {
  for (std::size_t k = 0; k < t.wall_s_at.size(); ++k)
    if (t.wall_s_at[k] == 0 && n_cell >= count_of(k)) t.wall_s_at[k] = wall_s;
  for (const coupling::DivisionFigures& f : report.divisions) {
    t.volume_error = std::max(t.volume_error, f.volume_error);
    t.outside_um = std::max(t.outside_um, f.outside);
    t.settled_shift_um = std::max(t.settled_shift_um, f.settled_shift);
    t.settled_pressure_change_kPa =
        std::max(t.settled_pressure_change_kPa, f.settled_pressure_change);
    t.pressure_change_kPa = std::max(t.pressure_change_kPa, f.pressure_change);
    t.planes = std::max(t.planes, static_cast<double>(f.planes));
    t.min_quality = std::min(t.min_quality, f.min_quality);
    t.steps += f.steps;
  }
  for (const coupling::LifeEvent& e : report.events) {
    if (e.code == "division_waits") t.waits += 1;
    if (e.code == "remeshed") t.remeshed += 1;
    if (e.code == "mesh_degenerate") t.degenerate += 1;
  }
}

void put_totals(const LifeTotals& t, io::CheckpointData& data) {
  data.put("life/totals",
           std::vector<double>{t.start_cells, t.volume_error, t.outside_um, t.settled_shift_um,
                               t.pressure_change_kPa, t.planes, t.steps, t.waits, t.min_quality,
                               t.settled_pressure_change_kPa, t.remeshed, t.degenerate});
  data.put("life/wall_s_at", std::vector<double>(t.wall_s_at.begin(), t.wall_s_at.end()));
}

LifeTotals get_totals(const io::CheckpointData& data) {
  LifeTotals t;
  const std::vector<double>& v = data.numbers("life/totals");
  const std::vector<double>& wall = data.numbers("life/wall_s_at");
  check(v.size() == kNumbers && wall.size() == t.wall_s_at.size(),
        data.source() + ": the run's totals of growth are damaged.", Exit::kFileError);
  t.start_cells = v[0];
  t.volume_error = v[1];
  t.outside_um = v[2];
  t.settled_shift_um = v[3];
  t.pressure_change_kPa = v[4];
  t.planes = v[5];
  t.steps = v[6];
  t.waits = v[7];
  t.min_quality = v[8];
  t.settled_pressure_change_kPa = v[9];
  t.remeshed = v[10];
  t.degenerate = v[11];
  std::ranges::copy(wall, t.wall_s_at.begin());
  return t;
}

std::vector<std::pair<std::string, double>> wall_times(const LifeTotals& t) {
  std::vector<std::pair<std::string, double>> list;
  for (std::size_t k = 0; k < t.wall_s_at.size(); ++k)
    if (t.wall_s_at[k] > 0)
      list.emplace_back(std::to_string(static_cast<long>(count_of(k))), t.wall_s_at[k]);
  return list;
}

}  // namespace acinus::runs
