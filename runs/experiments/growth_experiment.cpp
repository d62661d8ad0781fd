/// Experiments "spheroid", tissue that grows in space, and "monolayer", in the plane z = const.
///
/// Distances r are those of the cells' centres from their mean, in a monolayer horizontally.
/// Pressures are mean contact pressures and cytosol pressures: the paper's pressure, of a sphere
/// its contact pressure again.
///   radius_of_gyration_um    sqrt(1/N sum |x_i - x_com|^2), always in space
///                            [VanLiedekerke2020, Sect. 3.2]
///   inner_*, outer_*         of the cells below 1/3 and from 2/3 of the largest r on; density per
///                            mm^3, in a monolayer per mm^2
///   shell_<k>_*              of shell (ring) k = 1 .. 10 of equal width up to the largest r
///   sphericity               mean of pi^(1/3) (6 V)^(2/3) / A, 1 for a sphere, 0.99 for its mesh
///   height_um, height_to_width  monolayer: mean extent along z, and its ratio to the mean of those
///                            along x and y
/// The last three are for deformable cells only. Profiles of the last frame over the same shells
/// (summary.json): profile_radius_um (middle), cytosol_pressure_profile_Pa, pressure_profile_Pa
/// (contact), density_profile. A shell without cells has density 0 and no pressure; while all r are
/// 0 every shell holds all cells and there is no density.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

constexpr int kShells = 10;

/// Distances of the cells' centres from their mean.
struct Layout {
  bool flat = false;      ///< r is horizontal
  std::vector<double> r;  ///< um, per cell
  double largest = 0;     ///< um
  double gyration = 0;    ///< um
};
Layout make_layout(const std::vector<coupling::CellMeasure>& cells, bool flat) {
  const auto n = static_cast<double>(cells.size());
  Vec3 mean = Vec3::Zero();
  for (const coupling::CellMeasure& c : cells) mean += c.center / n;
  Layout out;
  out.flat = flat;
  double sum = 0;
  for (const coupling::CellMeasure& c : cells) {
    const Vec3 d = c.center - mean;
    sum += d.squaredNorm();
    out.r.push_back(flat ? d.head<2>().norm() : d.norm());
    out.largest = std::max(out.largest, out.r.back());
  }
  out.gyration = std::sqrt(sum / n);
  return out;
}

/// Mean pressures and density of the cells with low <= r < high; the last shell includes
/// r = high.
struct Shell {
  double cells = 0;
  double pressure = kNotMeasured, cytosol = kNotMeasured;  ///< Pa
  double density = kNotMeasured;
};
Shell measure_shell(const std::vector<coupling::CellMeasure>& cells, const Layout& layout,
                    double low, double high) {
  double pressure = 0, cytosol = 0, count = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double r = layout.r[i];
    if (r < low || (r >= high && high < layout.largest)) continue;
    pressure += cells[i].pressure;
    cytosol += cells[i].cytosol_pressure;
    ++count;
  }
  Shell shell;
  shell.cells = count;
  if (count > 0) {
    shell.pressure = 1e3 * pressure / count;
    shell.cytosol = 1e3 * cytosol / count;
  }
  const double size = layout.flat ? kPi * (high * high - low * low)
                                  : 4.0 / 3 * kPi * (std::pow(high, 3) - std::pow(low, 3));
  if (size > 0) shell.density = (layout.flat ? 1e6 : 1e9) * count / size;
  return shell;
}

void add_profiles(const std::vector<coupling::CellMeasure>& cells, const Layout& layout,
                  Measures& m) {
  std::vector<double> radius, pressure, cytosol, density;
  for (int k = 0; k < kShells; ++k) {
    const double low = layout.largest * k / kShells;
    const double high = k + 1 < kShells ? layout.largest * (k + 1) / kShells : layout.largest;
    const Shell shell = measure_shell(cells, layout, low, high);
    radius.push_back(0.5 * (low + high));
    pressure.push_back(shell.pressure);
    cytosol.push_back(shell.cytosol);
    density.push_back(shell.density);
    const std::string name = "shell_" + std::to_string(k + 1);
    m[name + "_cells"].push_back(shell.cells);
    m[name + "_cytosol_pressure_Pa"].push_back(shell.cytosol);
    m[name + "_contact_pressure_Pa"].push_back(shell.pressure);
    m[name + "_density"].push_back(shell.density);
  }
  m["shell_width_um"].push_back(layout.largest / kShells);
  m["profile_radius_um"] = radius;
  m["pressure_profile_Pa"] = pressure;
  m["cytosol_pressure_profile_Pa"] = cytosol;
  m["density_profile"] = density;
}

/// Shape indices of the deformable cells; no series if there never were any.
void add_shapes(const coupling::World& world, const Snapshot& s, bool flat, Measures& m) {
  double sphericity = 0, n = 0;
  for (const coupling::CellMeasure& c : s.cells) {
    if (!c.deformable) continue;
    sphericity += std::cbrt(kPi) * std::pow(6 * c.volume, 2.0 / 3) / c.area;
    ++n;
  }
  if (n > 0 || m.contains("sphericity"))
    m["sphericity"].push_back(n > 0 ? sphericity / n : kNotMeasured);
  if (!flat) return;
  const dcm::State& cells = world.state.dcm;
  std::vector<Vec3> node;
  double height = 0, ratio = 0, n_shell = 0;
  for (std::size_t lane = 0; lane < cells.n_lane(); ++lane) {
    if (!cells.active(lane)) continue;
    dcm::copy_nodes(cells, lane, node);
    Vec3 low = node.front(), high = low;
    for (const Vec3& x : node) low = low.cwiseMin(x), high = high.cwiseMax(x);
    const Vec3 extent = high - low;
    height += extent.z();
    ratio += 2 * extent.z() / (extent.x() + extent.y());
    ++n_shell;
  }
  if (n_shell == 0 && !m.contains("height_um")) return;
  m["height_um"].push_back(n_shell > 0 ? height / n_shell : kNotMeasured);
  m["height_to_width"].push_back(n_shell > 0 ? ratio / n_shell : kNotMeasured);
}

