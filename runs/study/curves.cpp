#include "runs/study/curves.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::runs {
namespace {

constexpr double kSameFrame = 1e-3;  // s: times of frames closer than this are the same moment

/// Continued fraction of the incomplete beta function [Press et al., Numerical Recipes, 6.4] by the
/// modified Lentz method, for x < (a + 1) / (a + b + 2).
double beta_fraction(double a, double b, double x) {
  constexpr double kTiny = 1e-300, kConverged = 1e-15;
  constexpr int kMostTerms = 10000;
  const auto guarded = [](double v) { return std::abs(v) < kTiny ? kTiny : v; };
  double c = 1, d = 1 / guarded(1 - (a + b) * x / (a + 1)), h = d;
  for (int m = 1; m <= kMostTerms; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    d = 1 / guarded(1 + even * d);
    c = guarded(1 + even / c);
    h *= d * c;
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    d = 1 / guarded(1 + odd * d);
    c = guarded(1 + odd / c);
    h *= d * c;
    if (std::abs(d * c - 1) < kConverged) break;
  }
  return h;
}

/// Regularised incomplete beta function I_x(a, b).
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                a * std::log(x) + b * std::log1p(-x));
  if (x < (a + 1) / (a + b + 2)) return front * beta_fraction(a, b, x) / a;
  return 1 - front * beta_fraction(b, a, 1 - x) / b;
}

struct Moments {
  double mean = 0, variance_of_mean = 0;
};
Moments moments(const std::vector<double>& v) {
  const auto n = static_cast<double>(v.size());
  Moments m;
  for (double x : v) m.mean += x / n;
  for (double x : v) m.variance_of_mean += (x - m.mean) * (x - m.mean) / (n - 1) / n;
  return m;
}

/// Two-sided tail probability of Student's t distribution.
/// @param t2       squared t statistic
/// @param freedom  degrees of freedom
double two_sided(double t2, double freedom) {
  return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t2));
}

}  // namespace

std::optional<double> value_at(const TimeCurve& c, double time) {
  if (c.time.empty() || time < c.time.front() - kSameFrame || time > c.time.back() + kSameFrame)
    return std::nullopt;
  const auto after = std::upper_bound(c.time.begin(), c.time.end(), time);
  if (after == c.time.begin()) return c.value.front();
  const auto k = static_cast<std::size_t>(after - c.time.begin()) - 1;
  if (k + 1 == c.time.size()) return c.value.back();
  const double part = (time - c.time[k]) / (c.time[k + 1] - c.time[k]);
  return c.value[k] + part * (c.value[k + 1] - c.value[k]);
}

std::optional<double> first_passage(const TimeCurve& c, double level, bool below, double from,
                                    double until) {
  const double sign = below ? 1 : -1;
  const auto beyond = [&](double v) { return sign * v <= sign * level; };
  std::optional<std::size_t> before;
  for (std::size_t k = 0; k < c.time.size(); ++k) {
    if (c.time[k] > until + kSameFrame) break;
    if (c.time[k] < from - kSameFrame) continue;
    if (beyond(c.value[k])) {
      if (!before) return c.time[k];
      const double v = c.value[*before], w = c.value[k];
      return c.time[*before] + (level - v) / (w - v) * (c.time[k] - c.time[*before]);
    }
    before = k;
  }
  return std::nullopt;
}

TimeCurve window(const TimeCurve& c, double from, double until) {
  const std::optional<double> first = value_at(c, from), last = value_at(c, until);
  if (!first || !last) return {};
  TimeCurve out{{from}, {*first}};
  for (std::size_t k = 0; k < c.time.size(); ++k)
    if (c.time[k] > from + kSameFrame && c.time[k] < until - kSameFrame) {
      out.time.push_back(c.time[k]);
      out.value.push_back(c.value[k]);
    }
  if (until > from) {
    out.time.push_back(until);
    out.value.push_back(*last);
  }
  return out;
}

double time_mean(const TimeCurve& c) {
  const double length = c.time.back() - c.time.front();
  if (length <= 0) return c.value.front();
  double sum = 0;
  for (std::size_t k = 1; k < c.time.size(); ++k)
    sum += 0.5 * (c.value[k] + c.value[k - 1]) * (c.time[k] - c.time[k - 1]);
  return sum / length;
}

std::optional<double> welch_p(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2 || b.size() < 2) return std::nullopt;
  const Moments p = moments(a), q = moments(b);
  const double variance = p.variance_of_mean + q.variance_of_mean;
  if (!(variance > 0)) return std::nullopt;
  const double t2 = (p.mean - q.mean) * (p.mean - q.mean) / variance;
  const double freedom =
      variance * variance /
      (p.variance_of_mean * p.variance_of_mean / (static_cast<double>(a.size()) - 1) +
       q.variance_of_mean * q.variance_of_mean / (static_cast<double>(b.size()) - 1));
  return two_sided(t2, freedom);
}

std::optional<double> paired_p(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2) return std::nullopt;
  std::vector<double> difference;
  for (std::size_t k = 0; k < a.size(); ++k) difference.push_back(a[k] - b[k]);
  const Moments m = moments(difference);
  if (!(m.variance_of_mean > 0)) return std::nullopt;
  return two_sided(m.mean * m.mean / m.variance_of_mean, static_cast<double>(a.size()) - 1);
}

}  // namespace acinus::runs
