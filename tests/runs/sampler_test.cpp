/// Samplers of an inference on models with known posteriors: mean, width, coverage, the same
/// numbers after any interruption.

#include "runs/infer/sampler.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/messages.hpp"

namespace acinus::runs {
namespace {

/// Noise of a simulation, by its address.
double noise(const Proposal& p, std::uint64_t draw = 0, std::uint64_t seed = 1) {
  return normal({.seed = seed,
                 .purpose = Purpose::kTest,
                 .id = static_cast<std::uint64_t>(p.index),
                 .interval = static_cast<std::uint64_t>(p.population),
                 .draw = static_cast<std::uint32_t>(draw)});
}

template <class Distance>
Simulate simulate_by(const Distance& distance) {
  return [=](std::span<const Proposal> proposals) {
    std::vector<double> all;
    for (const Proposal& p : proposals) all.push_back(distance(p));
    return std::optional(all);
  };
}

std::vector<double> values(const Population& population, std::size_t k) {
  std::vector<double> all;
  for (const Particle& p : population.particle) all.push_back(p.x[k]);
  return all;
}

Summarised summary(const Sampled& sampled, std::size_t k = 0) {
  const Population& last = sampled.population.back();
  return summarise(last.particle, values(last, k));
}

/// Mean of a normal variable of known width, seen once: prior and posterior are normal.
constexpr double kSeen = 1.2, kWidth = 0.5, kPriorWidth = 2;
constexpr double kPrecision = 1 / (kPriorWidth * kPriorWidth) + 1 / (kWidth * kWidth);
constexpr double kPosteriorMean = kSeen / (kWidth * kWidth) / kPrecision;
const double kPosteriorWidth = 1 / std::sqrt(kPrecision);
constexpr double kNinety = 1.645;  ///< of a standard normal, 5 and 95 %
const Prior kNormalPrior{.normal = true, .mean = 0, .sd = kPriorWidth};

double distance_of_mean(const Proposal& p, std::uint64_t seed = 1) {
  return std::abs(p.x[0] + kWidth * noise(p, 0, seed) - kSeen) / kWidth;
}

/// Simulation of the mean. @param seed  of its noise
Simulate mean_simulation(std::uint64_t seed = 1) {
  return simulate_by([seed](const Proposal& p) { return distance_of_mean(p, seed); });
}

TEST(Sampler, FindsTheConjugatePosteriorOfAMean) {
  constexpr int kRepetitions = 20;
  Summarised mean;
  double n = 0, tolerance = 0;
  for (std::uint64_t r = 1; r <= kRepetitions; ++r) {
    const AbcSettings s{.seed = r, .particles = 500, .populations = 7};
    const Sampled found = sample_abc(std::span(&kNormalPrior, 1), s, mean_simulation(100 + r));
    ASSERT_EQ(found.population.size(), 7u);
    const Summarised m = summary(found);
    mean.mean += m.mean / kRepetitions;
    mean.sd += m.sd / kRepetitions;
    mean.low += m.low / kRepetitions;
    mean.high += m.high / kRepetitions;
    n += effective_size(found.population.back());
    tolerance = std::max(tolerance, found.population.back().tolerance);
  }
  fmt::print(
      "mean {:.4f} (exact {:.4f}), width {:.4f} (exact {:.4f}), 5 and 95 % {:.4f} {:.4f} (exact "
      "{:.4f} {:.4f}), tolerance {:.3f}, {:.0f} independent particles\n",
      mean.mean, kPosteriorMean, mean.sd, kPosteriorWidth, mean.low, mean.high,
      kPosteriorMean - kNinety * kPosteriorWidth, kPosteriorMean + kNinety * kPosteriorWidth,
      tolerance, n);
  // A tolerance e widens the posterior by e^2 / 3 of the variance of the datum, here by less than
  // 1 %. The rest is chance: 4 standard errors of n independent samples. That of a quantile q is
  // sqrt(q (1 - q) / n) over the density there.
  EXPECT_LT(tolerance, 0.15);
  EXPECT_GT(n, 300 * kRepetitions);
  const double error = 4 * kPosteriorWidth / std::sqrt(n), of_quantile = 2.11 * error;
  EXPECT_NEAR(mean.mean, kPosteriorMean, error);
  EXPECT_NEAR(mean.sd, kPosteriorWidth, 0.01 * kPosteriorWidth + error / std::sqrt(2));
  EXPECT_NEAR(mean.low, kPosteriorMean - kNinety * kPosteriorWidth, of_quantile);
  EXPECT_NEAR(mean.high, kPosteriorMean + kNinety * kPosteriorWidth, of_quantile);
}

TEST(Sampler, TolerancesFallToTheQuantile) {
  const AbcSettings s{.particles = 100, .populations = 4, .quantile = 0.25};
  const Sampled found = sample_abc(std::span(&kNormalPrior, 1), s, mean_simulation());
  for (std::size_t t = 1; t < found.population.size(); ++t) {
    std::vector<double> before;
    for (const Particle& p : found.population[t - 1].particle) before.push_back(p.distance);
    std::ranges::sort(before);
    EXPECT_EQ(found.population[t].tolerance, before[24]);
    for (const Particle& p : found.population[t].particle)
      EXPECT_LE(p.distance, found.population[t].tolerance);
    double sum = 0;
    for (const Particle& p : found.population[t].particle) sum += p.weight;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

TEST(Sampler, EndsAtTheToleranceOrWhereFewAreAccepted) {
  const auto run = [](const AbcSettings& s) {
    return sample_abc(std::span(&kNormalPrior, 1), s, mean_simulation());
  };
  const Sampled reached = run({.particles = 50, .populations = 20, .tolerance = 0.5});
  EXPECT_EQ(reached.population.back().tolerance, 0.5);
  EXPECT_CONTAINS(reached.end, "the tolerance 0.5 was reached");
  const Sampled rare = run({.particles = 50, .populations = 50, .least_acceptance = 0.1});
  EXPECT_LT(rare.population.size(), 50u);
  EXPECT_CONTAINS(rare.end, "came within the tolerance ... fewer than 10 %");
}

TEST(Sampler, StaysWithinTheBoundsAndKeepsAFlatPosteriorFlat) {
  // Distances say nothing: the posterior is the prior, also at its bounds.
  const std::vector<Prior> prior{{.low = -1, .high = 3}, {.log = true, .low = 0, .high = 2}};
  const AbcSettings s{.seed = 5, .particles = 2000, .populations = 4};
  const Sampled found =
      sample_abc(prior, s, simulate_by([](const Proposal& p) { return std::abs(noise(p)); }));
  const double n = effective_size(found.population.back());
  for (const std::size_t k : {0u, 1u}) {
    const double length = prior[k].high - prior[k].low;
    const Summarised m = summary(found, k);
    const double width = length / std::sqrt(12);
    EXPECT_NEAR(m.mean, prior[k].low + length / 2, 4 * width / std::sqrt(n));
    EXPECT_NEAR(m.sd, width, 4 * width / std::sqrt(2 * n));
    EXPECT_NEAR(m.low, prior[k].low + 0.05 * length, 0.03 * length);
    for (const double x : values(found.population.back(), k)) EXPECT_GT(prior[k].density(x), 0);
  }
}

TEST(Sampler, FollowsACorrelationOfTwoParameters) {
  // Only the sum is measured: narrow across, as wide as the prior along.
  const std::vector<Prior> prior(2, Prior{.normal = true, .mean = 0, .sd = 1});
  const AbcSettings s{.seed = 2, .particles = 1000, .populations = 7};
  constexpr double kError = 0.1;
  const Sampled found = sample_abc(prior, s, simulate_by([](const Proposal& p) {
                                     return std::abs(p.x[0] + p.x[1] + kError * noise(p)) / kError;
                                   }));
  const Population& last = found.population.back();
  std::vector<double> sum = values(last, 0), difference = sum;
  const std::vector<double> second = values(last, 1);
  for (std::size_t k = 0; k < sum.size(); ++k) {
    sum[k] += second[k];
    difference[k] -= second[k];
  }
  const double n = effective_size(last), e = last.tolerance * kError;
  // Precisions of prior (variance 2) and datum add; the tolerance adds e^2 / 3 to the datum's.
  const double exact = std::sqrt(1 / (0.5 + 1 / (kError * kError + e * e / 3)));
  EXPECT_NEAR(summarise(last.particle, sum).sd, exact, exact * (0.02 + 4 / std::sqrt(2 * n)));
  const double along = std::sqrt(2.0);
  EXPECT_NEAR(summarise(last.particle, difference).sd, along, along * 4 / std::sqrt(2 * n));
}

/// Everything of a result, to the last bit.
std::string text_of(const Sampled& s) {
  std::string text = s.end;
  for (const Population& p : s.population) {
    text += fmt::format("|{:a} {}", p.tolerance, p.tried);
    for (const Particle& q : p.particle)
      text += fmt::format(" {} {:a} {:a} {:a}", q.index, q.x[0], q.weight, q.distance);
  }
  return text;
}

TEST(Sampler, GivesTheSameAfterAnyInterruption) {
  const AbcSettings s{.seed = 9, .particles = 60, .populations = 4};
  const auto whole = sample_abc(std::span(&kNormalPrior, 1), s, mean_simulation());
  std::map<std::pair<int, std::int64_t>, double> kept;
  int budget = 0, attempts = 0;
  const Simulate with_stops =
      [&](std::span<const Proposal> proposals) -> std::optional<std::vector<double>> {
    std::vector<double> all;
    // In another order each time, as runs end when they end.
    for (std::size_t k = proposals.size(); k-- > 0;) {
      const Proposal& p = proposals[(k * 7 + attempts) % proposals.size()];
      if (kept.contains({p.population, p.index})) continue;
      if (budget-- == 0) return std::nullopt;
      kept[{p.population, p.index}] = distance_of_mean(p);
    }
    for (const Proposal& p : proposals) {
      if (!kept.contains({p.population, p.index}))
        kept[{p.population, p.index}] = distance_of_mean(p);
      all.push_back(kept.at({p.population, p.index}));
    }
    return all;
  };
  Sampled found;
  do {
    budget = 17;
    ++attempts;
    found = sample_abc(std::span(&kNormalPrior, 1), s, with_stops);
  } while (found.stopped);
  EXPECT_GT(attempts, 10);
  EXPECT_EQ(text_of(found), text_of(whole));
}

TEST(Sampler, SkipsFailedSimulations) {
  const AbcSettings s{.particles = 100, .populations = 3};
  const auto fails_above = [&](double limit) {
    return sample_abc(std::span(&kNormalPrior, 1), s, simulate_by([&](const Proposal& p) {
                        return p.x[0] > limit ? std::nan("") : distance_of_mean(p);
                      }));
  };
  for (const double x : values(fails_above(1).population.back(), 0)) EXPECT_LE(x, 1);
  EXPECT_CONTAINS(test::message_of([&] { fails_above(-3); }), "half of them must");
}

TEST(Sampler, ScanOfAGridGivesTheConjugatePosterior) {
  const Sampled found =
      scan_grid(std::span(&kNormalPrior, 1), 201, 1,
                simulate_by([](const Proposal& p) { return std::abs(p.x[0] - kSeen) / kWidth; }));
  const Summarised m = summary(found);
  EXPECT_NEAR(m.mean, kPosteriorMean, 1e-3);
  EXPECT_NEAR(m.sd, kPosteriorWidth, 1e-3);
  EXPECT_EQ(found.population.front().particle.size(), 201u);
}

TEST(Sampler, QuantilesOfWeights) {
  const std::vector<Particle> particle{{0, {}, 0.5, 0}, {1, {}, 0.25, 0}, {2, {}, 0.25, 0}};
  const std::vector<double> value{1, 3, 2};
  EXPECT_EQ(weighted_quantile(particle, value, 0.1), 1);
  EXPECT_EQ(weighted_quantile(particle, value, 0.25), 1);
  EXPECT_EQ(weighted_quantile(particle, value, 0.625), 2);
  EXPECT_EQ(weighted_quantile(particle, value, 0.75), 2.5);
  EXPECT_EQ(weighted_quantile(particle, value, 1), 3);
}

/// Relaxation A exp(-t / T) at eight times, with errors: A and T inferred twenty times over.
TEST(Sampler, NinetyPercentIntervalsHoldTheTruth) {
  constexpr double kA = 4, kT = 7, kError = 0.25;
  constexpr int kRepetitions = 20, kTimes = 8;
  const std::vector<Prior> prior{{.low = 1, .high = 8},
                                 {.log = true, .low = std::log(1.0), .high = std::log(50.0)}};
  const auto curve = [](const std::vector<double>& x, int k) {
    return x[0] * std::exp(-2 * k / std::exp(x[1]));
  };
  int inside_a = 0, inside_t = 0;
  double width = 0;
  for (std::uint64_t r = 1; r <= kRepetitions; ++r) {
    std::vector<double> target;
    for (int k = 0; k < kTimes; ++k)
      target.push_back(curve({kA, std::log(kT)}, k) + kError * noise({-1, k, {}}, 0, r));
    const AbcSettings s{.seed = r, .particles = 200, .populations = 6};
    const Sampled found = sample_abc(prior, s, simulate_by([&](const Proposal& p) {
                                       double sum = 0;
                                       for (int k = 0; k < kTimes; ++k) {
                                         const double d = curve(p.x, k) + kError * noise(p, k, r) -
                                                          target[static_cast<std::size_t>(k)];
                                         sum += d * d / (kError * kError);
                                       }
                                       return std::sqrt(sum / kTimes);
                                     }));
    const Summarised a = summary(found, 0), t = summary(found, 1);
    inside_a += a.low <= kA && kA <= a.high ? 1 : 0;
    inside_t += t.low <= std::log(kT) && std::log(kT) <= t.high ? 1 : 0;
    width += (t.high - t.low) / kRepetitions;
  }
  fmt::print("inside: {} and {} of {}; mean width of log T {:.3f}\n", inside_a, inside_t,
             kRepetitions, width);
  EXPECT_GE(inside_a, 17);
  EXPECT_GE(inside_t, 17);
  EXPECT_LT(width, 1.5);  // the prior's is 3.5
}

}  // namespace
}  // namespace acinus::runs
