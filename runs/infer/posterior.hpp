#pragma once
/// Result of an inference: tables, plots and a summary.

#include <string>

#include "runs/infer/particle_runs.hpp"

namespace acinus::runs {

/// Writes posterior.csv (last population), simulations.csv (all runs), populations.csv, corner.svg,
/// prediction_<observable>.svg and report.md. Content does not depend on when and where runs were
/// made.
/// @return the summary of report.md for the terminal
/// @throws Error(kFileError)
std::string write_posterior(const InferencePlan& plan, const ParticleRuns& runs,
                            const Sampled& sampled, const std::string& root);

}  // namespace acinus::runs
