#include "runs/calibrate/calibrate_scene.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "acinus_version.hpp"
#include "calibration/calibration_report.hpp"
#include "calibration/law_file.hpp"
#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "core/parallel/threads.hpp"
#include "io/checkpoint.hpp"
#include "runs/assemble/build_params.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/law_parameters.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/assemble/state_file.hpp"
#include "runs/experiments/pull_off_experiment.hpp"
#include "runs/session/read_summary.hpp"
#include "runs/session/stage.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;
using calibration::ClumpModel;
using calibration::CompressionRun;

/// Reads all cells of one frame.
calibration::ClumpSnapshot read_snapshot(const io::RunReader& reader, int frame,
                                         const std::string& folder) {
  calibration::ClumpSnapshot out;
  const io::Table cells = reader.cells(frame);
  out.radius = cell_column(cells, "radius", folder);
  out.force = cell_column(cells, "normal_force", folder);
  const std::vector<double>& center = cell_column(cells, "center", folder);
  for (std::size_t i = 0; i < center.size(); i += 3)
    out.center.emplace_back(center[i], center[i + 1], center[i + 2]);
  return out;
}

/// Reads all cells of every frame of a compression run.
std::vector<calibration::ClumpSnapshot> read_snapshots(const RunSummary& run) {
  const io::RunReader reader(run.folder + "/run.vtkhdf");
  const std::vector<double>& capsule = series(run, "capsule_radius_um");
  check(reader.n_frame() == static_cast<int>(capsule.size()),
        fmt::format("{}: {} frames and {} samples do not go together. Calibrate without "
                    "output.start_up",
                    run.folder, reader.n_frame(), capsule.size()));
  std::vector<calibration::ClumpSnapshot> out(capsule.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = read_snapshot(reader, static_cast<int>(k), run.folder);
    out[k].capsule = capsule[k];
  }
  return out;
}

/// Reads the central cell of every frame, with the quantities a stiffness law is fitted to.
std::vector<calibration::ClumpSample> read_central(const RunSummary& run) {
  const std::vector<double>&overlap = series(run, "overlap"), &contacts = series(run, "contacts"),
        &pressure = series(run, "pressure_Pa");
  std::vector<calibration::ClumpSample> out(overlap.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k].overlap = overlap[k];
    out[k].contacts = contacts[k];
    out[k].pressure = 1e-3 * pressure[k];
  }
  return out;
}

/// Reads how far two layers have slid in every frame.
calibration::Slide read_slide(const std::string& folder) {
  const io::RunReader reader(folder + "/run.vtkhdf");
  calibration::Slide out;
  std::vector<Vec3> first;
  double start = 0;
  for (int k = 0; k < reader.n_frame(); ++k) {
    const calibration::ClumpSnapshot now = read_snapshot(reader, k, folder);
    if (k == 0) first = now.center;
    const double offset = calibration::offset_of_layers(first, now.center);
    if (k == 0) start = offset;
    out.time.push_back(reader.time_s(k));
    out.slid.push_back(offset - start);
  }
  return out;
}

/// Run folders of one calibration.
class Folders {
 public:
  Folders(const Scene& compression, const CalibrateOptions& options)
      : compression_(compression),
        options_(options),
        folder_(fs::path(options.out).replace_extension(".calibration").string()) {
    std::error_code code;
    fs::create_directories(folder_, code);
    check(!code, fmt::format("{}: cannot be made: {}", folder_, code.message()), Exit::kFileError);
  }

  const std::string& folder() const { return folder_; }

  calibration::Runs runs() const {
    return {.compress = [this](ClumpModel model,
                               const calibration::Law& law) { return compress(model, law); },
            .join_pair = [this] { return join_pair(); },
            .pull_pairs = [this] { return pull_pairs(); },
            .slide = [this](ClumpModel model,
                            const calibration::Law& law) { return slide(model, law); },
            .compressed_world = [this] { return compressed_world(); },
            .say = [this](const std::string& text) { say(text); }};
  }

 private:
  struct How {
    bool quiet = false, fresh = false;
    bool whole = false;  ///< run anew instead of resuming, for runs that cannot be continued
  };

  CompressionRun compress(ClumpModel model, const calibration::Law& law) const {
    if (model == ClumpModel::kDeformable) {
      say(fmt::format("compressing {} deformable cells ({})", compression_.cells.count,
                      path(kDeformable)));
      return run(compression_, kDeformable, {options_.quiet, options_.fresh});
    }
    if (model == ClumpModel::kSpheres) {
      say("compressing spheres without correction");
      return run(as_spheres(compression_, "none"), "compression_cbm",
                 {.quiet = true, .fresh = options_.fresh, .whole = true});
    }
    write_law_of_clump(law);
    // Another law may stand in the file of an earlier attempt.
    return run(as_spheres(compression_, path("law.json")), "compression_corrected",
               {.quiet = true, .fresh = true});
  }

