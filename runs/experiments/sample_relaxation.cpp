#include <algorithm>
#include <cmath>
#include <limits>

#include "calibration/clump.hpp"
#include "calibration/recovery.hpp"
#include "core/numbers/time_grid.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/scene/frame_times.hpp"

namespace acinus::runs {
namespace {

constexpr double kSecondsPerHour = 3600;

/// Along which the clump is compressed.
Vec3 axis_of(const Scene& scene) {
  for (const WallEntry& w : scene.walls)
    if (w.opens) return w.normal.normalized();
  return Vec3::UnitZ();
}

/// Compressed between plates: what the cells' mean distance hardly tells.
bool is_flat(const Scene& scene) {
  return std::ranges::any_of(scene.walls, [](const WallEntry& w) { return w.opens.has_value(); });
}

/// Extent along the axis and across it, um: an even ellipsoid with the half axis a has the variance
/// a^2 / 5 along it.
struct Extent {
  double height = 0, width = 0;
};
Extent extent_of(const std::vector<coupling::CellMeasure>& cells, const Vec3& axis) {
  Vec3 mean = Vec3::Zero();
  for (const auto& c : cells) mean += c.center;
  mean /= static_cast<double>(cells.size());
  double along = 0, all = 0;
  for (const auto& c : cells) {
    along += std::pow((c.center - mean).dot(axis), 2);
    all += (c.center - mean).squaredNorm();
  }
  const auto n = static_cast<double>(cells.size());
  const double across = std::max(0.0, (all - along) / 2);
  return {2 * std::sqrt(5 * along / n), 2 * std::sqrt(5 * across / n)};
}

void put(Measures& m, const std::string& name, double value) { m[name] = {value}; }

/// What the series says about the way back so far.
void add_recovery(const std::string& name, double release, Measures& m) {
  const std::vector<double>&time = m["time_s"], &all = m[name == "overlap" ? name : name + "_um"];
  std::vector<double> t, y;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= release - kSameTime) {
      t.push_back(time[k] - release);
      y.push_back(all[k]);
    }
  const calibration::Recovery r = calibration::measure_recovery(t, y);
  put(m, name + "_back_10s", r.sprung);
  put(m, name + "_efold_h", r.efold / kSecondsPerHour);
  put(m, name + "_return_h", r.time / kSecondsPerHour);
  const double compressed = y.empty() ? 0 : y.front() - all.front();
  put(m, name + "_recovered",
      compressed != 0 ? (y.front() - r.end) / compressed
                      : std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void sample_relaxation(const Scene& scene, const coupling::World&, const Snapshot& s, Measures& m) {
  if (s.cells.empty()) return;
  double overlap = 0;
  for (std::size_t k = 0; k < s.cells.size(); ++k)
    overlap += calibration::measure_clump(s.cells, k).shell_overlap;
  const Extent extent = extent_of(s.cells, axis_of(scene));
  m["overlap"].push_back(overlap / static_cast<double>(s.cells.size()));
  m["height_um"].push_back(extent.height);
  m["width_um"].push_back(extent.width);
  const double release = next_opening(scene, -1);
  for (const char* name : {"overlap", "height", "width"}) add_recovery(name, release, m);
  m["relaxation_time_h"] = m[is_flat(scene) ? "height_return_h" : "overlap_return_h"];
}

}  // namespace acinus::runs
