#include "bench/tissue/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/accuracy.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/stage.hpp"

namespace acinus::bench {
namespace {

using runs::Accuracy;
using runs::AccuracySettings;

struct JudgedScene {
  const char *name, *text;
  /// False for loose tissue, where contact forces are small differences of adhesion and repulsion.
  bool has_forces;
};

constexpr JudgedScene kScenes[] = {{"growth", R"({
  "extends": "spheroid.json", "time": { "until_cells": 16 }, "output": { "every": "4 h" } })",
                                    false},
                                   {"compression", R"({
  "experiment": "capsule", "model": "dcm", "time": { "end": "12 h" },
  "cell_types": { "hepatocyte": { "radius": "12 um", "adhesion": "1e-5 J/m^2" } },
  "cells": { "source": "clump", "count": 15, "lattice": "bcc", "jitter": 0.01 },
  "capsule": { "radius": "40 um", "speed": "1 um/h", "min_radius": "29 um" },
  "motility": { "random": false }, "output": { "every": "1 h" } })",
                                    true},
                                   {"monolayer", R"({
  "extends": "monolayer_type2.json", "time": { "until_cells": 16 }, "output": { "every": "4 h" } })",
                                    false},
                                   {"plates", R"({
  "experiment": "free", "model": "dcm", "time": { "end": "3 h" },
  "cell_types": { "hepatocyte": { "radius": "12 um", "adhesion": "1e-5 J/m^2" } },
  "cells": { "source": "clump", "count": 27, "lattice": "bcc", "jitter": 0.01 },
  "walls": [
    { "name": "lower", "point": ["0 um", "0 um", "-42 um"], "normal": [0, 0, 1], "mirror": true, "speed": "7 um/h", "travel": "14 um" },
    { "name": "upper", "point": ["0 um", "0 um", "42 um"], "normal": [0, 0, -1], "mirror": true, "speed": "7 um/h", "travel": "14 um" }
  ],
  "motility": { "random": false }, "output": { "every": "15 min" } })",
                                    true}};

constexpr const char* kFigures[] = {"cytosol_pressure", "radius", "contact_area", "contact_force"};
using Figures = std::array<double, std::size(kFigures)>;

/// Last part of the frames that figures are averaged over: nearly one cycle of 16 cells from one.
constexpr double kLastPart = 0.2;

/// Means over the cells of a frame.
Figures read_frame(const io::RunReader& run, int frame, const std::string& folder) {
  const io::Table t = run.cells(frame);
  const auto mean = [&](const char* name) {
    const std::vector<double>& column = runs::cell_column(t, name, folder);
    return std::accumulate(column.begin(), column.end(), 0.0) / static_cast<double>(column.size());
  };
  const std::vector<double>& center = runs::cell_column(t, "center", folder);
  const std::size_t n = center.size() / 3;
  const auto center_of = [&](std::size_t i) {
    return Vec3(center[3 * i], center[3 * i + 1], center[3 * i + 2]);
  };
  Vec3 middle = Vec3::Zero();
  for (std::size_t i = 0; i < n; ++i) middle += center_of(i) / static_cast<double>(n);
  double square = 0;
  for (std::size_t i = 0; i < n; ++i)
    square += (center_of(i) - middle).squaredNorm() / static_cast<double>(n);
  return {mean("cytosol_pressure"), std::sqrt(square), mean("contact_area"), mean("normal_force")};
}

/// Means over the last frames: cytosol pressure, kPa; radius of gyration of the centres, um;
/// contact area, um^2; contact force, nN.
Figures read_figures(const std::string& folder) {
  const io::RunReader run(folder + "/run.vtkhdf");
  const int n = run.n_frame(), n_used = std::max(1, static_cast<int>(kLastPart * n));
  Figures figures{};
  for (int k = n - n_used; k < n; ++k) {
    const Figures frame = read_frame(run, k, folder);
    for (std::size_t i = 0; i < figures.size(); ++i) figures[i] += frame[i] / n_used;
  }
  return figures;
}

/// The same mesh and contact points with half the step and a quarter of the solver's residual.
AccuracySettings with_short_steps(AccuracySettings a) {
  a.step /= 2;
  a.tolerance /= 4;  // the error of one step is of second order in its length
  a.solver /= 4;
  return a;
}

/// Error of a step over its difference to half the step, of first order.
constexpr double kFirstOrder = 2;

/// Settings that all others are judged by.
constexpr AccuracySettings kReference{
    1442, contact::Quadrature::kNodesAndEdges, 0.35, 60, 0.05, 0.6, 0.003, 0.3};

struct Outcome {
  Figures mean{};
  double cpu_s = 0;
  int cells = 0;
};

/// Runs a scene with all seeds.
Outcome run_all(const JudgedScene& judged, const std::string& label, const AccuracySettings& a,
                const BenchOptions& options, const std::string& root) {
  Outcome outcome;
  for (int k = 0; k < options.seeds; ++k) {
    runs::Scene scene =
        runs::parse_scene(judged.text, std::string(judged.name) + ".json", runs::scene_folder());
    use_settings(a, scene);
    scene.seed = static_cast<std::uint64_t>(options.first + k);
    set_canonical(scene);
    const std::string folder = fmt::format("{}/{}_{}_{}", root, judged.name, label, scene.seed);
    const int code =
        runs::run_stage(scene, {folder, options.threads, true, false, "acinus bench accuracy"});
    check(code == static_cast<int>(Exit::kDone),
          fmt::format("bench accuracy: the run in {} ended with exit code {}", folder, code),
          Exit::kCannotContinue);
    const Figures figures = read_figures(folder);
    const runs::RunSummary summary = runs::read_summary(folder);
    for (std::size_t i = 0; i < figures.size(); ++i) outcome.mean[i] += figures[i] / options.seeds;
    outcome.cpu_s += summary.cpu_s / options.seeds;
    outcome.cells = summary.dcm;
  }
  return outcome;
}

}  // namespace

BenchTable bench_accuracy(const BenchOptions& options) {
  const std::string root = options.folder.empty() ? "accuracy" : options.folder + "/accuracy";
  BenchTable table;
  for (const JudgedScene& scene : kScenes) {
    const Outcome reference = run_all(scene, "reference", kReference, options, root);
    for (const Accuracy accuracy : {Accuracy::kFast, Accuracy::kBalanced, Accuracy::kFine}) {
      const std::string name = runs::name_of_choice(accuracy);
      const AccuracySettings& settings = runs::settings_of(accuracy);
      const Outcome whole = run_all(scene, name, settings, options, root),
                    exact = run_all(scene, name + "_short_steps", with_short_steps(settings),
                                    options, root);
      BenchRow row{fmt::format("{} {}", scene.name, name), whole.cells, {}};
      for (std::size_t i = 0; i < std::size(kFigures); ++i) {
        if (!scene.has_forces && std::string(kFigures[i]) == "contact_force") continue;
        row.value.emplace_back(fmt::format("{}_error", kFigures[i]),
                               whole.mean[i] / reference.mean[i] - 1);
        row.value.emplace_back(fmt::format("{}_step_part", kFigures[i]),
                               kFirstOrder * (whole.mean[i] - exact.mean[i]) / reference.mean[i]);
      }
      row.value.emplace_back("cpu_s", whole.cpu_s);
      row.value.emplace_back("reference_cpu_s", reference.cpu_s);
      table.push_back(row);
      print_row(row);
    }
  }
  return table;
}

}  // namespace acinus::bench