  /// Writes the law as one for the clump, whose surfaces may be stiffer than those of the cells
  /// that the law is for.
  void write_law_of_clump(calibration::Law law) const {
    law.dcm = law_parameters(compression_, compression_.cell_types.begin()->second).dcm;
    calibration::write_law(law, path("law.json"));
  }

  CompressionRun run(const Scene& scene, const char* name, const How& how) const {
    CompressionRun out;
    out.exit = run_stage(
        scene, {path(name), options_.threads, how.quiet, how.fresh, options_.command_line});
    const bool cut_short = out.exit == static_cast<int>(Exit::kCannotContinue);
    if (out.exit != 0 && (how.whole || !cut_short)) return out;
    const RunSummary summary = read_summary(path(name));
    out.snapshots = read_snapshots(summary);
    out.central = read_central(summary);
    return out;
  }

  CompressionRun join_pair() const {
    say("letting two deformable cells adhere");
    CompressionRun out;
    out.exit = run_stage(pair_scene(compression_), {path(kPair), options_.threads, true,
                                                    options_.fresh, options_.command_line});
    if (out.exit != 0) return out;
    const io::RunReader reader(path(kPair) + "/run.vtkhdf");
    out.snapshots.push_back(read_snapshot(reader, reader.n_frame() - 1, path(kPair)));
    return out;
  }

  calibration::PullRun pull_pairs() const {
    calibration::PullRun out;
    for (int k = 0; k < kPulledPairs; ++k) {
      const std::string folder = path(fmt::format("pull_off_{}", k + 1).c_str());
      out.exit =
          run_stage(pull_scene(compression_, compression_.seed + static_cast<std::uint64_t>(k)),
                    {folder, options_.threads, true, options_.fresh, options_.command_line});
      if (out.exit != 0) return out;
      if (const std::optional<double> force = pull_off_force(read_summary(folder).measures))
        out.force.push_back(*force);
    }
    return out;
  }

  calibration::SlidingRun slide(ClumpModel model, const calibration::Law& law) const {
    Scene scene = sliding_scene(compression_);
    const bool deformable = model == ClumpModel::kDeformable;
    if (!deformable) {
      write_law_of_clump(law);
      scene = as_spheres(scene, path("law.json"));
    }
    const std::string folder = path(deformable ? "sliding_dcm" : "sliding_corrected");
    calibration::SlidingRun out;
    out.exit = run_stage(scene, {folder, options_.threads, true, options_.fresh || !deformable,
                                 options_.command_line});
    if (out.exit == 0) out.slide = read_slide(folder);
    return out;
  }

  coupling::World compressed_world() const {
    coupling::World world = build_world(compression_, Ranks::serial()).world;
    get_state(io::load_checkpoint(path(kDeformable)).data, types_of(world.params), world.state);
    return world;
  }

  void say(const std::string& text) const {
    if (!options_.quiet) fmt::print("calibrate: {}\n", text);
    std::fflush(stdout);
  }

  std::string path(const char* name) const { return folder_ + "/" + name; }

  static constexpr const char* kDeformable = "compression_dcm";
  static constexpr const char* kPair = "pair_dcm";
  static constexpr int kPulledPairs = 3;  ///< the force differs by a third with the orientation
  const Scene& compression_;
  const CalibrateOptions& options_;
  std::string folder_;
};

calibration::Clump clump_of(const Scene& scene, const Scene& compression,
                            const CalibrateOptions& options) {
  const std::string type = choose_type(scene, options.clump.type);
  const LawParameters parameters = law_parameters(scene, scene.cell_types.at(type));
  const CellType& compressed = compression.cell_types.at(type);
  return {make_cbm_params(compression, compressed),
          compressed.radius,
          compression.contact.cell_friction,
          compression.capsule.center,
          parameters.dcm,
          parameters.cbm,
          {{"version", ACINUS_VERSION},
           {"git", ACINUS_GIT},
           {"command_line", options.command_line},
           {"cells", std::to_string(compression.cells.count)},
           {"seed", std::to_string(compression.seed)},
           {"scene_hash", compression.hash}}};
}

}  // namespace

int calibrate(const Scene& scene, const CalibrateOptions& options) {
  const StopSignals signals;
  const Scene compression = compression_scene(scene, options.clump);
  const Folders folders(compression, options);
  set_threads(options.threads > 0 ? options.threads : processor_count());
  const calibration::Calibration found = calibration::calibrate(
      clump_of(scene, compression, options), options.calibration, folders.runs());
  if (found.exit != 0) return found.exit;
  calibration::write_curves(found, folders.folder());
  calibration::write_law(found.law, options.out);
  if (!options.quiet)
    fmt::print("{}law file: {}\n", calibration::calibration_table(found), options.out);
  std::fflush(stdout);
  for (const std::string& warning : found.law.warnings)
    fmt::print(stderr, "acinus: warning: {}: {}\n", options.out, warning);
  return 0;
}

}  // namespace acinus::runs
