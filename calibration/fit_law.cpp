#include "calibration/fit_law.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "calibration/law_table.hpp"
#include "core/error.hpp"

namespace acinus::calibration {
namespace {

constexpr double kDifference = 1e-3;  ///< relative step of difference quotients
constexpr double kLeastPower = 1.05;
constexpr double kNormal95 = 1.96;
constexpr std::size_t kLeastSamples = 8;
/// Least modulus that a term adds at the end of the range, over that of plain spheres: below it the
/// solver stands at its bound, zero to rounding.
constexpr double kLeastGain = 1e-6;

/// Snapshots of the fit, with derived numbers.
struct Samples {
  Compression compression;
  std::vector<double> force;      ///< nN, of each snapshot
  std::array<double, 2> range{};  ///< of d
  double rms = 0;                 ///< nN, of the force
  double stiffer = 0;  ///< their force relative to that of plain spheres at the end of the range
};

Samples choose_samples(const Compression& compression, const cbm::Params& sphere, double highest) {
  Samples chosen;
  chosen.compression = {{}, compression.inner, compression.pair_overlap};
  chosen.range = {highest, 0};
  const std::vector<Bulk> bulks = measure_bulks(compression.snapshots, compression.inner);
  for (const std::size_t k : find_pressing(bulks, highest)) {
    const ClumpSnapshot& m = compression.snapshots[k];
    const Bulk& b = bulks[k];
    chosen.compression.snapshots.push_back(m);
    chosen.force.push_back(b.force);
    chosen.range[0] = std::min(chosen.range[0], b.overlap);
    if (b.overlap > chosen.range[1])
      chosen.stiffer = b.force / bulk_as_spheres(m, sphere, compression.inner).force;
    chosen.range[1] = std::max(chosen.range[1], b.overlap);
    chosen.rms += b.force * b.force;
  }
  check(chosen.force.size() >= kLeastSamples && chosen.range[0] < chosen.range[1],
        fmt::format("calibration: only {} samples of the compression press at overlaps up to {}. "
                    "Compress further (capsule.min_radius) or write more often (output.every).",
                    chosen.force.size(), highest),
        Exit::kCannotContinue);
  chosen.rms = std::sqrt(chosen.rms / static_cast<double>(chosen.force.size()));
  return chosen;
}

/// Leading term, and its power if that is fitted as well: x = {factor, power}, of order one.
struct LeadingTerm {
  double modulus = 0, highest = 0, power = 4;
  /// Lower bound of the factor, which is what the term adds at the end of the range, over the
  /// modulus. A trial of the solver below -1 would leave no modulus at `highest`.
  static constexpr double kLeastFactor = -0.99;
  cbm::StiffnessLaw::Term at(const Eigen::VectorXd& x) const {
    const double p = x.size() > 1 ? kLeastPower + (power - kLeastPower) * std::exp(x[1]) : power;
    return {std::max(x[0], kLeastFactor) * modulus / std::pow(highest, p), p};
  }
};

/// Residuals for Eigen's solver: force of spheres minus target, over the rms of the target.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  // NOLINTNEXTLINE(readability-identifier-naming): the names that Eigen asks for
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Samples& samples;
  const cbm::Params& sphere;
  const LeadingTerm& term;
  int unknowns;

  int inputs() const { return unknowns; }
  int values() const { return static_cast<int>(samples.force.size()); }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    cbm::Params p = sphere;
    p.correction = {{term.at(x)}, {}, term.highest};
    for (std::size_t k = 0; k < samples.force.size(); ++k)
      r[static_cast<Eigen::Index>(k)] =
          (bulk_as_spheres(samples.compression.snapshots[k], p, samples.compression.inner).force -
           samples.force[k]) /
          samples.rms;
    return 0;
  }
};

struct Solution {
  Eigen::VectorXd x;
  double spread = 0;  ///< standard deviation of x[0]
};

