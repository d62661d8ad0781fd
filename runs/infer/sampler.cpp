#include "runs/infer/sampler.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

/// Normal kernel around the particles of a population.
class Kernel {
 public:
  explicit Kernel(const Population& before) : before_(before) {
    const auto n = static_cast<Eigen::Index>(before.particle.front().x.size());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(n);
    for (const Particle& p : before.particle) mean += p.weight * vector_of(p.x);
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
    for (const Particle& p : before.particle) {
      const Eigen::VectorXd d = vector_of(p.x) - mean;
      covariance += 2 * p.weight * d * d.transpose();
    }
    // Particles in a line or at one place leave a direction without spread.
    constexpr double kLeast = 1e-10, kTiny = 1e-200;
    covariance.diagonal().array() += kLeast * covariance.trace() + kTiny;
    factor_ = covariance.llt();
    double sum = 0;
    for (const Particle& p : before.particle) cumulative_.push_back(sum += p.weight);
  }

  std::vector<double> draw(UniformStream& random) const {
    const double u = random.uniform() * cumulative_.back();
    const auto at = std::ranges::lower_bound(cumulative_, u) - cumulative_.begin();
    const std::vector<double>& x = before_.particle[static_cast<std::size_t>(at)].x;
    Eigen::VectorXd z(static_cast<Eigen::Index>(x.size()));
    for (double& v : z) v = random.normal();
    const Eigen::VectorXd moved = vector_of(x) + factor_.matrixL() * z;
    return {moved.begin(), moved.end()};
  }

  /// Density of draws, up to a factor.
  double density(const std::vector<double>& x) const {
    double sum = 0;
    for (const Particle& p : before_.particle) {
      const Eigen::VectorXd z = factor_.matrixL().solve(vector_of(x) - vector_of(p.x));
      sum += p.weight * std::exp(-0.5 * z.squaredNorm());
    }
    return sum;
  }

 private:
  static Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& x) {
    return {x.data(), static_cast<Eigen::Index>(x.size())};
  }
  const Population& before_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  std::vector<double> cumulative_;
};

double density_of(std::span<const Prior> prior, const std::vector<double>& x) {
  double product = 1;
  for (std::size_t k = 0; k < x.size(); ++k) product *= prior[k].density(x[k]);
  return product;
}

void normalise(Population& population) {
  double sum = 0;
  for (const Particle& p : population.particle) sum += p.weight;
  for (Particle& p : population.particle) p.weight /= sum;
}

double quantile_of(const Population& population, double share) {
  std::vector<double> all;
  for (const Particle& p : population.particle) all.push_back(p.distance);
  std::ranges::sort(all);
  const double at = std::ceil(share * static_cast<double>(all.size())) - 1;
  return all[static_cast<std::size_t>(std::max(at, 0.0))];
}

class Abc {
 public:
  Abc(std::span<const Prior> prior, const AbcSettings& settings, const Simulate& simulate)
      : prior_(prior), s_(settings), simulate_(simulate) {}

  Sampled run() {
    for (int t = 0; t < s_.populations; ++t) {
      const double tolerance = next_tolerance();
      if (!sampled_.end.empty()) return sampled_;
      if (!add_population(t, tolerance)) return sampled_;
      if (tolerance <= s_.tolerance) {
        sampled_.end = fmt::format("the tolerance {:.4g} was reached", s_.tolerance);
        return sampled_;
      }
    }
    sampled_.end = fmt::format("{} populations were made", s_.populations);
    return sampled_;
  }

 private:
  double next_tolerance() {
    if (sampled_.population.empty()) return std::numeric_limits<double>::infinity();
    const Population& before = sampled_.population.back();
    const double next = std::max(quantile_of(before, s_.quantile), s_.tolerance);
    if (!(next < before.tolerance))
      sampled_.end = fmt::format("the tolerance stays at {:.4g}", before.tolerance);
    return next;
  }

  Proposal propose(int t, std::int64_t index, const Kernel* kernel) const {
    constexpr int kIndexBits = 40;
    UniformStream random(
        s_.seed, Purpose::kInference,
        (static_cast<std::uint64_t>(t) << kIndexBits) | static_cast<std::uint64_t>(index));
    Proposal p{t, index, {}};
    if (kernel == nullptr) {
      for (const Prior& prior : prior_) p.x.push_back(prior.draw(random));
      return p;
    }
    // Particle and move are drawn anew beyond the prior: the density of what remains is that of the
    // kernel, up to one factor.
    do p.x = kernel->draw(random);
    while (!(density_of(prior_, p.x) > 0));
    return p;
  }

  /// Size of the next batch. It depends on counts only, never on time.
  std::int64_t batch(std::int64_t tried, std::size_t accepted) const {
    const auto missing = s_.particles - static_cast<std::int64_t>(accepted);
    if (tried == 0) return s_.particles;
    const double rate = (static_cast<double>(accepted) + 1) / (static_cast<double>(tried) + 1);
    const auto expected = static_cast<std::int64_t>(static_cast<double>(missing) / rate) + 1;
    return std::min<std::int64_t>(expected, 2 * s_.particles);
  }

