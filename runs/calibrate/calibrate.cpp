#include "runs/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

#include "acinus_version.hpp"
#include "calibration/clump.hpp"
#include "calibration/law_file.hpp"
#include "calibration/wall.hpp"
#include "core/error.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/file_lock.hpp"
#include "runs/build/build_correction.hpp"
#include "runs/build/build_params.hpp"
#include "runs/build/build_world.hpp"
#include "runs/build/read_cells.hpp"
#include "runs/build/state_file.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/stage.hpp"
#include "runs/session/stop_signals.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

/// Largest overlap from which on a squeeze that ended early still says how cells stiffen.
constexpr double kWorthFitting = 0.15;

/// Force over overlap, means over inner cells.
calibration::Curve curve(const std::vector<calibration::Moment>& history,
                         const std::vector<std::size_t>& inner) {
  std::vector<double> overlap, force;
  for (const calibration::Bulk& b : calibration::measure_bulks(history, inner)) {
    overlap.push_back(b.overlap);
    force.push_back(b.force);
  }
  return calibration::loading_branch(overlap, force);
}

/// Runs of one calibration.
class Stages {
 public:
  Stages(const Scene& scene, const CalibrateOptions& options)
      : options_(options),
        folder_(fs::path(options.out).replace_extension(".calibration").string()),
        squeeze_(squeeze_scene(scene, options.clump)) {}

  const Scene& squeeze() const { return squeeze_; }
  const std::string& folder() const { return folder_; }
  std::string path(const char* name) const { return folder_ + "/" + name; }

  void say(const std::string& text) const {
    if (!options_.quiet) fmt::print("calibrate: {}\n", text);
    std::fflush(stdout);
  }

  int run(const Scene& scene, const char* name, bool quiet, bool fresh = false) const {
    return run_stage(scene, {path(name), options_.threads, quiet || options_.quiet,
                             fresh || options_.fresh, options_.command_line});
  }

  /// Whether a squeeze that could not go on reached overlaps that are worth a fit.
  bool got_far(int code, const char* name) const {
    if (code != static_cast<int>(Exit::kCannotContinue)) return false;
    const std::vector<calibration::Moment> history = moments(name);
    const double reached = curve(history, inner_cells(history)).overlap.back();
    if (reached < kWorthFitting) return false;
    say(fmt::format("the squeeze ended early, at d = {:.3f}: the law is fitted up to there",
                    reached));
    return true;
  }

  /// The cells of every frame of a squeeze.
  std::vector<calibration::Moment> moments(const char* name) const {
    const RunSummary summary = read_summary(path(name));
    const io::RunReader reader(summary.folder + "/run.vtkhdf");
    const std::vector<double>& capsule = series(summary, "capsule_radius_um");
    check(reader.n_frame() == static_cast<int>(capsule.size()),
          fmt::format("{}: {} frames and {} samples do not go together. Calibrate without "
                      "output.start_up",
                      summary.folder, reader.n_frame(), capsule.size()));
    std::vector<calibration::Moment> out(capsule.size());
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k].capsule = capsule[k];
      const io::Table cells = reader.cells(static_cast<int>(k));
      out[k].radius = cell_column(cells, "radius", summary.folder);
      out[k].force = cell_column(cells, "normal_force", summary.folder);
      const std::vector<double>& center = cell_column(cells, "center", summary.folder);
      for (std::size_t i = 0; i < center.size(); i += 3)
        out[k].center.emplace_back(center[i], center[i + 1], center[i + 2]);
    }
    return out;
  }

  std::vector<std::size_t> inner_cells(const std::vector<calibration::Moment>& history) const {
    return calibration::find_inner_cells(history, squeeze_.capsule.center);
  }

 private:
  const CalibrateOptions& options_;
  std::string folder_;
  Scene squeeze_;
};

/// d of the central cell when its clump has come to rest and nothing presses it yet: where its
/// contact pressure is smallest after the first tenth of the time.
double overlap_at_rest(const RunSummary& squeeze) {
  const std::vector<double>& pressure = series(squeeze, "pressure_Pa");
  const auto first = pressure.begin() + static_cast<std::ptrdiff_t>(pressure.size() / 10);
  const auto least = std::min_element(first, pressure.end());
  return series(squeeze, "overlap")[static_cast<std::size_t>(least - pressure.begin())];
}

