#pragma once
/// Samplers of parameters by simulation, without a likelihood: approximate Bayesian computation in
/// populations [Toni2009, Beaumont2009], and a scan of a grid. Numbers only; the simulation is a
/// function.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runs/infer/prior.hpp"

namespace acinus::runs {

/// Parameters to simulate. Their numbers depend on seed, population and index only.
struct Proposal {
  int population = 0;
  std::int64_t index = 0;  ///< from 0 in its population
  std::vector<double> x;   ///< coordinates
};

/// Simulates proposals and compares them with the target.
/// @return distances in the order of the proposals, nan for a failed simulation; nothing where the
/// work was stopped
using Simulate =
    std::function<std::optional<std::vector<double>>(std::span<const Proposal> proposals)>;

struct Particle {
  std::int64_t index = 0;  ///< of its proposal
  std::vector<double> x;
  double weight = 0;  ///< the weights of a population sum to 1
  double distance = 0;
};

struct Population {
  double tolerance = 0;    ///< largest distance that was accepted; infinite in the first
  std::int64_t tried = 0;  ///< proposals up to the last accepted one
  std::vector<Particle> particle;
};

struct Sampled {
  std::vector<Population> population;  ///< complete ones; the last is the posterior
  std::string end;                     ///< reason of the end
  bool stopped = false;                ///< the simulation was stopped: nothing but a part is here
};

/// Settings of approximate Bayesian computation.
struct AbcSettings {
  std::uint64_t seed = 1;
  int particles = 100;             ///< of a population
  int populations = 5;             ///< at most
  double quantile = 0.5;           ///< of the distances of a population: next tolerance
  double tolerance = 0;            ///< the last population is the first with at most this
  double least_acceptance = 0.02;  ///< a population that accepts less is given up
};

/// Approximate Bayesian computation by population Monte Carlo. The first population is drawn from
/// the prior. Each later one draws particles of the one before by weight, moves them by a normal
/// kernel with twice their weighted covariance, and accepts distances up to the tolerance, in the
/// order of the indices, until it is full. Weights are prior over density of the proposals.
/// @throws Error where most simulations of the first population fail
Sampled sample_abc(std::span<const Prior> prior, const AbcSettings& settings,
                   const Simulate& simulate);

/// Scan of a grid over the priors, the last parameter fastest. Weights are the prior times
/// exp(-n d^2 / 2) for distances d that are root mean squares over n numbers, each in units of its
/// standard error.
/// @param steps  along each parameter
Sampled scan_grid(std::span<const Prior> prior, int steps, int n, const Simulate& simulate);

/// Sum of weights squared over sum of squares: equivalent number of equal weights.
double effective_size(const Population& population);

/// Value below which a share of the weights lies, between particles linearly.
/// @param value  of every particle
double weighted_quantile(std::span<const Particle> particle, std::span<const double> value,
                         double share);

/// Weighted samples of one number, summarised.
struct Summarised {
  double mean = 0, sd = 0, low = 0, median = 0, high = 0;  ///< low, high: 5 and 95 %
};
Summarised summarise(std::span<const Particle> particle, std::span<const double> value);

}  // namespace acinus::runs
