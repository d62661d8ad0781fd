#pragma once
/// Calibration of the law that corrects the spheres, from a clump that both models compress.

#include <functional>
#include <string>
#include <vector>

#include "calibration/clump.hpp"
#include "calibration/clump_relaxation.hpp"
#include "calibration/compression.hpp"
#include "calibration/fit_law.hpp"
#include "calibration/sliding.hpp"

namespace acinus::calibration {

struct Options {
  FitOptions fit;
  bool relaxation = true;      ///< also compute the relaxation time of the clump
  double relaxation_time = 0;  ///< s, to which the cell-cell friction is fitted; 0 = no fit
  /// Cell-cell friction for which the relaxation time is computed too, nN s/um^3; 0 = none
  double check_friction = 0;
};

/// Clump to calibrate with, and its cells.
struct Clump {
  cbm::Params sphere;                         ///< constants of the spheres; young is a0
  double radius = 0;                          ///< um, of a cell
  double cell_friction = 0;                   ///< nN s/um^3, between deformable cells
  Vec3 center = Vec3::Zero();                 ///< um, of the capsule
  Parameters dcm, cbm;                        ///< for Law::dcm and Law::cbm
  std::map<std::string, std::string> origin;  ///< for Law::provenance
};

enum class ClumpModel { kDeformable, kSpheres, kCorrectedSpheres };

/// Compression of the clump as cells of one model.
struct CompressionRun {
  int exit = 0;  ///< exit code of a run that was stopped or failed, else 0
  /// Snapshots over time. Empty if the run was stopped, or plain spheres could not go on. Other
  /// runs that could not go on have those up to that point.
  std::vector<ClumpSnapshot> snapshots;
  std::vector<ClumpSample> central;  ///< the central cell in each snapshot
};

/// Two layers of cells of one model that slide past each other.
struct SlidingRun {
  int exit = 0;  ///< exit code of a run that was stopped or failed, else 0
  Slide slide;
};

/// Pairs of deformable cells that adhere and are pulled apart.
struct PullRun {
  int exit = 0;               ///< exit code of a run that was stopped or failed, else 0
  std::vector<double> force;  ///< nN, at which each pair parts
};

/// Simulations of a calibration. The caller keeps their folders, stops and resumes them.
struct Runs {
  /// Compresses the clump. @param law  of corrected spheres; other models ignore it
  std::function<CompressionRun(ClumpModel model, const Law& law)> compress;
  /// Lets two deformable cells that touch come to rest. Their CompressionRun has no central cell.
  std::function<CompressionRun()> join_pair;
  /// Pulls pairs of deformable cells apart, each with other orientations of the meshes.
  std::function<PullRun()> pull_pairs;
  /// Slides two layers of cells past each other, as deformable cells or as spheres with the law.
  std::function<SlidingRun(ClumpModel model, const Law& law)> slide;
  /// Deformable cells at the end of their compression.
  std::function<coupling::World()> compressed_world;
  std::function<void(const std::string& text)> say;  ///< reports progress
};

/// Results of a calibration.
struct Calibration {
  int exit = 0;  ///< exit code of a run that was stopped or failed; the rest is then unknown
  Law law;
  std::vector<FitAttempt> attempts;             ///< the last one is the law
  int inner = 0;                                ///< number of cells that are not at the capsule
  ForceCurve dcm, plain, corrected;             ///< force over overlap, means over inner cells
  double error_plain = 0, error_corrected = 0;  ///< relative, over the fitted range
  double capsule_excess = 0;  ///< um, by which the capsule of the corrected spheres is wider
  double contacts_first = 0, contacts_last = 0;  ///< of the central deformable cell
  double overlap_at_rest = 0;                    ///< its d without load
  double pair_overlap = 0;                       ///< Compression::pair_overlap
  std::vector<double> pull_off_dcm;              ///< nN, PullRun::force; empty: not pulled
  double pull_off_cbm = 0;                       ///< nN, of two spheres
  /// Layers of deformable cells, of spheres with the same friction per area, and of spheres with
  /// the law's; empty: not slid.
  Slide slid_dcm, slid_plain, slid_corrected;
  std::vector<Relaxation> relaxation;  ///< Table 1, all friction x 5 (empty: not asked)
  FrictionFit friction;                ///< fit to Options::relaxation_time; 0: not asked for
  double friction_before = 0;          ///< nN s/um^3
  FrictionFit checked;                 ///< relaxation with Options::check_friction
};

/// Calibrates the law: compresses the clump as deformable cells and as spheres, lets two of the
/// cells adhere, fits, compresses the corrected spheres until their capsule is as wide, slides
/// layers of both models, pulls pairs apart, lets the deformable clump relax.
/// @throws Error(kCannotContinue) where the compression gives too little data or no law fits
Calibration calibrate(const Clump& clump, const Options& options, const Runs& runs);

}  // namespace acinus::calibration