  /// @return false at the end: stopped, or given up
  bool add_population(int t, double tolerance) {
    const std::optional<Kernel> kernel =
        t > 0 ? std::optional<Kernel>(sampled_.population.back()) : std::nullopt;
    Population population{tolerance, 0, {}};
    const double least = t > 0 ? s_.least_acceptance : 0.5;
    for (std::int64_t tried = 0;;) {
      std::vector<Proposal> proposals;
      for (std::int64_t k = batch(tried, population.particle.size()); k > 0; --k)
        proposals.push_back(propose(t, tried++, kernel ? &*kernel : nullptr));
      const std::optional<std::vector<double>> distance = simulate_(proposals);
      if (!distance) {
        sampled_.stopped = true;
        sampled_.end = "stopped";
        return false;
      }
      if (accept(proposals, *distance, kernel ? &*kernel : nullptr, population)) break;
      if (static_cast<double>(tried) * least < s_.particles) continue;
      give_up(t, tolerance, tried, population.particle.size());
      return false;
    }
    normalise(population);
    sampled_.population.push_back(std::move(population));
    return true;
  }

  /// Accepts proposals in their order.   @return true once the population is full
  bool accept(std::span<const Proposal> proposals, std::span<const double> distance,
              const Kernel* kernel, Population& population) const {
    for (std::size_t k = 0; k < proposals.size(); ++k) {
      ++population.tried;
      const Proposal& p = proposals[k];
      if (!std::isfinite(distance[k]) || !(distance[k] <= population.tolerance)) continue;
      const double weight = kernel == nullptr ? 1 : density_of(prior_, p.x) / kernel->density(p.x);
      population.particle.push_back({p.index, p.x, weight, distance[k]});
      if (static_cast<int>(population.particle.size()) == s_.particles) return true;
    }
    return false;
  }

  void give_up(int t, double tolerance, std::int64_t tried, std::size_t accepted) {
    const std::string found =
        fmt::format("{} of {} simulations of population {}", accepted, tried, t);
    check(t > 0,
          fmt::format("{} ended with numbers to compare; half of them must. Check the bounds "
                      "of the parameters and the causes in runs.csv.",
                      found));
    sampled_.end = fmt::format("{} came within the tolerance {:.4g}, fewer than {:.3g} %", found,
                               tolerance, 100 * s_.least_acceptance);
  }

  std::span<const Prior> prior_;
  const AbcSettings& s_;
  const Simulate& simulate_;
  Sampled sampled_;
};

}  // namespace

Sampled sample_abc(std::span<const Prior> prior, const AbcSettings& settings,
                   const Simulate& simulate) {
  return Abc(prior, settings, simulate).run();
}

Sampled scan_grid(std::span<const Prior> prior, int steps, int n, const Simulate& simulate) {
  std::vector<Proposal> proposals;
  std::int64_t all = 1;
  for (std::size_t k = 0; k < prior.size(); ++k) all *= steps;
  for (std::int64_t index = 0; index < all; ++index) {
    Proposal p{0, index, std::vector<double>(prior.size())};
    std::int64_t rest = index;
    for (std::size_t k = prior.size(); k-- > 0; rest /= steps)
      p.x[k] = prior[k].step(static_cast<int>(rest % steps), steps);
    proposals.push_back(std::move(p));
  }
  Sampled sampled;
  const std::optional<std::vector<double>> distance = simulate(proposals);
  if (!distance) return {{}, "stopped", true};
  Population population{std::numeric_limits<double>::infinity(), all, {}};
  double best = std::numeric_limits<double>::infinity();
  for (const double d : *distance)
    if (std::isfinite(d)) best = std::min(best, d);
  check(std::isfinite(best),
        "no simulation of the scan ended with numbers to compare. Check the "
        "bounds of the parameters and the causes in runs.csv.");
  for (std::size_t k = 0; k < proposals.size(); ++k) {
    const double d = (*distance)[k];
    if (!std::isfinite(d)) continue;
    const double weight =
        density_of(prior, proposals[k].x) * std::exp(-0.5 * n * (d * d - best * best));
    population.particle.push_back({proposals[k].index, proposals[k].x, weight, d});
  }
  normalise(population);
  sampled.population.push_back(std::move(population));
  sampled.end = fmt::format("{} points of a grid were simulated", all);
  return sampled;
}

double effective_size(const Population& population) {
  double sum = 0, squares = 0;
  for (const Particle& p : population.particle) {
    sum += p.weight;
    squares += p.weight * p.weight;
  }
  return sum * sum / squares;
}

double weighted_quantile(std::span<const Particle> particle, std::span<const double> value,
                         double share) {
  std::vector<std::size_t> order(value.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return value[k]; });
  // Each value stands in the middle of its own weight.
  double below = 0, before_share = 0, before_value = value[order.front()];
  for (const std::size_t k : order) {
    const double middle = below + 0.5 * particle[k].weight;
    if (middle >= share && middle > before_share)
      return below == 0 ? value[k]
                        : before_value + (value[k] - before_value) * (share - before_share) /
                                             (middle - before_share);
    below += particle[k].weight;
    before_share = middle;
    before_value = value[k];
  }
  return before_value;
}

Summarised summarise(std::span<const Particle> particle, std::span<const double> value) {
  constexpr double kLow = 0.05, kHalf = 0.5, kHigh = 0.95;
  Summarised s;
  for (std::size_t k = 0; k < value.size(); ++k) s.mean += particle[k].weight * value[k];
  for (std::size_t k = 0; k < value.size(); ++k)
    s.sd += particle[k].weight * (value[k] - s.mean) * (value[k] - s.mean);
  s.sd = std::sqrt(s.sd);
  s.low = weighted_quantile(particle, value, kLow);
  s.median = weighted_quantile(particle, value, kHalf);
  s.high = weighted_quantile(particle, value, kHigh);
  return s;
}

}  // namespace acinus::runs
