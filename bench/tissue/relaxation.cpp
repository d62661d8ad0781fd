#include "bench/tissue/relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "calibration/recovery.hpp"
#include "core/error.hpp"
#include "core/numbers/time_grid.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/calibrate/law_cache.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/frame_times.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"
#include "runs/session/stage.hpp"

namespace acinus::bench {
namespace {

constexpr double kHour = 3600;
constexpr double kHoldTimes[] = {1 * kHour, 10 * kHour};
/// Sampling times of the remaining compression, s after the release.
constexpr std::pair<const char*, double> kSampleTimes[] = {
    {"10s", 10}, {"10min", 600}, {"1h", kHour}, {"5h", 5 * kHour}, {"24h", 24 * kHour}};

/// Variant of a relaxation scene with its row and run folder.
struct RelaxationVariant {
  std::string name, folder;
  runs::Scene scene;
};

/// Time at which the compression ends, s.
double end_of_compression(const runs::Scene& scene) {
  double t = scene.capsule.enabled
                 ? (scene.capsule.radius - scene.capsule.min_radius) / scene.capsule.speed
                 : 0;
  for (const runs::WallEntry& w : scene.walls)
    if (w.speed != 0) t = std::max(t, w.travel / std::abs(w.speed));
  return t;
}

/// Sets the hold time of a compression (s); the recovery lasts as long as in the shipped scene.
void hold(double time, runs::Scene& scene) {
  const double after = scene.time.end - runs::next_opening(scene, -1),
               opens = end_of_compression(scene) + time;
  for (runs::WallEntry& w : scene.walls) w.opens = opens;
  if (scene.capsule.enabled) scene.capsule.opens = opens;
  scene.time.end = opens + after;
}

/// Variant with deformable cells, or with spheres for nodes = 0.
/// @param held  hold time, s
/// @param form  friction form or law of the variant
RelaxationVariant make_variant(const runs::Scene& shipped, double held, int nodes,
                               const std::string& form) {
  RelaxationVariant v{"", "", shipped};
  hold(held, v.scene);
  std::string what = form;
  if (nodes > 0) {
    v.scene.contact.friction_form =
        form == "nodes" ? dcm::FrictionForm::kNodes : dcm::FrictionForm::kSurface;
    what = fmt::format("{} {}", form, nodes);
  } else {
    v.scene.model = v.scene.cells.model = runs::CellModel::kCbm;
  }
  for (auto& [name, type] : v.scene.cell_types) {
    if (nodes > 0) type.dcm.nodes = nodes;
    if (form == "plain") type.cbm.stiffness_correction = "none";
  }
  v.name = fmt::format("{}, held {:.3g} h, {}", shipped.capsule.enabled ? "capsule" : "plates",
                       held / kHour, what);
  v.folder = v.name;
  std::ranges::replace(v.folder, ' ', '_');
  std::erase(v.folder, ',');
  set_canonical(v.scene);
  return v;
}

std::vector<RelaxationVariant> make_variants(const runs::Scene& shipped) {
  std::vector<RelaxationVariant> all;
  for (const double held : kHoldTimes) {
    for (const int nodes : {162, 642})
      for (const char* form : {"surface", "nodes"})
        all.push_back(make_variant(shipped, held, nodes, form));
    for (const char* law : {"plain", "calibrated"})
      all.push_back(make_variant(shipped, held, 0, law));
  }
  return all;
}

/// Row of a run: overlap after a capsule, height after plates.
BenchRow make_row(const RelaxationVariant& v, const std::string& folder) {
  const runs::RunSummary summary = runs::read_summary(folder);
  const std::string name = v.scene.capsule.enabled ? "overlap" : "height";
  const std::vector<double>&time = series(summary, "time_s"),
        &y = series(summary, v.scene.capsule.enabled ? name : name + "_um");
  const double release = runs::next_opening(v.scene, -1);
  const auto from = static_cast<std::ptrdiff_t>(
      std::ranges::lower_bound(time, release - kSameTime) - time.begin());
  BenchRow row{v.name, summary.dcm + summary.cbm, {}};
  row.value.emplace_back(name + "_before", y.front());
  if (time.begin() + from == time.end()) {  // the compression could not be finished
    row.value.emplace_back("compressed_for_h", time.back() / kHour);
    return row;
  }
  const std::vector<double> after(y.begin() + from, y.end());
  std::vector<double> since;
  for (std::size_t k = from; k < time.size(); ++k) since.push_back(time[k] - release);
  row.value.emplace_back(name + "_compressed", after.front());
  const double compression = y.front() - after.front();
  for (const auto& [label, t] : kSampleTimes)
    row.value.emplace_back(fmt::format("left_after_{}", label),
                           (y.front() - calibration::value_at(t, since, after)) / compression);
  for (const char* what : {"back_10s", "efold_h", "return_h"})
    row.value.emplace_back(what, series(summary, name + "_" + what).back());
  row.value.emplace_back("cpu_s", summary.cpu_s);
  return row;
}

}  // namespace

BenchTable bench_relaxation(const BenchOptions& options) {
  const std::string root = options.folder.empty() ? "relaxation" : options.folder + "/relaxation";
  BenchTable table;
  for (const char* name : {"relaxation_capsule", "relaxation_plates"}) {
    runs::Scene shipped = runs::read_scene(runs::scene_folder() + "/" + name + ".json");
    for (auto& [type_name, type] : shipped.cell_types) type.cbm.stiffness_correction = "auto";
    const int stop = runs::resolve_corrections(shipped, options.threads, false);
    check(stop == 0, "bench relaxation: the calibration was stopped", Exit::kCannotContinue);
    for (const RelaxationVariant& v : make_variants(shipped)) {
      const std::string folder = root + "/" + v.folder;
      const int code = runs::run_stage(
          v.scene, {folder, options.threads, true, false, "acinus bench relaxation"});
      check(
          code == static_cast<int>(Exit::kDone) || code == static_cast<int>(Exit::kCannotContinue),
          fmt::format("bench relaxation: the run in {} ended with exit code {}", folder, code),
          Exit::kCannotContinue);
      table.push_back(make_row(v, folder));
      print_row(table.back());
    }
  }
  return table;
}

}  // namespace acinus::bench
