#pragma once
/// Relaxation time of a released compressed clump, and the friction for a given relaxation time.
/// [VanLiedekerke2020, Appendix 1, Fig. 12c]

#include <functional>
#include <span>
#include <vector>

#include "coupling/world/world.hpp"

namespace acinus::calibration {

/// Exponential decay y(t) = end + (start - end) exp(-t / time), by least squares over time.
struct Decay {
  double time = 0;  ///< s
  double start = 0, end = 0;
  double rms = 0;  ///< of the misfit, relative to |start - end|
};

/// Fits an exponential decay. Samples are weighted by the time they stand for, so that their
/// spacing does not matter.
/// @param t  [n] s, ascending from 0, n >= 4
Decay fit_decay(std::span<const double> t, std::span<const double> y);

struct Relaxation {
  std::vector<double> time;     ///< s since the release
  std::vector<double> overlap;  ///< shell overlap, see clump.hpp
  Decay decay;
};

/// Simulates the relaxation of a compressed clump from the opening of its capsule, until the second
/// half of the time contributes less than 1 % of the recovery.
/// @param world   compressed; its capsules are removed, active motion is off
/// @param friction_scale  expected slow-down relative to Table 1 friction: times and steps scale
///                        with it
/// @throws Error(kCannotContinue) if a step fails or the clump does not come to rest,
/// Error(kStopped) if the process was asked to stop
Relaxation relax_clump(coupling::World world, double friction_scale);

/// Multiplies every friction coefficient of a run. All times scale with the factor exactly.
void scale_all_friction(coupling::Params& params, double factor);

struct FrictionFit {
  double friction = 0;  ///< nN s/um^3 between deformable cells
  Relaxation relaxation;
};

/// Fits the cell-cell friction of deformable cells to a relaxation time of `time` s, to 2 %, with
/// all other friction unchanged.
/// @throws Error(kCannotContinue) when no friction does within 12 attempts
FrictionFit fit_friction(const coupling::World& world, double time);

}  // namespace acinus::calibration
