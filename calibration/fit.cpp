#include "calibration/fit.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/error.hpp"

namespace acinus::calibration {
namespace {

constexpr double kDifference = 1e-3;  ///< relative step of difference quotients
constexpr double kLeastPower = 1.05;
constexpr double kLeastModulus = 0.05;  ///< of a0, over the modulus at rest
/// Of the largest force: where a0 is sought, errors below it count absolutely, above it relatively.
/// Large forces say nothing about a0.
constexpr double kSmallForce = 0.2;
constexpr double kNormal95 = 1.96;
constexpr std::size_t kLeastSamples = 8;
constexpr double kPresses = 0.01;  ///< share of the largest force from which on a moment counts

/// Which numbers of a law are sought, each of order one.
struct Unknowns {
  std::vector<double> powers;  ///< of the terms whose factors are sought
  bool modulus = false, power = false;
  int size() const { return static_cast<int>(powers.size()) + (modulus ? 1 : 0) + (power ? 1 : 0); }
};

struct Trial {
  double a0 = 0;
  std::vector<cbm::StiffnessLaw::Term> term;
};

/// A factor enters as what its term adds at the end of the range, over a0.
double scale_of(double a0, double highest, double power) { return a0 / std::pow(highest, power); }

Trial trial_at(const Eigen::VectorXd& x, const Unknowns& u, const Trial& fixed, double highest) {
  Trial t = fixed;
  Eigen::Index k = 0;
  std::vector<double> powers = u.powers;
  if (u.power) powers[0] = kLeastPower + (powers[0] - kLeastPower) * std::exp(x[u.size() - 1]);
  for (const double p : powers) t.term.push_back({x[k++] * scale_of(fixed.a0, highest, p), p});
  if (u.modulus) t.a0 = fixed.a0 * (kLeastModulus + (1 - kLeastModulus) * std::exp(x[k]));
  return t;
}

/// Residuals as Eigen's solver wants them: force of spheres minus target, over `scale`.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const std::vector<Moment>& moments;
  const cbm::Params& sphere;
  const Vec3& point;
  const Unknowns& unknowns;
  const Trial& fixed;
  double highest, rms;
  const std::vector<double>& scale;  ///< nN, what an error counts against

  int inputs() const { return unknowns.size(); }
  int values() const { return static_cast<int>(moments.size()); }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    const Trial t = trial_at(x, unknowns, fixed, highest);
    cbm::Params p = sphere;
    p.young = t.a0;
    p.correction = {t.term, highest};
    for (std::size_t k = 0; k < moments.size(); ++k)
      r[static_cast<Eigen::Index>(k)] =
          (measure_as_spheres(moments[k], p, point).force - moments[k].force) / scale[k];
    return 0;
  }
};

struct Solution {
  Trial trial;
  Eigen::VectorXd x, residual;
  double spread = 0;  ///< standard deviation of x[0]
};

Solution solve(Residuals& residuals, const Eigen::VectorXd& start) {
  Solution s;
  s.x = start;
  Eigen::NumericalDiff<Residuals> model(residuals, kDifference * kDifference);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Residuals>> solver(model);
  solver.parameters.factor = 1;  // first steps no longer than the start: powers are touchy
  solver.parameters.ftol = 1e-8;
  solver.parameters.xtol = 1e-4;
  solver.parameters.maxfev = 60;
  solver.minimize(s.x);
  s.residual.resize(residuals.values());
  residuals(s.x, s.residual);
  Eigen::MatrixXd j(residuals.values(), residuals.inputs());
  model.df(s.x, j);
  const double freedom = std::max(1, residuals.values() - residuals.inputs());
  const Eigen::MatrixXd covariance =
      s.residual.squaredNorm() / freedom *
      (j.transpose() * j).completeOrthogonalDecomposition().pseudoInverse();
  s.spread = std::sqrt(std::max(0.0, covariance(0, 0)));
  s.trial = trial_at(s.x, residuals.unknowns, residuals.fixed, residuals.highest);
  return s;
}

