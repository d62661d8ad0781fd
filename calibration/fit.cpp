#include "calibration/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "calibration/table.hpp"
#include "core/error.hpp"

namespace acinus::calibration {
namespace {

constexpr double kDifference = 1e-3;  ///< relative step of difference quotients
constexpr double kLeastPower = 1.05;
constexpr double kNormal95 = 1.96;
constexpr std::size_t kLeastSamples = 8;
constexpr double kPresses = 0.01;  ///< share of the largest force from which on a moment counts

/// The moments that count, and what is known about them.
struct Samples {
  std::vector<Moment> moment;
  std::array<double, 2> range{};  ///< of d
  double rms = 0;                 ///< nN, of the force
  double stiffer = 0;  ///< their force over that of plain spheres at the end of the range
};

Samples choose_samples(const std::vector<Moment>& squeeze, const cbm::Params& sphere,
                       const Vec3& point, double highest) {
  Samples chosen;
  chosen.range = {highest, 0};
  double largest = 0;
  for (const Moment& m : squeeze) largest = std::max(largest, m.force);
  for (const Moment& m : squeeze) {
    const ClumpSample s = measure_as_spheres(m, sphere, point);
    if (m.force < kPresses * largest || s.overlap > highest) continue;
    chosen.moment.push_back(m);
    chosen.range[0] = std::min(chosen.range[0], s.overlap);
    if (s.overlap > chosen.range[1]) chosen.stiffer = m.force / s.force;
    chosen.range[1] = std::max(chosen.range[1], s.overlap);
    chosen.rms += m.force * m.force;
  }
  check(chosen.moment.size() >= kLeastSamples && chosen.range[0] < chosen.range[1],
        fmt::format("calibration: only {} samples of the squeeze press at overlaps up to {}. "
                    "Squeeze further (capsule.min_radius) or write more often (output.every).",
                    chosen.moment.size(), highest),
        Exit::kCannotContinue);
  chosen.rms = std::sqrt(chosen.rms / static_cast<double>(chosen.moment.size()));
  return chosen;
}

/// The leading term, and its power if that is sought as well: x = {factor, power}, of order one.
struct LeadingTerm {
  double modulus = 0, highest = 0, power = 4;
  /// The factor is what the term adds at the end of the range, over the modulus.
  cbm::StiffnessLaw::Term at(const Eigen::VectorXd& x) const {
    const double p = x.size() > 1 ? kLeastPower + (power - kLeastPower) * std::exp(x[1]) : power;
    return {x[0] * modulus / std::pow(highest, p), p};
  }
};

/// Residuals as Eigen's solver wants them: force of spheres minus target, over the rms of it.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Samples& samples;
  const cbm::Params& sphere;
  const Vec3& point;
  const LeadingTerm& term;
  int unknowns;

  int inputs() const { return unknowns; }
  int values() const { return static_cast<int>(samples.moment.size()); }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    cbm::Params p = sphere;
    p.correction = {{term.at(x)}, {}, term.highest};
    for (std::size_t k = 0; k < samples.moment.size(); ++k)
      r[static_cast<Eigen::Index>(k)] =
          (measure_as_spheres(samples.moment[k], p, point).force - samples.moment[k].force) /
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

/// What the figures of a law say about its curve.
void judge(const Samples& samples, const cbm::Params& sphere, const Vec3& point,
           FitAttempt& attempt) {
  const auto n = static_cast<double>(samples.moment.size());
  double mean = 0, total = 0, misfit = 0, pointwise = 0;
  for (const Moment& m : samples.moment) mean += m.force / n;
  for (const Moment& m : samples.moment) {
    const double miss = force_with(attempt.law, m, sphere, point) - m.force;
    total += (m.force - mean) * (m.force - mean);
    misfit += miss * miss;
    pointwise += std::pow(miss / m.force, 2) / n;
  }
  attempt.law.rms_relative = std::sqrt(misfit / n) / samples.rms;
  attempt.law.r_squared = 1 - misfit / total;
  attempt.pointwise = std::sqrt(pointwise);
}

}  // namespace

double relative_error(const Curve& target, const Curve& spheres, double highest) {
  const Curve* both[] = {&target, &spheres};
  double difference = 0, size = 0;
  for (const double d : common_overlaps(both, highest, 40)) {
    difference += std::pow(force_at(spheres, d) - force_at(target, d), 2);
    size += std::pow(force_at(target, d), 2);
  }
  return std::sqrt(difference / size);
}

std::vector<FitAttempt> fit_law(const std::vector<Moment>& squeeze, const cbm::Params& sphere,
                                const Vec3& point, const FitOptions& options) {
  const Samples samples = choose_samples(squeeze, sphere, point, options.highest);
  const LeadingTerm leading{sphere.young, samples.range[1], options.power};
  Residuals residuals{samples, sphere, point, leading, options.free_power ? 2 : 1};
  const Solution best = solve(residuals);
  const cbm::StiffnessLaw::Term term = leading.at(best.x);
  check(std::isfinite(term.factor) && term.factor > 0,
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
  judge(samples, sphere, point, attempt);
  std::vector<FitAttempt> attempts{attempt};
  if (attempt.law.rms_relative <= options.good_enough) return attempts;

  attempt.law = tabulate_law(squeeze, sphere, point, attempt.law);
  attempt.form = fmt::format("a table of {} moduli", attempt.law.table.size());
  judge(samples, sphere, point, attempt);
  if (attempt.law.rms_relative < attempts[0].law.rms_relative) attempts.push_back(attempt);
  return attempts;
}

}  // namespace acinus::calibration
