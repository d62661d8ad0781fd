#include "bench/tissue/out_of_sample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/tissue/out_of_sample_scenes.hpp"
#include "bench/tissue/spheres_in_place.hpp"
#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/build_params.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/calibrate/calibrate_scene.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/stage.hpp"

namespace acinus::bench {
namespace {

struct JudgedFrame {
  double time = 0;  ///< s
  JudgedCells cells;
};

std::vector<JudgedFrame> read_frames(const std::string& folder) {
  const io::RunReader run(folder + "/run.vtkhdf");
  std::vector<JudgedFrame> frames;
  for (int k = 0; k < run.n_frame(); ++k) {
    const io::Table t = run.cells(k);
    const auto column = [&](const char* name) -> const std::vector<double>& {
      return runs::cell_column(t, name, folder);
    };
    const auto &center = column("center"), &radius = column("radius"),
               &pressure = column("pressure"), &force = column("normal_force"),
               &area = column("contact_area");
    const auto& id = std::ranges::find(t.ids, "id", &io::IdColumn::name)->value;
    JudgedFrame frame{run.time_s(k), {}};
    for (std::size_t i = 0; i < id.size(); ++i)
      frame.cells[id[i]] = {{center[3 * i], center[3 * i + 1], center[3 * i + 2]},
                            radius[i],
                            pressure[i],
                            force[i],
                            area[i]};
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// Overlap relative to the sum of radii above which cells count as newborn. Frames with newborn
/// cells are excluded: spheres of that age repel with a reduced force, which frames do not hold.
constexpr double kNewbornOverlap = 0.3;

void leave_out_births(std::vector<JudgedFrame>& frames) {
  std::erase_if(frames, [](const JudgedFrame& f) {
    for (const auto& [id, own] : f.cells)
      for (const auto& [other, c] : f.cells)
        if (id < other &&
            (own.center - c.center).norm() < (1 - kNewbornOverlap) * (own.radius + c.radius))
          return true;
    return false;
  });
}

/// Age from which a cell counts as grown, s. Daughters begin at half the distance in one model that
/// they begin at in the other, and spheres part for hours.
constexpr double kGrownAge = 12 * 3600;

using Births = std::map<std::int64_t, double>;  ///< s, of cells that were not there at the start

/// First time of every cell that comes after the first frame.
Births find_births(const std::vector<JudgedFrame>& frames) {
  Births births;
  for (const JudgedFrame& f : frames)
    for (const auto& [id, c] : f.cells)
      if (!frames.front().cells.contains(id)) births.try_emplace(id, f.time);
  return births;
}

/// Mean relative density from the distances of the six nearest neighbours of each cell, up to a
/// factor; of cells born up to a time.
double mean_density(const JudgedCells& cells, const Births& births, double born_by) {
  constexpr std::size_t kNeighbours = 6;
  double sum = 0;
  int n = 0;
  for (const auto& [id, c] : cells) {
    if (const auto birth = births.find(id); birth != births.end() && birth->second > born_by)
      continue;
    std::vector<double> distance;
    for (const auto& [other, o] : cells)
      if (other != id) distance.push_back((o.center - c.center).norm());
    if (distance.size() < kNeighbours) continue;
    std::ranges::nth_element(distance, distance.begin() + (kNeighbours - 1));
    double near = 0;
    for (std::size_t k = 0; k < kNeighbours; ++k) near += distance[k] / kNeighbours;
    sum += std::pow(c.radius / near, 3);
    ++n;
  }
  return n > 0 ? sum / n : 0;
}

/// Sums of differences, of reference values, and of their squares.
struct Misfit {
  double squares = 0, reference = 0, difference = 0, expected_sum = 0;
  int count = 0;
  void add(double value, double expected) {
    difference += value - expected;
    expected_sum += expected;
    squares += (value - expected) * (value - expected);
    reference += expected * expected;
    ++count;
  }
  double rms() const { return std::sqrt(squares / std::max(1, count)); }
  double relative() const { return std::sqrt(squares / reference); }
  /// Relative, with its sign; 0 without a reference.
  double bias() const { return expected_sum != 0 ? difference / expected_sum : 0; }
};

template <class Get>
double mean_of(const JudgedCells& cells, Get get) {
  double sum = 0;
  for (const auto& [id, c] : cells) sum += get(c);
  return sum / static_cast<double>(std::max<std::size_t>(1, cells.size()));
}

/// Compares two series of frames, with errors as rms and with their signs.
/// @param spheres  frames at the same times; single cells are compared where both have them
BenchRow compare(const std::string& name, const std::vector<JudgedFrame>& deformable,
                 const std::vector<JudgedFrame>& spheres) {
  constexpr double kPa = 1e3;
  Misfit pressure, force, area, density, grown, single;
  const Births born = find_births(deformable), born_spheres = find_births(spheres);
  double mean = 0, expected = 0;
  const std::size_t n = std::min(deformable.size(), spheres.size());
  for (std::size_t k = 0; k < n; ++k) {
    const JudgedCells &is = spheres[k].cells, &should = deformable[k].cells;
    const auto add = [&](Misfit& m, auto get) { m.add(mean_of(is, get), mean_of(should, get)); };
    const auto pressure_of = [](const JudgedCell& c) { return kPa * c.pressure; };
    add(pressure, pressure_of);
    add(force, [](const JudgedCell& c) { return c.normal_force; });
    add(area, [](const JudgedCell& c) { return c.contact_area; });
    const auto add_density = [&](Misfit& m, double born_by) {
      m.add(mean_density(is, born_spheres, born_by), mean_density(should, born, born_by));
    };
    add_density(density, deformable[k].time);
    add_density(grown, deformable[k].time - kGrownAge);
    mean += mean_of(is, pressure_of) / static_cast<double>(n);
    expected += mean_of(should, pressure_of) / static_cast<double>(n);
    for (const auto& [id, c] : should)
      if (const auto found = is.find(id); found != is.end())
        single.add(pressure_of(found->second), pressure_of(c));
  }
  const int cells = n > 0 ? static_cast<int>(deformable[n - 1].cells.size()) : 0;
  return {name,
          cells,
          {{"frames", static_cast<double>(n)},
           {"deformable_Pa", expected},
           {"spheres_Pa", mean},
           {"pressure_error", pressure.relative()},
           {"pressure_error_Pa", pressure.rms()},
           {"cell_pressure_error", single.relative()},
           {"cell_pressure_error_Pa", single.rms()},
           {"normal_force_error", force.relative()},
           {"contact_area_error", area.relative()},
           {"contact_area_bias", area.bias()},
           {"density_error", density.relative()},
           {"density_bias", density.bias()},
           {"density_bias_grown", grown.bias()}}};
}

/// Scene to judge laws in, with its run of deformable cells.
struct Judged {
  std::string name;
  runs::Scene scene;       ///< with spheres
  std::string deformable;  ///< run folder
  std::vector<SphereLaw> laws;
};

void run(const runs::Scene& scene, const std::string& folder, int threads) {
  const int code =
      runs::run_stage(scene, {folder, threads, true, false, "acinus bench out-of-sample"});
  check(code == static_cast<int>(Exit::kDone) || code == static_cast<int>(Exit::kCannotContinue),
        fmt::format("bench out-of-sample: the run in {} ended with exit code {}", folder, code),
        Exit::kCannotContinue);
}

void judge_in_place(const Judged& j, BenchTable& table) {
  std::vector<JudgedFrame> frames = read_frames(j.deformable);
  const bool divides = std::ranges::any_of(
      j.scene.cell_types, [](const auto& type) { return type.second.cycle.time > 0; });
  if (divides) leave_out_births(frames);
  const coupling::World world = runs::build_world(j.scene, Ranks::serial()).world;
  for (const SphereLaw& law : j.laws) {
    std::vector<JudgedFrame> spheres;
    for (const JudgedFrame& f : frames)
      spheres.push_back({f.time, compute_in_place(f.cells, f.time, law, world)});
    table.push_back(compare(fmt::format("{}, {}, in place", j.name, law.name), frames, spheres));
    print_row(table.back());
  }
}

/// Mean row of several seeds, with the standard deviations of what a law is judged by.
BenchRow average(const std::vector<BenchRow>& seeds) {
  BenchRow out = seeds.front();
  const auto n = static_cast<double>(seeds.size());
  std::vector<std::pair<std::string, double>> deviation{{"seeds", n}};
  for (std::size_t k = 0; k < out.value.size(); ++k) {
    auto& [key, mean] = out.value[k];
    mean = 0;
    for (const BenchRow& row : seeds) mean += row.value[k].second / n;
    if (seeds.size() == 1 || !(key.ends_with("_Pa") || key.find("_bias") != std::string::npos))
      continue;
    double squares = 0;
    for (const BenchRow& row : seeds) squares += std::pow(row.value[k].second - mean, 2);
    deviation.emplace_back("sd_" + key, std::sqrt(squares / (n - 1)));
  }
  out.value.insert(out.value.end(), deviation.begin(), deviation.end());
  return out;
}

/// Rows of spheres by themselves, without a law and with it.
/// @param seeds  the same tissue from several seeds
void judge_by_themselves(const std::vector<Judged>& seeds, const std::string& law_file, int threads,
                         BenchTable& table) {
  struct SphereRun {
    const char* name;
    std::string law;
  };
  for (const SphereRun& r : {SphereRun{"plain", "none"}, SphereRun{"table", law_file}}) {
    std::vector<BenchRow> rows;
    for (const Judged& j : seeds) {
      const std::string folder = fmt::format("{}_{}", j.deformable, r.name);
      run(runs::as_spheres(j.scene, r.law), folder, threads);
      rows.push_back(compare(fmt::format("{}, {}, by themselves", j.name, r.name),
                             read_frames(j.deformable), read_frames(folder)));
    }
    table.push_back(average(rows));
    print_row(table.back());
  }
}

/// Law for cells of 12 um, from its file, or calibrated if that is missing.
calibration::Law provide_law(const std::string& file, int threads) {
  if (!std::filesystem::exists(file)) {
    runs::CalibrateOptions options;
    options.out = file;
    options.calibration.relaxation = false;
    options.threads = threads;
    options.command_line = "acinus bench out-of-sample";
    const int stop =
        runs::calibrate(runs::read_scene(runs::scene_folder() + "/calibration.json"), options);
    check(stop == 0, "bench out-of-sample: the calibration was stopped", Exit::kCannotContinue);
  }
  return calibration::read_law(file);
}

/// Clump of the calibration itself.
Judged in_sample(const std::string& root) {
  const runs::Scene scene =
      runs::compression_scene(runs::read_scene(runs::scene_folder() + "/calibration.json"), {});
  return {"clump in a capsule (in sample)",
          runs::as_spheres(scene, "none"),
          root + "/law.calibration/compression_dcm",
          {}};
}

}  // namespace

BenchTable bench_out_of_sample(const BenchOptions& options) {
  const std::string root =
      options.folder.empty() ? "out-of-sample" : options.folder + "/out-of-sample";
  std::filesystem::create_directories(root);
  const calibration::Law law = provide_law(root + "/law.json", options.threads);
  const OutOfSampleCells cells{options.radius, options.stiffness};
  BenchTable table;
  Judged clump = in_sample(root);
  const runs::CellType& type = clump.scene.cell_types.begin()->second;
  clump.laws = sphere_laws(law, runs::make_cbm_params(clump.scene, type).young);
  judge_in_place(clump, table);
  for (const OutOfSampleScene& s : out_of_sample_scenes(cells)) {
    std::vector<Judged> seeds;
    for (int seed = options.first; seed < options.first + options.seeds; ++seed) {
      runs::Scene scene = s.scene;
      scene.seed = static_cast<std::uint64_t>(seed);
      const std::string folder =
          fmt::format("{}/{}_{:g}_{:g}_{}", root, s.name, cells.radius, cells.stiffness, seed);
      run(scene, folder, options.threads);
      seeds.push_back({s.name, runs::as_spheres(scene, "none"), folder, clump.laws});
    }
    judge_in_place(seeds.front(), table);
    if (s.spheres_too) judge_by_themselves(seeds, root + "/law.json", options.threads, table);
  }
  return table;
}

}  // namespace acinus::bench