/// Squeezes spheres with the law until they bear what the cells do in a capsule as wide: each time
/// they meet it later by as much as theirs is too wide.
/// @return exit code of a run that was stopped or failed, else 0
int squeeze_corrected(const Stages& stages, const calibration::Squeeze& cells, double highest,
                      calibration::Law& law, Calibration& found) {
  constexpr int kRounds = 5;
  constexpr double kClose = 0.01;  // of a radius
  const double radius = stages.squeeze().cell_types.begin()->second.radius;
  const std::string file = stages.path("law.json");
  for (int round = 1;; ++round) {
    calibration::write_law(law, file);
    // Another law may stand in the file of an earlier attempt.
    const int stop =
        stages.run(as_spheres(stages.squeeze(), file), "squeeze_corrected", true, true);
    if (stop != 0 && stop != static_cast<int>(Exit::kCannotContinue)) return stop;
    if (stop != 0) stages.say("these spheres could not be squeezed to the end");
    const std::vector<calibration::Moment> spheres = stages.moments("squeeze_corrected");
    found.corrected = curve(spheres, cells.inner);
    found.capsule_excess = calibration::capsule_excess(cells, spheres, highest);
    check(
        std::isfinite(found.capsule_excess),
        "calibration: corrected spheres never bear what the deformable cells do, the law does not "
        "hold for them. Squeeze less far (capsule.min_radius) or take another clump (--cells)",
        Exit::kCannotContinue);
    if (std::abs(found.capsule_excess) < kClose * radius) return 0;
    const double recess =
        std::clamp(law.wall_recess + found.capsule_excess / radius, 0.0, cbm::kLargestRecess);
    if (round == kRounds || recess == law.wall_recess) {
      stages.say("the capsule of the corrected spheres could not be made as wide");
      return 0;
    }
    law.wall_recess = recess;
  }
}

/// The squeezed deformable cells of the end of a run.
coupling::World squeezed_world(const Scene& squeeze, const std::string& folder) {
  coupling::World world = build_world(squeeze, Ranks::serial()).world;
  get_state(io::load_checkpoint(folder).data, world.state);
  return world;
}

void relax(const Stages& stages, const CalibrateOptions& options, Calibration& found) {
  const coupling::World world = squeezed_world(stages.squeeze(), stages.path("squeeze_dcm"));
  found.friction_before = world.params.dcm_contact.cell_friction;
  stages.say("letting the clump go");
  found.relaxation.push_back(calibration::relax_clump(world, 1));
  coupling::World slow = world;
  calibration::scale_all_friction(slow.params, 5);
  found.relaxation.push_back(calibration::relax_clump(slow, 5));
  if (options.check_friction > 0) {
    coupling::World other = world;
    other.params.dcm_contact.cell_friction = options.check_friction;
    found.checked = {options.check_friction,
                     calibration::relax_clump(
                         other, std::max(1.0, options.check_friction / found.friction_before))};
    return;
  }
  if (options.relaxation_time == 0) return;
  stages.say(fmt::format("looking for the friction that makes it take {:.3g} h",
                         options.relaxation_time / 3600));
  found.friction = calibration::fit_friction(world, options.relaxation_time);
}

std::map<std::string, std::string> provenance(const Scene& squeeze, const Calibration& found,
                                              const CalibrateOptions& options) {
  return {{"version", ACINUS_VERSION},
          {"git", ACINUS_GIT},
          {"command_line", options.command_line},
          {"form", found.attempts.back().form},
          {"cells", std::to_string(squeeze.cells.count)},
          {"seed", std::to_string(squeeze.seed)},
          {"scene_sha", squeeze.sha}};
}

std::string cache_folder() {
  if (const char* base = std::getenv("XDG_CACHE_HOME"); base != nullptr && *base != '\0')
    return std::string(base) + "/acinus/laws";
  const char* home = std::getenv("HOME");
  check(home != nullptr && *home != '\0',
        "stiffness_correction \"auto\" keeps laws in XDG_CACHE_HOME or ~/.cache, but neither "
        "XDG_CACHE_HOME nor HOME is set. Calibrate yourself and name the law file.");
  return std::string(home) + "/.cache/acinus/laws";
}

/// Two processes must not calibrate the same law: they would write in the same run folders.
/// Nothing if it was asked to stop meanwhile.
std::optional<io::FileLock> lock_law(const std::string& file, bool quiet) {
  std::error_code code;
  fs::create_directories(fs::path(file).parent_path(), code);
  const std::string lock = file + ".lock";
  if (auto held = io::FileLock::try_take(lock)) return held;
  if (!quiet) fmt::print("calibrate: waiting for another process that calibrates this law\n");
  std::fflush(stdout);
  constexpr double kLook = 0.2;  // s between looks at signals
  const StopSignals signals;
  while (stop_signal() == 0)
    if (auto held = io::FileLock::try_take(lock, kLook)) return held;
  return {};
}

