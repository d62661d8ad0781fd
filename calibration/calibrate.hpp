#pragma once
/// From a clump that both models compress to the law that corrects the spheres.

#include <functional>
#include <string>
#include <vector>

#include "calibration/clump.hpp"
#include "calibration/clump_relaxation.hpp"
#include "calibration/compression.hpp"
#include "calibration/fit_law.hpp"

namespace acinus::calibration {

struct Options {
  FitOptions fit;
  bool relaxation = true;      ///< also the time the clump takes to relax
  double relaxation_time = 0;  ///< s, to which the cell-cell friction is fitted; 0 = it is not
  /// nN s/um^3: relaxation time with this cell-cell friction too; 0 = no
  double check_friction = 0;
};

/// What is calibrated.
struct Clump {
  cbm::Params sphere;                         ///< constants of the spheres; young is a0
  double radius = 0;                          ///< um, of a cell
  Vec3 center = Vec3::Zero();                 ///< um, of the capsule
  Parameters dcm, cbm;                        ///< for Law::dcm and Law::cbm
  std::map<std::string, std::string> origin;  ///< for Law::provenance
};

enum class ClumpModel { kDeformable, kSpheres, kCorrectedSpheres };

/// How the clump was compressed as cells of one model.
struct CompressionRun {
  int exit = 0;  ///< exit code of a run that was stopped or failed, else 0
  /// Empty if the run was stopped, or plain spheres could not go on. Other runs that could not go
  /// on have those they got to.
  std::vector<ClumpSnapshot> snapshots;
  std::vector<ClumpSample> central;  ///< the central cell in each snapshot
};

/// The runs that a calibration is made of. Where they stand, and how they are stopped and taken up
/// again, is the business of the caller.
struct Runs {
  /// @param law  of corrected spheres; other models do not look at it
  std::function<CompressionRun(ClumpModel model, const Law& law)> compress;
  /// The deformable cells at the end of their compression.
  std::function<coupling::World()> compressed_world;
  std::function<void(const std::string& text)> say;  ///< progress
};

/// What a calibration found.
struct Calibration {
  int exit = 0;  ///< exit code of a run that was stopped or failed: the rest is not known then
  Law law;
  std::vector<FitAttempt> attempts;             ///< the last one became the law
  int inner = 0;                                ///< cells that are not at the capsule
  ForceCurve dcm, plain, corrected;             ///< force over overlap, means over inner cells
  double error_plain = 0, error_corrected = 0;  ///< relative, over the fitted range
  double capsule_excess = 0;  ///< um, by which the capsule of the corrected spheres is wider
  double contacts_first = 0, contacts_last = 0;  ///< of the central deformable cell
  double overlap_at_rest = 0;                    ///< its d when nothing presses
  std::vector<Relaxation> relaxation;            ///< Table 1, all friction x 5 (empty: not asked)
  FrictionFit friction;                          ///< 0: not asked for
  double friction_before = 0;                    ///< nN s/um^3
  FrictionFit checked;                           ///< Options::check_friction
};

/// Compresses the clump as deformable cells and as spheres, fits, compresses the corrected spheres
/// until their capsule is as wide, lets the deformable ones relax.
/// @throws Error(kCannotContinue) where the compression says too little or no law fits
Calibration calibrate(const Clump& clump, const Options& options, const Runs& runs);

}  // namespace acinus::calibration
