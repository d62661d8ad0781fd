#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "runs/experiments/experiment.hpp"

namespace acinus::runs {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The cells' places relative to their mean.
struct Layout {
  bool flat = false;      ///< r is horizontal
  std::vector<double> r;  ///< um, per cell
  double largest = 0;     ///< um
  double gyration = 0;    ///< um
};
Layout lay_out(const std::vector<coupling::CellMeasure>& cells, bool flat) {
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

/// Mean pressures and density of the cells with low <= r < high; the last shell has its outer edge.
struct Shell {
  double cells = 0, pressure_Pa = kNone, cytosol_Pa = kNone, density = kNone;
};
Shell look_at(const std::vector<coupling::CellMeasure>& cells, const Layout& layout, double low,
              double high) {
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
    shell.pressure_Pa = 1e3 * pressure / count;
    shell.cytosol_Pa = 1e3 * cytosol / count;
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
    const Shell shell = look_at(cells, layout, low, high);
    radius.push_back(0.5 * (low + high));
    pressure.push_back(shell.pressure_Pa);
    cytosol.push_back(shell.cytosol_Pa);
    density.push_back(shell.density);
    const std::string name = "shell_" + std::to_string(k + 1);
    m[name + "_cells"].push_back(shell.cells);
    m[name + "_cytosol_pressure_Pa"].push_back(shell.cytosol_Pa);
    m[name + "_contact_pressure_Pa"].push_back(shell.pressure_Pa);
    m[name + "_density"].push_back(shell.density);
  }
  m["shell_width_um"].push_back(layout.largest / kShells);
  m["profile_radius_um"] = radius;
  m["pressure_profile_Pa"] = pressure;
  m["cytosol_pressure_profile_Pa"] = cytosol;
  m["density_profile"] = density;
}

/// Shape indices of the deformable cells; nothing if there never were any.
void add_shapes(const coupling::World& world, const Snapshot& s, bool flat, Measures& m) {
  double sphericity = 0, n = 0;
  for (const coupling::CellMeasure& c : s.cells) {
    if (!c.deformable) continue;
    sphericity += std::cbrt(kPi) * std::pow(6 * c.volume, 2.0 / 3) / c.area;
    ++n;
  }
  if (n > 0 || m.contains("sphericity")) m["sphericity"].push_back(n > 0 ? sphericity / n : kNone);
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
  m["height_um"].push_back(n_shell > 0 ? height / n_shell : kNone);
  m["height_to_width"].push_back(n_shell > 0 ? ratio / n_shell : kNone);
}

}  // namespace

void sample_growth(const Scene& scene, const coupling::World& world, const Snapshot& s,
                   Measures& m) {
  const bool flat = scene.experiment == Experiment::kMonolayer;
  Layout layout;
  Shell inner, outer;
  double pressure = kNone, cytosol = kNone;
  if (!s.cells.empty()) {
    layout = lay_out(s.cells, flat);
    inner = look_at(s.cells, layout, 0, layout.largest / 3);
    outer = look_at(s.cells, layout, layout.largest * 2 / 3, layout.largest);
    pressure = cytosol = 0;
    for (const coupling::CellMeasure& c : s.cells) {
      pressure += c.pressure;
      cytosol += c.cytosol_pressure;
    }
    pressure *= 1e3 / static_cast<double>(s.cells.size());
    cytosol *= 1e3 / static_cast<double>(s.cells.size());
  }
  m["radius_of_gyration_um"].push_back(s.cells.empty() ? kNone : layout.gyration);
  m["mean_pressure_Pa"].push_back(pressure);
  m["mean_cytosol_pressure_Pa"].push_back(cytosol);
  m["inner_cells"].push_back(inner.cells);
  m["outer_cells"].push_back(outer.cells);
  m["inner_pressure_Pa"].push_back(inner.pressure_Pa);
  m["outer_pressure_Pa"].push_back(outer.pressure_Pa);
  m["inner_cytosol_pressure_Pa"].push_back(inner.cytosol_Pa);
  m["outer_cytosol_pressure_Pa"].push_back(outer.cytosol_Pa);
  m["inner_density"].push_back(inner.density);
  m["outer_density"].push_back(outer.density);
  add_profiles(s.cells, layout, m);
  add_shapes(world, s, flat, m);
}

}  // namespace acinus::runs
