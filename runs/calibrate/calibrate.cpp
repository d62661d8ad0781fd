#include "runs/calibrate/calibrate.hpp"

#include <fmt/format.h>
#include <omp.h>
#include <xxhash.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "acinus_version.hpp"
#include "calibration/clump.hpp"
#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "core/io/checkpoint.hpp"
#include "core/io/run_reader.hpp"
#include "runs/build_correction.hpp"
#include "runs/build_world.hpp"
#include "runs/read_summary.hpp"
#include "runs/stage.hpp"
#include "runs/state_file.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

/// Largest overlap from which on a squeeze that ended early still says how cells stiffen.
constexpr double kWorthFitting = 0.15;

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
    const double reached = curve(name).overlap.back();
    if (reached < kWorthFitting) return false;
    say(fmt::format("the squeeze ended early, at d = {:.3f}: the law is fitted up to there",
                    reached));
    return true;
  }

  calibration::Curve curve(const char* name) const {
    const RunSummary s = read_summary(path(name));
    return calibration::loading_branch(series(s, "overlap"), series(s, "normal_force_nN"));
  }

 private:
  const CalibrateOptions& options_;
  std::string folder_;
  Scene squeeze_;
};

/// The cells of every frame of a squeeze, and what its central cell felt.
std::vector<calibration::Moment> read_moments(const RunSummary& squeeze) {
  const io::RunReader reader(squeeze.folder + "/run.vtkhdf");
  const std::vector<double>&force = series(squeeze, "normal_force_nN"),
        &capsule = series(squeeze, "capsule_radius_um");
  std::vector<calibration::Moment> moments(force.size());
  for (std::size_t k = 0; k < force.size(); ++k) {
    moments[k].force = force[k];
    moments[k].capsule = capsule[k];
    const io::Table cells = reader.cells(static_cast<int>(k));
    for (const io::Column& c : cells.columns) {
      if (c.name == "radius") moments[k].radius = c.value;
      for (std::size_t i = 0; c.name == "center" && i < c.value.size(); i += 3)
        moments[k].center.emplace_back(c.value[i], c.value[i + 1], c.value[i + 2]);
    }
  }
  return moments;
}

/// d of the central cell when its clump has come to rest and nothing presses it yet: where its
/// contact pressure is smallest after the first tenth of the time.
double overlap_at_rest(const RunSummary& squeeze) {
  const std::vector<double>& pressure = series(squeeze, "pressure_Pa");
  const auto first = pressure.begin() + static_cast<std::ptrdiff_t>(pressure.size() / 10);
  const auto least = std::min_element(first, pressure.end());
  return series(squeeze, "overlap")[static_cast<std::size_t>(least - pressure.begin())];
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

/// Name of a law in the cache: the constants it depends on, to the last digit.
std::string key_of(const LawParameters& p) {
  std::string text = fmt::format("{}\n", calibration::kLawSchema);
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
  found.dcm = stages.curve("squeeze_dcm");
  found.plain = stages.curve("squeeze_cbm");
  const RunSummary history = read_summary(stages.path("squeeze_dcm"));
  found.contacts_first = series(history, "contacts").front();
  found.contacts_last = series(history, "contacts").back();
  found.overlap_at_rest = overlap_at_rest(history);

  stages.say("fitting the law");
  const std::string type = choose_type(scene, options.clump.type);
  const LawParameters parameters = law_parameters(scene, scene.cell_types.at(type));
  found.attempts = calibration::fit_law(read_moments(history),
                                        make_cbm_params(squeeze, squeeze.cell_types.at(type)),
                                        squeeze.capsule.center, options.fit);
  calibration::Law law = found.attempts.back().law;
  law.dcm = parameters.dcm;
  law.cbm = parameters.cbm;
  law.provenance = provenance(squeeze, found, options);
  const std::string law_file = stages.path("law.json");
  calibration::write_law(law, law_file);

  stages.say("squeezing corrected spheres");
  // Another law may stand in the file of an earlier attempt.
  if (const int stop = stages.run(as_spheres(squeeze, law_file), "squeeze_corrected", true, true))
    return stop;
  found.corrected = stages.curve("squeeze_corrected");
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
    const std::string file = cache_folder() + "/" + key_of(law_parameters(scene, type)) + ".json";
    std::error_code code;
    if (!fs::exists(file, code)) {
      CalibrateOptions options;
      options.clump.type = name;
      options.out = file;
      options.relaxation = false;
      options.threads = threads;
      options.quiet = quiet;
      options.command_line = "stiffness_correction auto";
      if (const int stop = calibrate(scene, options)) return stop;
    }
    type.cbm.stiffness_correction = file;
  }
  return 0;
}

}  // namespace acinus::runs
