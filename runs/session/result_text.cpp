#include "runs/session/result_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "core/sphere.hpp"
#include "runs/session/shell_quote.hpp"
#include "runs/session/sphere_overlaps.hpp"

namespace acinus::runs {
namespace {

std::string counted(std::int64_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// Mean radius of the deformable cells, um.
double mean_deformable_radius(const coupling::State& s) {
  double sum = 0, n = 0;
  for (std::size_t l = 0; l < s.dcm.n_lane(); ++l) {
    if (!s.dcm.active(l)) continue;
    sum += sphere_radius(s.dcm.volume[l].at(s.clock.time));
    ++n;
  }
  return n > 0 ? sum / n : 0;
}

std::string verdict(const std::string& what, double depth, double radius, bool good,
                    const std::string& limit) {
  return fmt::format("deepest overlap of {}: {:.2g} um, {:.2g} % of a radius: {} (limit {})", what,
                     depth, 100 * depth / radius, good ? "good" : "TOO DEEP", limit);
}

/// Partner of the deepest overlap of a deformable cell.
std::string deepest_partner(const RunTotals& t) {
  const std::pair<double, const char*> partners[] = {{t.dcm_dcm_um, "each other"},
                                                     {t.dcm_vessel_um, "vessels"},
                                                     {t.dcm_wall_um, "walls"},
                                                     {t.dcm_cbm_beyond_um, "spheres"}};
  return std::ranges::max_element(partners, {}, [](const auto& p) { return p.first; })->second;
}

/// Verdicts on the overlaps of spheres with each other and with vessels.
void add_sphere_verdicts(const coupling::World& world, const RunTotals& totals,
                         std::vector<std::string>& lines) {
  const double radius = largest_sphere(world), depth = totals.max_overlap_cbm_um;
  if (radius <= 0) return;
  if (world.state.divisions > 0)
    lines.push_back(
        fmt::format("deepest overlap of spheres: {:.2g} um, {:.2g} % of a radius: no verdict "
                    "(daughters start deep in each other)",
                    depth, 100 * depth / radius));
  else
    lines.push_back(verdict("spheres", depth, radius, depth <= kSphereOverlap * radius,
                            fmt::format("{:.0f} %", 100 * kSphereOverlap)));
  if (totals.cbm_vessel_um > 0)
    lines.push_back(verdict("spheres and vessels", totals.cbm_vessel_um, radius,
                            totals.cbm_vessel_um <= kVesselOverlap * radius,
                            fmt::format("{:.0f} %", 100 * kVesselOverlap)));
  if (std::string advice = advise_sphere_overlaps(world, totals); !advice.empty())
    lines.push_back(std::move(advice));
}

}  // namespace

std::string format_duration(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  if (seconds < 120) return fmt::format("{:.0f} s", seconds);
  if (seconds < 7200) return fmt::format("{:.1f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string describe_cells(int deformable, int spheres) {
  const std::string a = counted(deformable, "deformable cell", "deformable cells"),
                    b = counted(spheres, "sphere", "spheres");
  return spheres == 0 ? a : deformable == 0 ? b : a + ", " + b;
}

std::vector<std::string> describe_pressures(const Measures& measures) {
  const auto last = [&](const char* name) {
    const auto found = measures.find(name);
    return found == measures.end() || found->second.empty() ? 0 : found->second.back();
  };
  std::vector<std::string> lines;
  if (last("cells_dcm") > 0)
    lines.push_back(fmt::format(
        "mean pressure of the deformable cells at the end: {:.3g} Pa in the cytosol, {:.3g} Pa at "
        "contacts",
        last("cytosol_pressure_mean_dcm_Pa"), last("contact_pressure_mean_dcm_Pa")));
  if (last("cells_cbm") > 0)
    lines.push_back(fmt::format("mean pressure of the spheres at the end: {:.3g} Pa at contacts",
                                last("contact_pressure_mean_cbm_Pa")));
  return lines;
}

std::vector<std::string> describe_result(const coupling::World& world, const RunTotals& totals,
                                         int start_cells) {
  const coupling::State& s = world.state;
  std::string cells =
      "cells: " + describe_cells(dcm::count_cells(s.dcm), static_cast<int>(s.cbm.n_cell()));
  if (s.divisions + s.deaths > 0)
    cells += fmt::format(" ({} at the start, {}, {})", start_cells,
                         counted(s.divisions, "division", "divisions"),
                         counted(s.deaths, "death", "deaths"));
  std::vector<std::string> lines{std::move(cells)};
  if (const double radius = mean_deformable_radius(s); radius > 0) {
    const double limit = world.params.dcm_contact.max_depth;
    lines.push_back(verdict("deformable cells with " + deepest_partner(totals),
                            totals.max_penetration_um, radius, totals.max_penetration_um <= limit,
                            fmt::format("{:.3g} um, contact.max_depth", limit)));
  }
  add_sphere_verdicts(world, totals, lines);
  return lines;
}

std::string describe_progress(const coupling::World& world, double end) {
  const coupling::Clock& clock = world.state.clock;
  if (clock.phase != coupling::Phase::kRun)
    return fmt::format("after {} of start-up", format_duration(clock.time));
  return fmt::format("at {} of {}", format_duration(coupling::time_since_start(world)),
                     format_duration(end));
}

std::vector<std::string> advise_viewing(const std::string& folder) {
  return {fmt::format("page for the browser: acinus report {}", quote_for_shell(folder)),
          fmt::format("ParaView 5.12 or newer: {}; older: run.xmf with \"XDMF Reader\"",
                      quote_for_shell(folder + "/run.vtkhdf"))};
}

}  // namespace acinus::runs