std::vector<Observable> growth_columns(bool flat) {
  const char* density = flat ? "1/mm^2" : "1/mm^3";
  std::vector<Observable> list{
      {"radius_of_gyration_um", "um",
       "root mean square distance of the cells' centres from their mean"},
      {"mean_pressure_Pa", "Pa", "mean contact pressure of all cells"},
      {"mean_cytosol_pressure_Pa", "Pa",
       "mean cytosol pressure of all cells (of spheres: contact pressure)"},
      {"inner_cells", "1",
       "cells nearer to the centre of the tissue than 1/3 of the largest distance"},
      {"inner_pressure_Pa", "Pa", "mean contact pressure of the inner cells"},
      {"inner_cytosol_pressure_Pa", "Pa", "mean cytosol pressure of the inner cells"},
      {"inner_density", density, "number density of the inner cells"},
      {"outer_cells", "1",
       "cells farther from the centre of the tissue than 2/3 of the largest distance"},
      {"outer_pressure_Pa", "Pa", "mean contact pressure of the outer cells"},
      {"outer_cytosol_pressure_Pa", "Pa", "mean cytosol pressure of the outer cells"},
      {"outer_density", density, "number density of the outer cells"},
      {"sphericity", "1",
       "mean of pi^(1/3) (6 V)^(2/3) / A over the deformable cells; 0 without any"}};
  if (flat)
    append(list, {{"height_um", "um", "mean height of the deformable cells; 0 without any"},
                  {"height_to_width", "1",
                   "mean ratio of height to width of the deformable cells; 0 without any"}});
  append(list,
         {{"shell_width_um", "um",
           "width of each of ten shells (in a plane: rings) about the centre of the tissue"}});
  for (int k = 1; k <= kShells; ++k)
    append(list, {{fmt::format("shell_{}_cells", k), "1", fmt::format("cells in shell {}", k)},
                  {fmt::format("shell_{}_cytosol_pressure_Pa", k), "Pa",
                   fmt::format("mean cytosol pressure in shell {}", k)},
                  {fmt::format("shell_{}_contact_pressure_Pa", k), "Pa",
                   fmt::format("mean contact pressure in shell {}", k)},
                  {fmt::format("shell_{}_density", k), density,
                   fmt::format("number density in shell {}", k)}});
  return list;
}

void sample_growth(const ObservedFrame& frame, bool flat, Measures& m) {
  const Snapshot& s = frame.snapshot;
  Layout layout;
  Shell inner, outer;
  double pressure = kNotMeasured, cytosol = kNotMeasured;
  if (!s.cells.empty()) {
    layout = make_layout(s.cells, flat);
    inner = measure_shell(s.cells, layout, 0, layout.largest / 3);
    outer = measure_shell(s.cells, layout, layout.largest * 2 / 3, layout.largest);
    pressure = cytosol = 0;
    for (const coupling::CellMeasure& c : s.cells) {
      pressure += c.pressure;
      cytosol += c.cytosol_pressure;
    }
    pressure *= 1e3 / static_cast<double>(s.cells.size());
    cytosol *= 1e3 / static_cast<double>(s.cells.size());
  }
  m["radius_of_gyration_um"].push_back(s.cells.empty() ? kNotMeasured : layout.gyration);
  m["mean_pressure_Pa"].push_back(pressure);
  m["mean_cytosol_pressure_Pa"].push_back(cytosol);
  m["inner_cells"].push_back(inner.cells);
  m["outer_cells"].push_back(outer.cells);
  m["inner_pressure_Pa"].push_back(inner.pressure);
  m["outer_pressure_Pa"].push_back(outer.pressure);
  m["inner_cytosol_pressure_Pa"].push_back(inner.cytosol);
  m["outer_cytosol_pressure_Pa"].push_back(outer.cytosol);
  m["inner_density"].push_back(inner.density);
  m["outer_density"].push_back(outer.density);
  add_profiles(s.cells, layout, m);
  add_shapes(frame.world, s, flat, m);
}

std::vector<Observable> spheroid_columns() { return growth_columns(false); }
std::vector<Observable> monolayer_columns() { return growth_columns(true); }

void sample_spheroid(const ObservedFrame& frame, ObservedRun& observed) {
  sample_growth(frame, false, observed.measures);
}
void sample_monolayer(const ObservedFrame& frame, ObservedRun& observed) {
  sample_growth(frame, true, observed.measures);
}

}  // namespace

const ExperimentRow spheroid_experiment{
    .meaning = "pressure, density and shape of a tissue that grows in space",
    .columns = spheroid_columns,
    .sample = sample_spheroid,
    .reads_snapshot_only = true};

const ExperimentRow monolayer_experiment{
    .meaning = "pressure, density and shape of a tissue that grows in a plane",
    .columns = monolayer_columns,
    .sample = sample_monolayer};

}  // namespace acinus::runs
