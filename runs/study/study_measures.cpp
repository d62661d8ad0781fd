#include "runs/study/study_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/numbers/time_grid.hpp"
#include "core/units/units.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Curve of one run with its seed and end.
struct RunCurve {
  std::int64_t seed = 0;
  const TimeCurve* curve = nullptr;
  bool complete = false;
  double until = 0;  ///< end of the recording, s
};

/// Curves of all runs of a variant.
/// @param note  receives the reason if one is missing
std::vector<RunCurve> find_curves(const StudyPlan& plan, const StudyData& data,
                                  const std::string& variant, const std::string& observable,
                                  std::string& note) {
  std::vector<RunCurve> found;
  const auto miss = [&](const StudyRun& run, const std::string& why) {
    note += (note.empty() ? "" : ", ") + run.name + " " + why;
  };
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const StudyRun& run = plan.runs[k];
    if (plan.variant_of(run).name != variant) continue;
    const RunData& d = data[k];
    const auto curve = d.curve.find(observable);
    if (has_failed(d.status.state)) {
      miss(run, name_of(d.status.state));
    } else if (curve == d.curve.end() || curve->second.time.empty()) {
      miss(run, d.status.state == RunState::kDone ? "did not measure " + observable
                                                  : std::string("is ") + name_of(d.status.state));
    } else {
      found.push_back({static_cast<std::int64_t>(run.seed), &curve->second,
                       d.status.state == RunState::kDone, d.until});
    }
  }
  return found;
}

double first_time(const TimeCurve& curve) { return std::max(0.0, curve.time.front()); }

/// Tolerance for equal times on a curve, s: 1e-3 of its duration, at most 1 s.
double same_time(const TimeCurve& curve) {
  constexpr double kMostTolerance = 1, kToleranceShare = 1e-3;  // s; of the duration
  return std::clamp(kToleranceShare * (curve.time.back() - curve.time.front()), kSameTime,
                    kMostTolerance);
}

/// Time at which a value is taken, s. The end only for complete runs that have a value there.
std::optional<double> time_of(const RunCurve& s, const std::optional<double>& asked) {
  if (asked) return asked;
  if (!s.complete || s.curve->time.back() < s.until - same_time(*s.curve)) return std::nullopt;
  return s.curve->time.back();
}

std::optional<TimeCurve> window_of(const RunCurve& s, const StudyMeasure& m) {
  const std::optional<double> until = time_of(s, m.until);
  if (!until) return std::nullopt;
  TimeCurve w = window(*s.curve, m.from.value_or(first_time(*s.curve)), *until);
  if (w.time.empty()) return std::nullopt;
  return w;
}

/// Measure of one run; empty if its curve does not reach the times needed.
std::optional<double> of_run(const RunCurve& s, const StudyMeasure& m, double level) {
  if (m.kind == MeasureKind::kValue) {
    const std::optional<double> t = time_of(s, m.at);
    return t ? value_at(*s.curve, *t) : std::nullopt;
  }
  if (is_passage(m)) {
    const double from = m.from.value_or(first_time(*s.curve));
    const auto passed = first_passage(*s.curve, level, m.kind == MeasureKind::kFirstBelow, from,
                                      m.until.value_or(s.curve->time.back()));
    if (passed) return passed;
    return window_of(s, m) ? std::optional(kNever) : std::nullopt;
  }
  const std::optional<TimeCurve> w = window_of(s, m);
  if (!w) return std::nullopt;
  if (m.kind == MeasureKind::kMean) return time_mean(*w);
  return m.kind == MeasureKind::kMin ? *std::ranges::min_element(w->value)
                                     : *std::ranges::max_element(w->value);
}

/// Sets the mean over the seeds, or the median if some are infinite, since one seed must not decide
/// for all; and their range.
/// @pre no value is NaN
void summarise(Measured& out) {
  std::vector<double> sorted;
  for (const auto& [seed, v] : out.by_seed) sorted.push_back(v);
  std::ranges::sort(sorted);
  out.low = sorted.front();
  out.high = sorted.back();
  const auto n = sorted.size();
  const std::size_t n_never = std::ranges::count_if(sorted, [](double v) { return std::isinf(v); });
  if (n_never == 0 || n_never == n) {
    double sum = 0;
    for (double v : sorted) sum += v;
    out.value = n_never == n ? sorted[n / 2] : sum / static_cast<double>(n);
    return;
  }
  const double below = sorted[(n - 1) / 2], above = sorted[n / 2];
  out.value =
      std::isinf(below) || std::isinf(above) ? (n % 2 == 1 ? below : above) : 0.5 * (below + above);
  out.note = fmt::format("the median: {} of {} seeds never", n_never, n);
}