Solution solve(Residuals& residuals) {
  Solution s;
  s.x = Eigen::VectorXd::Zero(residuals.inputs());
  s.x[0] = 5;
  Eigen::NumericalDiff<Residuals> model(residuals, kDifference * kDifference);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(model);
  solver.parameters.factor = 1;  // first steps no longer than the start: powers are touchy
  solver.parameters.ftol = 1e-8;
  solver.parameters.xtol = 1e-4;
  solver.parameters.maxfev = 60;
  solver.minimize(s.x);
  Eigen::VectorXd residual(residuals.values());
  residuals(s.x, residual);
  Eigen::MatrixXd j(residuals.values(), residuals.inputs());
  model.df(s.x, j);
  const double freedom = std::max(1, residuals.values() - residuals.inputs());
  const Eigen::MatrixXd covariance =
      residual.squaredNorm() / freedom *
      (j.transpose() * j).completeOrthogonalDecomposition().pseudoInverse();
  s.spread = std::sqrt(std::max(0.0, covariance(0, 0)));
  return s;
}

/// Computes the figures of merit of a fitted curve.
void rate(const Samples& samples, const cbm::Params& sphere, FitAttempt& attempt) {
  const auto n = static_cast<double>(samples.force.size());
  double mean = 0, total = 0, misfit = 0, pointwise = 0;
  for (const double force : samples.force) mean += force / n;
  for (std::size_t k = 0; k < samples.force.size(); ++k) {
    const double force = samples.force[k];
    const double miss = force_with(attempt.law, samples.compression.snapshots[k], sphere,
                                   samples.compression.inner) -
                        force;
    total += (force - mean) * (force - mean);
    misfit += miss * miss;
    pointwise += std::pow(miss / force, 2) / n;
  }
  attempt.law.rms_relative = std::sqrt(misfit / n) / samples.rms;
  attempt.law.r_squared = 1 - misfit / total;
  attempt.pointwise = std::sqrt(pointwise);
}

}  // namespace

double relative_error(const ForceCurve& target, const ForceCurve& spheres, double highest) {
  const ForceCurve* both[] = {&target, &spheres};
  double difference = 0, size = 0;
  for (const double d : common_overlaps(both, highest, 40)) {
    difference += std::pow(force_at(spheres, d) - force_at(target, d), 2);
    size += std::pow(force_at(target, d), 2);
  }
  return std::sqrt(difference / size);
}

std::vector<FitAttempt> fit_law(const Compression& compression, const cbm::Params& sphere,
                                const FitOptions& options) {
  const Samples samples = choose_samples(compression, sphere, options.highest);
  const LeadingTerm leading{sphere.young, samples.range[1], options.power};
  Residuals residuals{samples, sphere, leading, options.free_power ? 2 : 1};
  const Solution best = solve(residuals);
  const cbm::StiffnessLaw::Term term = leading.at(best.x);
  check(std::isfinite(term.factor) && best.x[0] > kLeastGain,
        fmt::format("calibration: no positive a1 fits (found {:.4g} kPa): these deformable cells "
                    "are softer than spheres at every overlap, so spheres need no correction",
                    term.factor),
        Exit::kCannotContinue);
  FitAttempt attempt;
  attempt.form = fmt::format("a0 + a1 d^{:.3g}", term.power);
  attempt.law.a0 = sphere.young;
  attempt.law.a1 = term.factor;
  attempt.law.power = term.power;
  const double spread =
      kNormal95 * best.spread * sphere.young / std::pow(leading.highest, options.power);
  attempt.law.a1_interval = {term.factor - spread, term.factor + spread};
  attempt.law.overlap_range = samples.range;
  attempt.law.jkr_underestimation = samples.stiffer;
  rate(samples, sphere, attempt);
  std::vector<FitAttempt> attempts{attempt};
  if (attempt.law.rms_relative <= options.good_enough) return attempts;

  attempt.law = tabulate_law(compression, sphere, attempt.law);
  attempt.form = fmt::format("a table of {} moduli", attempt.law.table.size());
  rate(samples, sphere, attempt);
  if (attempt.law.rms_relative < attempts[0].law.rms_relative) attempts.push_back(attempt);
  return attempts;
}

}  // namespace acinus::calibration