/// What the figures of a law say about its curve.
void judge(const Residuals& residuals, const Eigen::VectorXd& residual, FitAttempt& attempt) {
  const auto n = static_cast<double>(residuals.moments.size());
  double mean = 0, total = 0, misfit = 0, pointwise = 0;
  for (const Moment& m : residuals.moments) mean += m.force / n;
  for (std::size_t k = 0; k < residuals.moments.size(); ++k) {
    const double f = residuals.moments[k].force;
    total += (f - mean) * (f - mean);
    const double miss = residual[static_cast<Eigen::Index>(k)] * residuals.scale[k];
    misfit += miss * miss;
    pointwise += std::pow(miss / f, 2) / n;
  }
  attempt.law.rms_relative = std::sqrt(misfit / n) / residuals.rms;
  attempt.law.r_squared = 1 - misfit / total;
  attempt.pointwise = std::sqrt(pointwise);
}

/// Whether the modulus nowhere falls below what it was at a smaller d by more than a rounding of
/// the fit.
bool never_falls(const Law& law) {
  constexpr double kRounding = 0.02;
  const cbm::StiffnessLaw whole = stiffness_law(law);
  double highest = law.a0;
  for (int k = 0; k <= 200; ++k) {
    const double e =
        cbm::corrected_modulus(whole, law.a0, whole.range * cbm::kLawCap * k / 200).value;
    if (e < (1 - kRounding) * highest) return false;
    highest = std::max(highest, e);
  }
  return true;
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
  std::vector<Moment> moments;
  double low = options.highest, high = 0, rms = 0, largest = 0, stiffer = 0;
  for (const Moment& m : squeeze) largest = std::max(largest, m.force);
  for (const Moment& m : squeeze) {
    const ClumpSample s = measure_as_spheres(m, sphere, point);
    if (m.force < kPresses * largest || s.overlap > options.highest) continue;
    moments.push_back(m);
    low = std::min(low, s.overlap);
    if (s.overlap > high) stiffer = m.force / s.force;
    high = std::max(high, s.overlap);
    rms += m.force * m.force;
  }
  check(moments.size() >= kLeastSamples && low < high,
        fmt::format("calibration: only {} samples of the squeeze press at overlaps up to {}. "
                    "Squeeze further (capsule.min_radius) or write more often (output.every).",
                    moments.size(), options.highest),
        Exit::kCannotContinue);
  rms = std::sqrt(rms / static_cast<double>(moments.size()));
  std::vector<double> scale;
  for (const Moment& m : moments)
    scale.push_back(options.free_modulus ? m.force + kSmallForce * largest : rms);
  std::vector<FitAttempt> attempts;

  const Unknowns leading{{options.power}, options.free_modulus, options.free_power};
  const Trial none{sphere.young, {}};
  Residuals residuals{moments, sphere, point, leading, none, high, rms, scale};
  Eigen::VectorXd start = Eigen::VectorXd::Zero(leading.size());
  start[0] = 5;
  const Solution first = solve(residuals, start);
  const double a1 = first.trial.term[0].factor, power = first.trial.term[0].power;
  check(std::isfinite(a1) && a1 > 0,
        fmt::format("calibration: no positive a1 fits (found {:.4g} kPa): these deformable cells "
                    "are softer than spheres at every overlap, so spheres need no correction",
                    a1),
        Exit::kCannotContinue);
  FitAttempt attempt;
  attempt.form = fmt::format("a0 + a1 d^{:.3g}", power);
  attempt.law.a0 = first.trial.a0;
  attempt.law.a1 = a1;
  attempt.law.power = power;
  const double spread = kNormal95 * first.spread * scale_of(sphere.young, high, options.power);
  attempt.law.a1_interval = {a1 - spread, a1 + spread};
  attempt.law.overlap_range = {low, high};
  attempt.law.jkr_underestimation = stiffer;
  judge(residuals, first.residual, attempt);
  attempts.push_back(attempt);

  const Trial known = first.trial;
  for (const std::vector<double>& powers :
       {std::vector<double>{4, 6}, std::vector<double>{4, 6, 8}}) {
    if (attempts.back().law.rms_relative <= options.good_enough) break;
    const Unknowns more{powers, false, false};
    Residuals again{moments, sphere, point, more, known, high, rms, scale};
    const Solution s = solve(again, Eigen::VectorXd::Zero(more.size()));
    FitAttempt next = attempt;
    next.form += " + terms";
    for (const double p : powers) next.form += fmt::format(" d^{:g}", p);
    next.law.further.assign(s.trial.term.begin() + 1, s.trial.term.end());
    judge(again, s.residual, next);
    if (next.law.rms_relative < attempts.back().law.rms_relative && never_falls(next.law))
      attempts.push_back(next);
  }
  return attempts;
}

}  // namespace acinus::calibration