/// Windows of all runs of a variant; empty if one is missing.
std::vector<TimeCurve> windows(const std::vector<RunCurve>& sources, const StudyMeasure& m) {
  std::vector<TimeCurve> out;
  for (const RunCurve& s : sources) {
    const std::optional<TimeCurve> w = window_of(s, m);
    if (!w) return {};
    out.push_back(*w);
  }
  return out;
}

/// Reason why curves cannot be compared over their whole length: different starts or ends without a
/// window in the claim. Empty if they can.
std::string find_unequal_ends(const StudyMeasure& m, const std::vector<RunCurve>& runs) {
  double low[2] = {kNever, kNever}, high[2] = {-kNever, -kNever}, same = kNever;
  for (const RunCurve& s : runs) {
    same = std::min(same, same_time(*s.curve));
    for (const auto& [k, t] : {std::pair{0, first_time(*s.curve)}, {1, s.curve->time.back()}}) {
      low[k] = std::min(low[k], t);
      high[k] = std::max(high[k], t);
    }
  }
  if (!m.until && high[1] - low[1] > same)
    return fmt::format("the runs end at different times, from {} to {}: give the claim an until",
                       show_value(low[1], "s"), show_value(high[1], "s"));
  if (!m.from && high[0] - low[0] > same)
    return fmt::format("the runs begin at different times, from {} to {}: give the claim a from",
                       show_value(low[0], "s"), show_value(high[0], "s"));
  return {};
}

std::set<double> times_of(const std::vector<TimeCurve>& curves) {
  std::set<double> times;
  for (const TimeCurve& c : curves) times.insert(c.time.begin(), c.time.end());
  return times;
}

/// Largest range over the seeds at any time.
std::optional<double> widest_band(const std::vector<TimeCurve>& curves) {
  double widest = 0;
  for (double t : times_of(curves)) {
    double low = kNever, high = -kNever;
    for (const TimeCurve& c : curves)
      if (const auto v = value_at(c, t)) {
        low = std::min(low, *v);
        high = std::max(high, *v);
      }
    widest = std::max(widest, high - low);
  }
  return curves.empty() ? std::nullopt : std::optional(widest);
}

std::optional<double> mean_at(const std::vector<TimeCurve>& curves, double t) {
  double sum = 0;
  for (const TimeCurve& c : curves) {
    const auto v = value_at(c, t);
    if (!v) return std::nullopt;
    sum += *v;
  }
  return sum / static_cast<double>(curves.size());
}

std::optional<double> largest_distance(const std::vector<TimeCurve>& a,
                                       const std::vector<TimeCurve>& b) {
  if (a.empty() || b.empty()) return std::nullopt;
  std::set<double> times = times_of(a);
  times.merge(times_of(b));
  std::optional<double> largest;
  for (double t : times) {
    const auto p = mean_at(a, t), q = mean_at(b, t);
    if (p && q) largest = std::max(largest.value_or(0), std::abs(*p - *q));
  }
  return largest;
}

/// Largest distance of a mean curve from the band between two other mean curves; empty without a
/// common time.
std::optional<double> largest_excess(const std::vector<TimeCurve>& a,
                                     const std::vector<TimeCurve>& b,
                                     const std::vector<TimeCurve>& c) {
  if (a.empty() || b.empty() || c.empty()) return std::nullopt;
  std::set<double> times = times_of(a);
  times.merge(times_of(b));
  times.merge(times_of(c));
  std::optional<double> largest;
  for (double t : times) {
    const auto p = mean_at(a, t), q = mean_at(b, t), r = mean_at(c, t);
    if (!p || !q || !r) continue;
    const auto [low, high] = std::minmax(*q, *r);
    largest = std::max({largest.value_or(0), *p - high, low - *p});
  }
  return largest;
}

std::optional<double> p_value(const std::vector<RunCurve>& a, const std::vector<RunCurve>& b,
                              const StudyMeasure& m, std::string& note) {
  std::vector<double> values[2];
  const bool paired = std::ranges::equal(a, b, {}, &RunCurve::seed, &RunCurve::seed);
  for (const auto& [sources, out] : {std::pair{&a, &values[0]}, {&b, &values[1]}})
    for (const RunCurve& s : *sources) {
      const std::optional<double> t = time_of(s, m.at), v = t ? value_at(*s.curve, *t) : t;
      if (!v) return std::nullopt;
      out->push_back(*v);
    }
  const std::optional<double> p =
      paired ? paired_p(values[0], values[1]) : welch_p(values[0], values[1]);
  if (!p) note = "a t-test needs two seeds of each and a spread";
  return p;
}

