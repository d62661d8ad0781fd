#include "calibration/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "calibration/reliability.hpp"
#include "calibration/wall.hpp"
#include "contact/jkr.hpp"
#include "core/error.hpp"

namespace acinus::calibration {
namespace {

/// Smallest overlap that a compression which ended early must reach to be fitted.
constexpr double kLeastFittedOverlap = 0.15;

constexpr int kCannotContinue = static_cast<int>(Exit::kCannotContinue);

/// True if a compression that ended early reached overlaps that are worth a fit.
bool is_worth_fitting(const ForceCurve& curve, const Runs& runs) {
  const double reached = curve.overlap.back();
  if (reached < kLeastFittedOverlap) return false;
  runs.say(fmt::format("the compression ended early, at d = {:.3f}: the law is fitted up to there",
                       reached));
  return true;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Overlap d of the central cell in the relaxed, unloaded clump: at the smallest contact pressure
/// after the first tenth of the time.
double overlap_at_rest(const std::vector<ClumpSample>& central) {
  const auto first = central.begin() + static_cast<std::ptrdiff_t>(central.size() / 10);
  return std::ranges::min_element(first, central.end(), {}, &ClumpSample::pressure)->overlap;
}

/// Overlap of two cells in the last snapshot, over the sum of their radii; 0 if they are apart.
double overlap_of_pair(const std::vector<ClumpSnapshot>& snapshots) {
  const ClumpSnapshot& last = snapshots.back();
  const double apart = (last.center[0] - last.center[1]).norm();
  return std::max(0.0, 1 - apart / (last.radius[0] + last.radius[1]));
}

/// Finds the overlap of two cells that adhere. Without adhesion, or where two cells cannot go on,
/// it stays 0: the law then begins with the clump.
/// @return exit code of a run that was stopped or failed, else 0
int find_pair_overlap(const Clump& clump, const Runs& runs, Compression& cells) {
  if (!(clump.sphere.adhesion > 0)) return 0;
  const CompressionRun pair = runs.join_pair();
  if (pair.exit == kCannotContinue)
    runs.say("two cells by themselves could not come to rest: the law begins with the clump");
  else if (pair.exit != 0)
    return pair.exit;
  if (!pair.snapshots.empty()) cells.pair_overlap = overlap_of_pair(pair.snapshots);
  return 0;
}

/// Compresses spheres with the law until they carry the force of the cells in a capsule as wide, by
/// increasing their recess at walls by the excess of the capsule each time.
/// @return exit code of a run that was stopped or failed, else 0
int fit_wall_recess(const Clump& clump, const Compression& cells, double highest, const Runs& runs,
                    Calibration& found) {
  constexpr int kRounds = 5;
  constexpr double kClose = 0.01;  // of a radius
  for (int round = 1;; ++round) {
    const CompressionRun spheres = runs.compress(ClumpModel::kCorrectedSpheres, found.law);
    if (spheres.exit != 0 && spheres.exit != kCannotContinue) return spheres.exit;
    if (spheres.exit != 0) runs.say("these spheres could not be compressed to the end");
    found.corrected = force_curve(spheres.snapshots, cells.inner);
    found.capsule_excess = capsule_excess(cells, spheres.snapshots, highest);
    check(
        std::isfinite(found.capsule_excess),
        "calibration: corrected spheres never bear what the deformable cells do, the law does not "
        "hold for them. Compress less far (capsule.min_radius) or take another clump (--cells)",
        Exit::kCannotContinue);
    if (std::abs(found.capsule_excess) < kClose * clump.radius) return 0;
    const double recess = std::clamp(found.law.wall_recess + found.capsule_excess / clump.radius,
                                     0.0, cbm::kLargestRecess);
    if (round == kRounds || recess == found.law.wall_recess) {
      runs.say("the capsule of the corrected spheres could not be made as wide");
      return 0;
    }
    found.law.wall_recess = recess;
  }
}

/// Slides layers of cells of one model.
/// @param slide  receives how far they slid; empty if they could not go on
/// @return exit code of a run that was stopped or failed otherwise, else 0
int slide_layers(const Runs& runs, ClumpModel model, const Law& law, Slide& slide) {
  const SlidingRun run = runs.slide(model, law);
  if (run.exit == 0) slide = run.slide;
  return run.exit == kCannotContinue ? 0 : run.exit;
}

/// Finds the friction share from the distances that layers of deformable cells and of spheres with
/// the same friction slide: as long as these stay in their hollows, they slide in inverse
/// proportion to it. Layers that do not adhere come apart.
/// @return exit code of a run that was stopped or failed, else 0
int find_friction_share(const Clump& clump, const Runs& runs, Calibration& found) {
  if (!(clump.sphere.adhesion > 0) || !(clump.cell_friction > 0)) return 0;
  Law& law = found.law;
  law.friction_share = 1;
  int exit = slide_layers(runs, ClumpModel::kDeformable, law, found.slid_dcm);
  if (exit == 0) exit = slide_layers(runs, ClumpModel::kCorrectedSpheres, law, found.slid_plain);
  if (exit != 0) return exit;
  const double cells = steady_slide(found.slid_dcm), spheres = steady_slide(found.slid_plain);
  law.friction_share =
      cells > 0 && spheres > 0 ? std::min(spheres / cells, kLargestFrictionShare) : 0;
  if (law.friction_share == 0) {
    runs.say("layers of these cells do not slide: spheres keep their own friction");
    return 0;
  }
  return slide_layers(runs, ClumpModel::kCorrectedSpheres, law, found.slid_corrected);
}

/// Compares the forces at which pairs of both models part, which the law does not know. That of
/// spheres does not depend on their modulus.
/// @return exit code of a run that was stopped, else 0
int compare_pull_off(const Clump& clump, const Runs& runs, Calibration& found) {
  if (!(clump.sphere.adhesion > 0)) return 0;
  const PullRun pulled = runs.pull_pairs();
  if (pulled.exit == kCannotContinue) {
    runs.say("two cells could not be pulled apart: no comparison of pull-off");
    return 0;
  }
  if (pulled.exit != 0 || pulled.force.empty()) return pulled.exit;
  found.pull_off_dcm = pulled.force;
  const contact::SphereBody body{clump.radius, clump.sphere.young, clump.sphere.poisson};
  const contact::SpherePair pair = contact::reduced_pair(body, body, clump.sphere.adhesion);
  found.pull_off_cbm = -contact::jkr_special(pair).pull_off.force;
  found.law.pull_off_ratio = mean_of(pulled.force) / found.pull_off_cbm;
  return 0;
}

void relax(const Options& options, const Runs& runs, Calibration& found) {
  const coupling::World world = runs.compressed_world();
  found.friction_before = world.params.dcm_contact.cell_friction;
  runs.say("letting the clump go");
  found.relaxation.push_back(relax_clump(world, 1));
  coupling::World slow = world;
  scale_all_friction(slow.params, 5);
  found.relaxation.push_back(relax_clump(slow, 5));
  if (options.check_friction > 0) {
    coupling::World other = world;
    other.params.dcm_contact.cell_friction = options.check_friction;
    const double slower = std::max(1.0, options.check_friction / found.friction_before);
    found.checked = {options.check_friction, relax_clump(other, slower)};
    return;
  }
  if (options.relaxation_time == 0) return;
  runs.say(fmt::format("looking for the friction that makes it take {:.3g} h",
                       options.relaxation_time / 3600));
  found.friction = fit_friction(world, options.relaxation_time);
}

/// Law of the best form, before the recess at walls is known.
Law make_law(const Clump& clump, const FitAttempt& attempt) {
  Law law = attempt.law;
  law.dcm = clump.dcm;
  law.cbm = clump.cbm;
  law.provenance = clump.origin;
  law.provenance["form"] = attempt.form;
  return law;
}

}  // namespace

Calibration calibrate(const Clump& clump, const Options& options, const Runs& runs) {
  Calibration found;
  const CompressionRun deformable = runs.compress(ClumpModel::kDeformable, {});
  found.exit = deformable.exit;
  if (found.exit != 0 && found.exit != kCannotContinue) return found;
  Compression cells{deformable.snapshots, find_inner_cells(deformable.snapshots, clump.center)};
  found.inner = static_cast<int>(cells.inner.size());
  found.dcm = force_curve(cells.snapshots, cells.inner);
  if (found.exit != 0 && !is_worth_fitting(found.dcm, runs)) return found;
  const CompressionRun plain = runs.compress(ClumpModel::kSpheres, {});
  found.exit = plain.exit;
  if (found.exit != 0) return found;
  found.plain = force_curve(plain.snapshots, cells.inner);
  found.contacts_first = deformable.central.front().contacts;
  found.contacts_last = deformable.central.back().contacts;
  found.overlap_at_rest = overlap_at_rest(deformable.central);

  found.exit = find_pair_overlap(clump, runs, cells);
  if (found.exit != 0) return found;
  found.pair_overlap = cells.pair_overlap;
  runs.say("fitting the law");
  found.attempts = fit_law(cells, clump.sphere, options.fit);
  found.law = make_law(clump, found.attempts.back());
  runs.say("compressing corrected spheres");
  found.exit = fit_wall_recess(clump, cells, options.fit.highest, runs, found);
  if (found.exit != 0) return found;
  runs.say("sliding layers of both");
  found.exit = find_friction_share(clump, runs, found);
  if (found.exit != 0) return found;
  runs.say("pulling pairs apart");
  found.exit = compare_pull_off(clump, runs, found);
  if (found.exit != 0) return found;
  found.error_plain = relative_error(found.dcm, found.plain, options.fit.highest);
  found.error_corrected = relative_error(found.dcm, found.corrected, options.fit.highest);
  found.law.warnings = list_warnings(found.inner, found.error_corrected);
  if (options.relaxation) {
    try {
      relax(options, runs, found);
    } catch (const Error& error) {  // the law does not depend on it
      if (error.code() == Exit::kStopped) throw;
      found.relaxation.clear();
      runs.say(fmt::format("no relaxation time: {}", error.what()));
    }
  }
  return found;
}

}  // namespace acinus::calibration
