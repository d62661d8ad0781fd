#pragma once
/// Plots of a posterior: corner plot of the parameters, bands of the predictions.

#include <string>
#include <utility>
#include <vector>

#include "runs/infer/particle_runs.hpp"

namespace acinus::runs {

/// Values of a parameter, of every particle.
std::vector<double> parameter_values(const InferencePlan& plan, const Population& population,
                                     std::size_t parameter);

/// Simulated values at a point of the target, without noise, of every particle of the last
/// population.
std::vector<double> predicted_values(const ParticleRuns& runs, const Sampled& sampled,
                                     std::size_t point);

/// Corner plot as SVG text: densities with the priors on the diagonal, pairs of parameters beside
/// it.
std::string draw_corner(const InferencePlan& plan, const Population& population);

/// Name of the file and SVG text for every observable with several times: target with bars, median
/// and the band from 5 to 95 %.
std::vector<std::pair<std::string, std::string>> draw_predictions(const ParticleRuns& runs,
                                                                  const Sampled& sampled);

}  // namespace acinus::runs