Measured none(Measured out, const std::string& note) {
  out.value = out.low = out.high = std::nullopt;
  out.by_seed.clear();
  out.note = note;
  return out;
}

/// Difference or ratio of two values; NaN where it is undefined: infinite minus infinite, or a
/// ratio to infinity.
double combined(const StudyExpectation& e, double a, double b) {
  if (e.minus) return a - b;
  return std::isinf(b) ? std::numeric_limits<double>::quiet_NaN() : a / b;
}

/// Lower bound of a difference with an event that never happened within a run, from the run's
/// length.
double known_difference(double a, double a_until, double b, double b_until) {
  if (std::isinf(a)) return a_until - b;
  return std::isinf(b) ? b_until - a : kNever;
}

}  // namespace

Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyMeasure& m) {
  Measured out;
  out.unit = unit_of(m, plan.units);
  std::string missing;
  const std::vector<RunCurve> a = find_curves(plan, data, m.variant, m.observable, missing);
  std::vector<RunCurve> b, c;
  if (needs_other(m)) b = find_curves(plan, data, m.other, m.observable, missing);
  if (m.kind == MeasureKind::kOutside)
    c = find_curves(plan, data, m.another, m.observable, missing);
  if (!missing.empty()) return none(out, missing);
  if (a.empty() || (needs_other(m) && b.empty())) return none(out, "no runs");
  std::string note = "the runs have not come so far, ended before, or have no value there";
  if ((needs_other(m) || m.kind == MeasureKind::kBand) && m.kind != MeasureKind::kPValue) {
    std::vector<RunCurve> all = a;
    for (const auto* more : {&b, &c}) all.insert(all.end(), more->begin(), more->end());
    if (const std::string unequal = find_unequal_ends(m, all); !unequal.empty())
      return none(out, unequal);
  }
  if (needs_other(m) || m.kind == MeasureKind::kBand) {
    out.value = m.kind == MeasureKind::kPValue ? p_value(a, b, m, note)
                : m.kind == MeasureKind::kOutside
                    ? largest_excess(windows(a, m), windows(b, m), windows(c, m))
                : m.kind == MeasureKind::kDistance ? largest_distance(windows(a, m), windows(b, m))
                                                   : widest_band(windows(a, m));
    return out.value ? out : none(out, note);
  }
  const double level = m.level ? number_in(*m.level, plan.units.at(m.observable)) : 0;
  out.known_until = kNever;
  for (const RunCurve& s : a) {
    const std::optional<double> v = of_run(s, m, level);
    if (!v) return none(out, note);
    out.by_seed[s.seed] = *v;
    out.known_until = std::min(out.known_until, m.until.value_or(s.curve->time.back()));
  }
  summarise(out);
  return out;
}

Measured take_measure(const StudyPlan& plan, const StudyData& data, const StudyExpectation& e) {
  Measured first = take_measure(plan, data, e.measure);
  if (!e.minus && !e.over) return first;
  const Measured second = take_measure(plan, data, e.minus ? *e.minus : *e.over);
  Measured out;
  out.unit = e.over ? "1" : first.unit;
  out.known_until = kNever;
  if (!first.value || !second.value) return none(out, first.value ? second.note : first.note);
  const double scale =
      scale_of_unit(second.unit).in_base / scale_of_unit(first.unit).in_base;  // into the first's
  const auto know = [&](double a, double b) {
    if (e.minus)
      out.known_until = std::min(
          out.known_until, known_difference(a, first.known_until, b, scale * second.known_until));
  };
  const auto same_seeds = [](const auto& p, const auto& q) { return p.first == q.first; };
  if (!first.by_seed.empty() && std::ranges::equal(first.by_seed, second.by_seed, same_seeds)) {
    for (const auto& [seed, v] : first.by_seed) {
      const double other = scale * second.by_seed.at(seed), c = combined(e, v, other);
      if (std::isnan(c)) return none(out, fmt::format("seed {} has no difference or ratio", seed));
      out.by_seed[seed] = c;
      know(v, other);
    }
    summarise(out);
  } else {
    out.value = combined(e, *first.value, scale * *second.value);
    know(*first.value, scale * *second.value);
  }
  // never minus never, or a division by zero
  if (std::isnan(*out.value) || (e.over && !std::isfinite(*out.value)))
    return none(out, "the two measures have no difference or ratio");
  return out;
}

int seeds_within(const Measured& m, std::optional<double> low, std::optional<double> high) {
  return static_cast<int>(std::ranges::count_if(m.by_seed, [&](const auto& seed) {
    return (!low || seed.second >= *low) && (!high || seed.second <= *high);
  }));
}

}  // namespace acinus::runs
