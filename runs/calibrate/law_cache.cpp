#include "runs/calibrate/law_cache.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "io/file_lock.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/calibrate/calibrate_scene.hpp"
#include "runs/scene/key_values.hpp"
#include "runs/scene/registry_blocks.hpp"
#include "runs/session/read_summary.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

std::string cache_folder() {
  if (const char* base = std::getenv("XDG_CACHE_HOME"); base != nullptr && *base != '\0')
    return std::string(base) + "/acinus/laws";
  const char* home = std::getenv("HOME");
  check(home != nullptr && *home != '\0',
        "stiffness_correction \"auto\" keeps laws in XDG_CACHE_HOME or ~/.cache, but neither "
        "XDG_CACHE_HOME nor HOME is set. Calibrate yourself and name the law file.");
  return std::string(home) + "/.cache/acinus/laws";
}

/// Takes the lock of a law in the cache. Concurrent calibrations of one law would write to the same
/// run folders.
/// @return empty if a stop signal came while waiting
std::optional<io::FileLock> lock_law(const std::string& file, bool quiet) {
  std::error_code code;
  fs::create_directories(fs::path(file).parent_path(), code);
  const std::string lock = file + ".lock";
  if (auto held = io::FileLock::try_take(lock)) return held;
  if (!quiet) fmt::print("calibrate: waiting for another process that calibrates this law\n");
  std::fflush(stdout);
  constexpr double kLockPollInterval = 0.2;  // s between checks for signals
  const StopSignals signals;
  while (!stop_requested())
    if (auto held = io::FileLock::try_take(lock, kLockPollInterval)) return held;
  return {};
}

/// Scene by which "auto" calibrates: the keys of its cells and contact that the law depends on, all
/// else as by default, so that any scene that asks first gets the same law.
Scene made_for_law(const Scene& scene) {
  const auto in_law = [](const Key& key) { return key.in_law != InLaw::kNo; };
  Scene s;
  s.file = scene.file;
  s.cell_types = scene.cell_types;
  put_values(
      take_contact(scene.contact, in_law),
      [&s](Visitor& visitor) { describe_contact(visitor, s.contact); }, in_law);
  return s;
}

/// Name of a law in the cache: a hash of all it depends on, to the last digit.
std::string key_of(const Scene& scene, const LawParameters& p) {
  std::string text = fmt::format("{}\n{}\n{}\n", calibration::kLawSchema, calibration::kLawMethod,
                                 fmt::join(law_settings(scene.contact), " "));
  for (const auto* model : {&p.dcm, &p.cbm})
    for (const auto& [name, value] : *model) text += fmt::format("{} {:a}\n", name, value);
  return fmt::format("{:016x}", XXH64(text.data(), text.size(), 0));
}

/// Cause of failure of a calibration, from the summaries of its runs.
std::string find_failure(const std::string& law_file) {
  const fs::path folder = fs::path(law_file).replace_extension(".calibration");
  std::error_code code;
  for (const fs::directory_entry& run : fs::directory_iterator(folder, code)) {
    if (!fs::exists(run.path() / "summary.json", code)) continue;
    const RunSummary summary = read_summary(run.path().string());
    if (summary.status == RunOutcome::kFailed) return summary.cause;
  }
  return "see the runs in " + folder.string();
}

}  // namespace

int resolve_corrections(Scene& scene, int threads, bool quiet) {
  if (!may_have_spheres(scene)) return 0;
  use_shipped_laws(scene);
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
      options.calibration.relaxation = false;
      options.threads = threads;
      options.quiet = quiet;
      options.command_line = "stiffness_correction auto";
      const int stop = calibrate(made_for_law(scene), options);
      check(stop != static_cast<int>(Exit::kCannotContinue),
            fmt::format("cell_types.{}: no law of its spheres could be calibrated: {}", name,
                        find_failure(file)),
            Exit::kCannotContinue);
      if (stop != 0) return stop;
    }
    type.cbm.stiffness_correction = file;
  }
  return 0;
}

}  // namespace acinus::runs
