#include "runs/session/result_text.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
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
  return fmt::format("deepest overlap of {}: {:.2g} um, {:.2g} % of a radius: {} ({})", what, depth,
                     100 * depth / radius, good ? "good" : "TOO DEEP", limit);
}

}  // namespace

std::string describe_cells(int deformable, int spheres) {
  const std::string a = counted(deformable, "deformable cell", "deformable cells"),
                    b = counted(spheres, "sphere", "spheres");
  return spheres == 0 ? a : deformable == 0 ? b : a + ", " + b;
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
    lines.push_back(verdict("deformable cells", totals.max_penetration_um, radius,
                            totals.max_penetration_um <= limit,
                            fmt::format("contact separates cells up to {:.3g} um deep", limit)));
  }
  if (const double radius = largest_sphere(s); radius > 0) {
    const double depth = totals.max_overlap_cbm_um;
    if (s.divisions > 0)  // sister cells start deep in each other
      lines.push_back(
          fmt::format("deepest overlap of spheres: {:.2g} um, {:.2g} % of a radius "
                      "(daughters start deep in each other)",
                      depth, 100 * depth / radius));
    else
      lines.push_back(verdict("spheres", depth, radius, depth <= kSphereOverlap * radius,
                              fmt::format("limit: {:.0f} %", 100 * kSphereOverlap)));
  }
  if (std::string deep = describe_sphere_overlaps(world, totals); !deep.empty())
    lines.push_back(std::move(deep));
  return lines;
}

std::string advise_viewing(const std::string& folder) {
  return fmt::format(
      "to look at it: acinus report {} makes a page for the browser; ParaView 5.12 or newer opens "
      "run.vtkhdf, older ones run.xmf with \"XDMF Reader\"",
      quote_for_shell(folder));
}

}  // namespace acinus::runs
