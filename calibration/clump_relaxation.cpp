#include "calibration/clump_relaxation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/clump.hpp"
#include "core/error.hpp"
#include "core/parallel/stop.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"

namespace acinus::calibration {
namespace {

constexpr double kFirstSample = 5;     ///< s after the release, at Table 1 friction
constexpr double kSampleRatio = 1.15;  ///< ratio of the times of successive samples
constexpr double kRestShare = 0.01;  ///< largest share of the recovery in its second half, at rest
constexpr double kLeastDuration = 600;     ///< s, least duration at Table 1 friction
constexpr double kSolverTolerance = 1e-5;  ///< the slow tail consists of small changes
constexpr double kLargestDuration = 1e3 * 3600;

/// Weights of the samples by the trapezoidal rule: the time that each stands for.
std::vector<double> weights_of(std::span<const double> t) {
  std::vector<double> w(t.size(), 0.0);
  for (std::size_t k = 1; k < t.size(); ++k) {
    w[k - 1] += 0.5 * (t[k] - t[k - 1]);
    w[k] += 0.5 * (t[k] - t[k - 1]);
  }
  return w;
}

/// Best start and end for a given decay time, and the remaining misfit.
Decay fit_with_time(double time, std::span<const double> t, std::span<const double> y,
                    std::span<const double> w) {
  double s = 0, se = 0, see = 0, sy = 0, sey = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double e = std::exp(-t[k] / time);
    s += w[k];
    se += w[k] * e;
    see += w[k] * e * e;
    sy += w[k] * y[k];
    sey += w[k] * e * y[k];
  }
  const double determinant = s * see - se * se;
  const double height = determinant > 0 ? (s * sey - se * sy) / determinant : 0;
  Decay d;
  d.time = time;
  d.end = (sy - height * se) / s;
  d.start = d.end + height;
  for (std::size_t k = 0; k < t.size(); ++k)
    d.rms += w[k] / s * std::pow(d.end + height * std::exp(-t[k] / time) - y[k], 2);
  d.rms = std::sqrt(d.rms);
  return d;
}

/// Compressed clump without its capsule, with the steps and solver settings of its relaxation.
coupling::World make_released(coupling::World world, double scale) {
  world.params.boundary.capsules.clear();
  world.params.motility.random = false;
  coupling::Numerics& numerics = world.params.numerics;
  numerics.max_step *= scale;
  numerics.min_step *= scale;
  numerics.cg.tolerance = std::min(numerics.cg.tolerance, kSolverTolerance);
  world.state.clock.step = kFirstSample * scale / 10;
  world.state.clock.last_step = 0;  // what happened in the capsule says nothing about what comes
  return world;
}

}  // namespace

Decay fit_decay(std::span<const double> t, std::span<const double> y) {
  const std::vector<double> w = weights_of(t);
  double low = std::log(t[1] / 10), high = std::log(t.back() * 10);
  constexpr int kScan = 200;
  double best = low;
  double least = fit_with_time(std::exp(low), t, y, w).rms;
  for (int k = 1; k <= kScan; ++k) {
    const double x = low + (high - low) * k / kScan;
    if (const double rms = fit_with_time(std::exp(x), t, y, w).rms; rms < least) {
      least = rms;
      best = x;
    }
  }
  const double step = (high - low) / kScan;
  low = best - step;
  high = best + step;
  constexpr double kGolden = 0.6180339887498949;
  for (int k = 0; k < 60; ++k) {
    const double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
    if (fit_with_time(std::exp(a), t, y, w).rms < fit_with_time(std::exp(b), t, y, w).rms)
      high = b;
    else
      low = a;
  }
  Decay d = fit_with_time(std::exp(0.5 * (low + high)), t, y, w);
  if (d.start != d.end) d.rms /= std::abs(d.start - d.end);
  return d;
}

void scale_all_friction(coupling::Params& params, double factor) {
  for (dcm::Params& p : params.dcm) {
    p.nodal_friction *= factor;
    p.medium_friction *= factor;
    p.vessel_friction *= factor;
    p.viscosity *= factor;
  }
  for (cbm::Params& p : params.cbm) {
    p.cell_friction *= factor;
    p.medium_friction *= factor;
    p.vessel_friction *= factor;
    p.viscosity *= factor;
  }
  params.dcm_contact.cell_friction *= factor;
  params.interface.friction *= factor;
}

Relaxation relax_clump(coupling::World world, double scale) {
  const Vec3 center = world.params.boundary.capsules.empty()
                          ? Vec3(Vec3::Zero())
                          : world.params.boundary.capsules.front().center;
  coupling::Simulation simulation(make_released(std::move(world), scale));
  Relaxation r;
  std::size_t central = 0;
  const auto look = [&](double time) {
    coupling::observe(simulation.world(), simulation.work());
    const std::vector<coupling::CellMeasure> cells =
        coupling::measure_cells(simulation.world(), simulation.work());
    if (r.time.empty()) central = find_central_cell(cells, center);
    r.time.push_back(time);
    r.overlap.push_back(measure_clump(cells, central).shell_overlap);
  };
  look(0);
  for (double time = 0, next = kFirstSample * scale;; next *= kSampleRatio) {
    const coupling::LoopResult steps = simulation.run_until(simulation.time() + (next - time));
    check(!steps.last.interrupted, "relaxation: stopped by " + describe_stop(), Exit::kStopped);
    check(
        steps.ok,
        fmt::format("relaxation: a step fails {:.4g} h after the release: {}. Cells concerned: {}",
                    time / 3600, steps.last.cause, fmt::join(steps.last.cells, ", ")),
        Exit::kCannotContinue);
    time = next;
    look(time);
    const auto half = std::ranges::lower_bound(r.time, time / 2) - r.time.begin();
    const double late = std::abs(r.overlap.back() - r.overlap[half]),
                 way = std::abs(r.overlap.back() - r.overlap.front());
    if (time >= kLeastDuration * scale && late <= kRestShare * way) break;
    check(
        time < kLargestDuration * scale,
        fmt::format("relaxation: the clump still moves {:.3g} h after its release, overlap {:.4g}",
                    time / 3600, r.overlap.back()),
        Exit::kCannotContinue);
  }
  r.decay = fit_decay(r.time, r.overlap);
  return r;
}

FrictionFit fit_friction(const coupling::World& world, double time) {
  constexpr double kClose = 0.02;
  constexpr int kAttempts = 12;
  const double first = world.params.dcm_contact.cell_friction;
  check(first > 0, "relaxation: friction.dcm_dcm must be > 0 to be fitted");
  double x_before = 0, y_before = 0, x = std::log(first);
  double scale = 1;
  for (int k = 0; k < kAttempts; ++k) {
    coupling::World w = world;
    w.params.dcm_contact.cell_friction = std::exp(x);
    FrictionFit fit{std::exp(x), relax_clump(w, scale)};
    const double y = std::log(fit.relaxation.decay.time / time);
    if (std::abs(y) < kClose) return fit;
    const double slope = k == 0 ? 1 : std::clamp((y - y_before) / (x - x_before), 0.2, 5.0);
    x_before = x;
    y_before = y;
    x -= std::clamp(y / slope, -5.0, 5.0);
    scale = std::max(1.0, std::exp(x) / first);
  }
  throw Error(
      fmt::format("relaxation: no cell-cell friction found that gives {:.3g} h", time / 3600),
      Exit::kCannotContinue);
}

}  // namespace acinus::calibration
