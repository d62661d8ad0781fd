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

constexpr int kPoints = 40;
constexpr double kDifference = 1e-3;  ///< relative step of difference quotients
constexpr double kNormal95 = 1.96;

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
  if (u.power) powers[0] = std::max(1.05, powers[0] * x[u.size() - 1]);
  for (const double p : powers) t.term.push_back({x[k++] * scale_of(fixed.a0, highest, p), p});
  if (u.modulus) t.a0 = fixed.a0 * std::max(1e-3, x[k]);
  return t;
}

/// Residuals as Eigen's solver wants them: force of spheres minus target, over the target's rms.
struct Residuals {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Curve& target;
  const SqueezeSpheres& squeeze;
  const Unknowns& unknowns;
  const Trial& fixed;
  double highest, rms;
  std::vector<double> overlap;

  int inputs() const { return unknowns.size(); }
  int values() const { return static_cast<int>(overlap.size()); }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    const Trial t = trial_at(x, unknowns, fixed, highest);
    const Curve c = squeeze({t.term, highest}, t.a0);
    for (std::size_t k = 0; k < overlap.size(); ++k)
      r[static_cast<Eigen::Index>(k)] =
          c.empty() ? 1e3 : (force_at(c, overlap[k]) - force_at(target, overlap[k])) / rms;
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
  solver.parameters.ftol = 1e-6;
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
void judge(const Curve& target, const Curve& plain, const std::vector<double>& overlap,
           const Eigen::VectorXd& residual, double rms, FitAttempt& attempt) {
  const auto n = static_cast<double>(overlap.size());
  double mean = 0, total = 0, pointwise = 0;
  for (const double d : overlap) mean += force_at(target, d) / n;
  for (std::size_t k = 0; k < overlap.size(); ++k) {
    const double f = force_at(target, overlap[k]);
    total += (f - mean) * (f - mean);
    pointwise += std::pow(residual[static_cast<Eigen::Index>(k)] * rms / f, 2) / n;
  }
  const double misfit = residual.squaredNorm() * rms * rms;
  attempt.law.rms_relative = std::sqrt(residual.squaredNorm() / n);
  attempt.law.r_squared = 1 - misfit / total;
  attempt.law.overlap_range = {overlap.front(), overlap.back()};
  attempt.law.jkr_underestimation =
      force_at(target, overlap.back()) / force_at(plain, overlap.back());
  attempt.pointwise = std::sqrt(pointwise);
}

double rms_force(const Curve& curve, const std::vector<double>& overlap) {
  double sum = 0;
  for (const double d : overlap) sum += std::pow(force_at(curve, d), 2);
  return std::sqrt(sum / static_cast<double>(overlap.size()));
}

}  // namespace

double relative_error(const Curve& target, const Curve& spheres, double highest, int n) {
  const Curve* both[] = {&target, &spheres};
  const std::vector<double> overlap = common_overlaps(both, highest, n);
  check(!overlap.empty(), "the two force-overlap curves have no overlap in common",
        Exit::kCannotContinue);
  double sum = 0;
  for (const double d : overlap) sum += std::pow(force_at(spheres, d) - force_at(target, d), 2);
  return std::sqrt(sum / n) / rms_force(target, overlap);
}

std::vector<FitAttempt> fit_law(const Curve& target, double a0, const SqueezeSpheres& squeeze,
                                const FitOptions& options) {
  const Curve plain = squeeze({}, a0);
  const Curve* both[] = {&target, &plain};
  const std::vector<double> overlap = common_overlaps(both, options.highest, kPoints);
  check(!overlap.empty(),
        "calibration: the squeezed spheres and the squeezed deformable cells have no overlap d in "
        "common. Squeeze further (capsule.min_radius).",
        Exit::kCannotContinue);
  const double highest = overlap.back(), rms = rms_force(target, overlap);
  std::vector<FitAttempt> attempts;

  const Unknowns leading{{options.power}, options.free_modulus, options.free_power};
  const Trial none{a0, {}};
  Residuals residuals{target, squeeze, leading, none, highest, rms, overlap};
  Eigen::VectorXd start = Eigen::VectorXd::Ones(leading.size());
  start[0] = 5;
  Solution first = solve(residuals, start);
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
  const double spread = kNormal95 * first.spread * scale_of(a0, highest, options.power);
  attempt.law.a1_interval = {a1 - spread, a1 + spread};
  judge(target, plain, overlap, first.residual, rms, attempt);
  attempts.push_back(attempt);

  const Trial known = first.trial;
  for (const std::vector<double>& powers :
       {std::vector<double>{4, 6}, std::vector<double>{4, 6, 8}}) {
    if (attempts.back().law.rms_relative <= options.good_enough) break;
    const Unknowns more{powers, false, false};
    Residuals again{target, squeeze, more, known, highest, rms, overlap};
    const Solution s = solve(again, Eigen::VectorXd::Zero(more.size()));
    FitAttempt next = attempt;
    next.form += " + terms";
    for (const double p : powers) next.form += fmt::format(" d^{:g}", p);
    next.law.further.assign(s.trial.term.begin() + 1, s.trial.term.end());
    judge(target, plain, overlap, s.residual, rms, next);
    if (next.law.rms_relative < attempts.back().law.rms_relative) attempts.push_back(next);
  }
  return attempts;
}

}  // namespace acinus::calibration