/// The scene by which "auto" calibrates: what a law stands for, and nothing that only says how a
/// scene is computed, so that it does not matter which scene asks first.
Scene made_for_law(const Scene& scene) {
  Scene s;
  s.file = scene.file;
  s.cell_types = scene.cell_types;
  s.contact.quadrature = scene.contact.quadrature;
  s.contact.repulsion = scene.contact.repulsion;
  s.contact.range = scene.contact.range;
  s.contact.max_depth = scene.contact.max_depth;
  return s;
}

/// Name of a law in the cache: all it depends on, to the last digit.
std::string key_of(const Scene& scene, const LawParameters& p) {
  std::string text =
      fmt::format("{}\n{} {:a} {:a}\n", calibration::kLawSchema, scene.contact.quadrature,
                  scene.contact.range.value_or(-1), scene.contact.max_depth);
  for (const auto* model : {&p.dcm, &p.cbm})
    for (const auto& [name, value] : *model) text += fmt::format("{} {:a}\n", name, value);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

}  // namespace

int calibrate(const Scene& scene, const CalibrateOptions& options) {
  const Stages stages(scene, options);
  if (options.threads > 0) omp_set_num_threads(options.threads);
  std::error_code code;
  fs::create_directories(stages.folder(), code);
  check(!code, fmt::format("{}: cannot be made: {}", stages.folder(), code.message()),
        Exit::kFileError);
  const Scene& squeeze = stages.squeeze();
  Calibration found;

  stages.say(fmt::format("squeezing {} deformable cells ({})", squeeze.cells.count,
                         stages.path("squeeze_dcm")));
  if (const int stop = stages.run(squeeze, "squeeze_dcm", false);
      stop != 0 && !stages.got_far(stop, "squeeze_dcm"))
    return stop;
  stages.say("squeezing spheres without correction");
  const Scene spheres = as_spheres(squeeze, "none");
  if (const int stop = stages.run(spheres, "squeeze_cbm", true)) return stop;
  calibration::Squeeze cells{stages.moments("squeeze_dcm"), {}};
  cells.inner = stages.inner_cells(cells.moment);
  found.inner = static_cast<int>(cells.inner.size());
  found.dcm = curve(cells.moment, cells.inner);
  found.plain = curve(stages.moments("squeeze_cbm"), cells.inner);
  const RunSummary history = read_summary(stages.path("squeeze_dcm"));
  found.contacts_first = series(history, "contacts").front();
  found.contacts_last = series(history, "contacts").back();
  found.overlap_at_rest = overlap_at_rest(history);

  stages.say("fitting the law");
  const std::string type = choose_type(scene, options.clump.type);
  const LawParameters parameters = law_parameters(scene, scene.cell_types.at(type));
  found.attempts = calibration::fit_law(
      cells, make_cbm_params(squeeze, squeeze.cell_types.at(type)), options.fit);
  calibration::Law law = found.attempts.back().law;
  law.dcm = parameters.dcm;
  law.cbm = parameters.cbm;
  law.provenance = provenance(squeeze, found, options);
  stages.say("squeezing corrected spheres");
  if (const int stop = squeeze_corrected(stages, cells, options.fit.highest, law, found))
    return stop;
  found.wall_recess = law.wall_recess;
  found.error_plain = calibration::relative_error(found.dcm, found.plain, options.fit.highest);
  found.error_corrected =
      calibration::relative_error(found.dcm, found.corrected, options.fit.highest);
  if (options.relaxation) {
    try {
      relax(stages, options, found);
    } catch (const Error& error) {  // the law does not depend on it
      found.relaxation.clear();
      stages.say(fmt::format("no relaxation time: {}", error.what()));
    }
  }

  write_curves(found, stages.folder());
  calibration::write_law(law, options.out);
  if (!options.quiet) fmt::print("{}", calibration_table(squeeze, found, options.out));
  return 0;
}

int resolve_corrections(Scene& scene, int threads, bool quiet) {
  for (auto& [name, type] : scene.cell_types) {
    if (type.cbm.stiffness_correction != "auto") continue;
    const std::string file =
        cache_folder() + "/" + key_of(scene, law_parameters(scene, type)) + ".json";
    std::error_code code;
    if (!fs::exists(file, code)) {
      const std::optional<io::FileLock> calibrating = lock_law(file, quiet);
      if (!calibrating) return static_cast<int>(Exit::kStopped);
      if (fs::exists(file, code)) {  // another process was faster
        type.cbm.stiffness_correction = file;
        continue;
      }
      CalibrateOptions options;
      options.clump.type = name;
      options.out = file;
      options.relaxation = false;
      options.threads = threads;
      options.quiet = quiet;
      options.command_line = "stiffness_correction auto";
      if (const int stop = calibrate(made_for_law(scene), options)) return stop;
    }
    type.cbm.stiffness_correction = file;
  }
  return 0;
}

}  // namespace acinus::runs
