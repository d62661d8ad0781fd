#include "bench/tissue/patch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "calibration/curve.hpp"
#include "core/error.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/calibrate/law_cache.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"
#include "runs/session/stage.hpp"

namespace acinus::bench {
namespace {

/// Range of the pressure of the deformable ball in which the models are compared, Pa.
constexpr double kLowestPressure = 5, kHighestPressure = 250;
/// Radius of the inner cells relative to that of the capsule, which the outer ones touch.
constexpr double kInnerRadius = 0.65;
/// Number of nearest neighbours that define the density about a cell.
constexpr std::size_t kDensityNeighbours = 12;

/// Cells of a frame with the density about each, up to a factor.
struct PatchFrame {
  runs::CellRecords cells;
  std::map<std::int64_t, double> density;
};

/// Number density about a cell from the distances of its nearest neighbours, 1/um^3 up to a factor.
double density_about(const runs::CellRecords& cells, std::int64_t id) {
  std::vector<double> distance;
  for (const auto& [other, c] : cells)
    if (other != id) distance.push_back((c.center - cells.at(id).center).norm());
  const std::size_t n = std::min(kDensityNeighbours, distance.size());
  std::ranges::partial_sort(distance, distance.begin() + static_cast<std::ptrdiff_t>(n));
  double sum = 0;
  for (std::size_t k = 0; k < n; ++k) sum += distance[k];
  return std::pow(static_cast<double>(n) / sum, 3);
}

std::vector<PatchFrame> read_patch_frames(const std::string& folder) {
  const io::RunReader run(folder + "/run.vtkhdf");
  std::vector<PatchFrame> frames;
  for (int k = 0; k < run.n_frame(); ++k) {
    PatchFrame m{runs::read_cells(run, k, folder), {}};
    for (const auto& [id, unused] : m.cells) m.density[id] = density_about(m.cells, id);
    frames.push_back(std::move(m));
  }
  return frames;
}

/// Means over the inner cells of one model.
struct HalfMean {
  double pressure = 0, force = 0, density = 0;
  int cells = 0;
};

/// Means over the inner cells of one model in a reference frame.
/// @param like        frame that defines position and model of the cells
/// @param deformable  which model to average
/// @param reach       radius of the inner region, um
HalfMean measure(const PatchFrame& frame, const PatchFrame& like, bool deformable, double reach) {
  HalfMean b;
  for (const auto& [id, c] : frame.cells) {
    const auto there = like.cells.find(id);
    if (there == like.cells.end() || there->second.deformable != deformable ||
        !(there->second.center.norm() < reach))
      continue;
    b.pressure += c.pressure;
    b.force += c.force;
    b.density += frame.density.at(id);
    ++b.cells;
  }
  const double n = std::max(1, b.cells);
  b.pressure /= n;
  b.force /= n;
  b.density /= n;
  return b;
}

double jump(double a, double b) { return 2 * std::abs(a - b) / (a + b); }

/// Variant of the scene with its run folder.
struct PatchVariant {
  std::string name, folder;
  runs::Scene scene;
};

PatchVariant make_variant(const runs::Scene& shipped, const std::string& name, double share,
                          const std::string& law) {
  PatchVariant v{
      name, fmt::format("{:.0f}_{}", 100 * share, law == "none" ? "plain" : "calibrated"), shipped};
  if (share >= 1) {
    v.scene.model = v.scene.cells.model = runs::CellModel::kDcm;
    v.scene.zoom.clear();
    v.folder = "all_dcm";
  }
  for (auto& [type, cell] : v.scene.cell_types) cell.cbm.stiffness_correction = law;
  // The ball is about as wide as the smallest capsule; a plane cuts this share of its volume off.
  const double radius = shipped.capsule.min_radius;
  double low = -1, high = 1;
  for (int k = 0; k < 50; ++k) {
    const double x = 0.5 * (low + high);
    (0.25 * (2 + 3 * x - x * x * x) < share ? low : high) = x;
  }
  for (runs::Region& region : v.scene.zoom) region.point = Vec3(radius * low, 0, 0);
  set_canonical(v.scene);
  return v;
}

struct Reference {
  std::vector<PatchFrame> frame;
  double cpu = 0;
};

BenchRow compare(const PatchVariant& v, const std::string& folder, const runs::Scene& shipped,
                 const Reference& reference) {
  const std::vector<PatchFrame> frames = read_patch_frames(folder);
  double pressure = 0, force = 0, density = 0, error = 0, shift = 0, worst = 0, reached = 0;
  int n = 0, cells = 0;
  std::vector<double> alone;  // pressure of the deformable ball at every frame
  for (const PatchFrame& m : reference.frame)
    alone.push_back(measure(m, m, true, kInnerRadius * shipped.capsule.min_radius).pressure);
  for (std::size_t k = 0; k < std::min(frames.size(), reference.frame.size()); ++k) {
    const double time = static_cast<double>(k) * shipped.output.every;
    const double reach =
        kInnerRadius *
        std::max(shipped.capsule.min_radius, shipped.capsule.radius - shipped.capsule.speed * time);
    const HalfMean shells = measure(frames[k], frames[k], true, reach),
                   spheres = measure(frames[k], frames[k], false, reach),
                   same = measure(reference.frame[k], frames[k], true, reach);
    cells = static_cast<int>(frames[k].cells.size());
    if (shells.cells == 0 || spheres.cells == 0) continue;
    if (!(same.pressure > kLowestPressure && same.pressure < kHighestPressure)) continue;
    reached = same.pressure;
    const double p = jump(shells.pressure, spheres.pressure);
    pressure += p;
    worst = std::max(worst, p);
    force += jump(shells.force, spheres.force);
    density += jump(shells.density, spheres.density);
    error += std::abs(shells.pressure / same.pressure - 1);
    shift += (calibration::find_last_rise(alone, shells.pressure) - static_cast<double>(k)) *
             shipped.output.every * shipped.capsule.speed;
    ++n;
  }
  const double nan = std::numeric_limits<double>::quiet_NaN(), count = n > 0 ? n : nan;
  const runs::RunSummary summary = runs::read_summary(folder);
  return {v.name,
          cells,
          {{"share_of_deformable_cells", static_cast<double>(summary.dcm) / cells},
           {"frames", n},
           {"up_to_pressure_Pa", reached},
           {"pressure_jump", pressure / count},
           {"worst_pressure_jump", worst},
           {"contact_force_jump", force / count},
           {"density_jump", density / count},
           {"deformable_part_against_all_deformable", error / count},
           {"radius_shift_for_same_pressure_um", shift / count},
           {"cost", summary.cpu_s / reference.cpu}}};
}

/// Runs a variant. Compressions may end early when surfaces crumple; what they reached is compared.
void run(const PatchVariant& v, const std::string& folder, int threads) {
  const int code = runs::run_stage(v.scene, {folder, threads, true, false, "acinus bench patch"});
  check(code == static_cast<int>(Exit::kDone) || code == static_cast<int>(Exit::kCannotContinue),
        fmt::format("bench patch: the run in {} ended with exit code {}", folder, code),
        Exit::kCannotContinue);
}

}  // namespace

BenchTable bench_patch(const BenchOptions& options) {
  const std::string root = options.folder.empty() ? "patch" : options.folder + "/patch";
  runs::Scene shipped = runs::read_scene(runs::scene_folder() + "/patch_capsule.json");
  const int stop = runs::resolve_corrections(shipped, options.threads, false);
  check(stop == 0, "bench patch: the calibration was stopped", Exit::kCannotContinue);
  const std::string law = shipped.cell_types.begin()->second.cbm.stiffness_correction;
  const PatchVariant all = make_variant(shipped, "deformable cells only", 1, "none");
  run(all, root + "/" + all.folder, options.threads);
  const Reference reference{read_patch_frames(root + "/" + all.folder),
                            runs::read_summary(root + "/" + all.folder).cpu_s};
  BenchTable table;
  for (const PatchVariant& v :
       {make_variant(shipped, "plain spheres, half", 0.5, "none"),
        make_variant(shipped, "calibrated, three quarters deformable", 0.75, law),
        make_variant(shipped, "calibrated, half", 0.5, law),
        make_variant(shipped, "calibrated, a quarter deformable", 0.25, law)}) {
    run(v, root + "/" + v.folder, options.threads);
    table.push_back(compare(v, root + "/" + v.folder, shipped, reference));
    print_row(table.back());
  }
  return table;
}

}  // namespace acinus::bench
