#pragma once
/// List of the experiments: the values of the scene key `experiment`.

/// X(constant, name) of every experiment, in the order of messages and docs. Its row in the table
/// of experiments (runs/experiments/experiment.hpp) is `<name>_experiment`.
#define ACINUS_EXPERIMENTS(X)             \
  X(kFree, free)                          \
  X(kLobule, lobule)                      \
  X(kPatch, patch)                        \
  X(kCapsule, capsule)                    \
  X(kRelaxation, relaxation)              \
  X(kSpheroid, spheroid)                  \
  X(kMonolayer, monolayer)                \
  X(kOpticalStretcher, optical_stretcher) \
  X(kPlates, plates)                      \
  X(kAspiration, aspiration)              \
  X(kNarrowGap, narrow_gap)               \
  X(kPullOff, pull_off)                   \
  X(kTear, tear)                          \
  /* further ones above this line */

namespace acinus::runs {

/// Kind of measurement beyond what every scene measures.
enum class Experiment {
#define ACINUS_CONSTANT(constant, name) constant,
  ACINUS_EXPERIMENTS(ACINUS_CONSTANT)
#undef ACINUS_CONSTANT
};

/// Names in the order of the values, "free|lobule|...".
#define ACINUS_NAME(constant, name) "|" #name
inline constexpr const char* kExperimentNames = &(ACINUS_EXPERIMENTS(ACINUS_NAME))[1];
#undef ACINUS_NAME

}  // namespace acinus::runs
