/// Experiment "relaxation": a clump that is compressed, held and released.
///
/// Measured are the mean relative overlap of a cell and its 14 nearest over all cells, and height
/// and width: the extent of the clump along the axis of the first wall that opens, z if none does,
/// and across it, both of the ellipsoid of uniform density with the variance of the cells' centres.
/// For each of the three, figures of the recovery since the release (calibration/recovery.hpp):
///   NAME_back_10s   share of the way that is done 10 s after the release
///   NAME_efold_h    time in which what is left then falls to 1/e
///   NAME_return_h   time until 1 % of the way is left; none while it goes on
///   NAME_recovered  the way over that from the first frame to the release
/// and relaxation_time_h, the return of the height if a wall opens, else of the overlap
/// [VanLiedekerke2020, Appendix 1, Fig. 12c].

#include <algorithm>
#include <cmath>

#include "calibration/clump.hpp"
#include "calibration/recovery.hpp"
#include "core/numbers/time_grid.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"
#include "runs/scene/frame_times.hpp"

namespace acinus::runs {
namespace {

constexpr double kSecondsPerHour = 3600;

/// Axis along which the clump is compressed.
Vec3 axis_of(const Scene& scene) {
  for (const WallEntry& w : scene.walls)
    if (w.opens) return w.normal.normalized();
  return Vec3::UnitZ();
}

/// True for compression between plates, which the mean distance of cells hardly shows.
bool is_flat(const Scene& scene) {
  return std::ranges::any_of(scene.walls, [](const WallEntry& w) { return w.opens.has_value(); });
}

/// Extent along the axis and across it, um: an ellipsoid of uniform density with the half axis a
/// has the variance a^2 / 5 along it.
struct ClumpExtent {
  double height = 0, width = 0;
};
ClumpExtent extent_of(const std::vector<coupling::CellMeasure>& cells, const Vec3& axis) {
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

/// Figures of the recovery up to now, computed anew at every frame.
void add_recovery(const std::string& name, double release, Measures& m) {
  const std::vector<double>&time = m["time_s"], &all = m[name == "overlap" ? name : name + "_um"];
  std::vector<double> t, y;
  for (std::size_t k = 0; k < time.size(); ++k)
    if (time[k] >= release - kSameTime) {
      t.push_back(time[k] - release);
      y.push_back(all[k]);
    }
  const calibration::Recovery r = calibration::measure_recovery(t, y);
  m[name + "_back_10s"] = {r.sprung};
  m[name + "_efold_h"] = {r.efold / kSecondsPerHour};
  m[name + "_return_h"] = {r.time / kSecondsPerHour};
  const double compressed = y.empty() ? 0 : y.front() - all.front();
  m[name + "_recovered"] = {compressed != 0 ? (y.front() - r.end) / compressed : kNotMeasured};
}

/// Rule: a wall or a capsule opens within the run.
void check_relaxation(const Scene& scene, Report& report) {
  const double opens = next_opening(scene, -1);
  if (opens < scene.time.end) return;
  report.add_relation({"/experiment", "/walls", "/capsule", "/time/end"}, "",
                      "needs a wall or a capsule that opens before /time/end (acinus explain "
                      "wall.opens)");
}

std::vector<Observable> relaxation_columns() {
  return {{"overlap", "1", "mean relative overlap of a cell and its 14 nearest, over all cells"},
          {"height_um", "um", "extent of the clump along the axis of compression"},
          {"width_um", "um", "extent of the clump across it"}};
}

void sample_relaxation(const ObservedFrame& frame, ObservedRun& observed) {
  const Snapshot& s = frame.snapshot;
  Measures& m = observed.measures;
  if (s.cells.empty()) return;
  double overlap = 0;
  for (std::size_t k = 0; k < s.cells.size(); ++k)
    overlap += calibration::measure_clump(s.cells, k).shell_overlap;
  const ClumpExtent extent = extent_of(s.cells, axis_of(frame.scene));
  m["overlap"].push_back(overlap / static_cast<double>(s.cells.size()));
  m["height_um"].push_back(extent.height);
  m["width_um"].push_back(extent.width);
  const double release = next_opening(frame.scene, -1);
  for (const char* name : {"overlap", "height", "width"}) add_recovery(name, release, m);
  m["relaxation_time_h"] = m[is_flat(frame.scene) ? "height_return_h" : "overlap_return_h"];
}

}  // namespace

const ExperimentRow relaxation_experiment{
    .meaning = "return of a compressed clump to its shape after the release",
    .check = check_relaxation,
    .columns = relaxation_columns,
    .sample = sample_relaxation};

}  // namespace acinus::runs
