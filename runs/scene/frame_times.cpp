#include "runs/scene/frame_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/numbers/time_grid.hpp"

namespace acinus::runs {
namespace {

constexpr double kNoTime = std::numeric_limits<double>::infinity();
constexpr double kFirst = 1;  ///< s after an opening

std::vector<double> openings(const Scene& scene) {
  std::vector<double> t;
  if (scene.capsule.enabled && scene.capsule.opens) t.push_back(*scene.capsule.opens);
  for (const WallEntry& w : scene.walls)
    if (w.opens) t.push_back(*w.opens);
  return t;
}

}  // namespace

double next_opening(const Scene& scene, double time) {
  double next = kNoTime;
  for (const double t : openings(scene))
    if (t > time + kSameTime) next = std::min(next, t);
  return next;
}

double next_frame_of_opening(const Scene& scene, double time) {
  if (scene.output.after_opening == 0) return kNoTime;
  const double next = next_opening(scene, time);
  double last = -kNoTime;
  for (const double t : openings(scene))
    if (t <= time + kSameTime) last = std::max(last, t);
  if (!std::isfinite(last)) return next;
  const double per_decade = scene.output.after_opening, since = time - last;
  const auto at = [&](double k) { return last + kFirst * std::pow(10, k / per_decade); };
  double k = since < kFirst ? 0 : std::floor(per_decade * std::log10(since / kFirst));
  while (at(k) <= time + kSameTime) ++k;
  return std::min(next, at(k));
}

double next_frame(const Scene& scene, double time) {
  const double every = scene.output.every;
  return std::min((std::floor((time + kSameTime) / every) + 1) * every,
                  next_frame_of_opening(scene, time));
}

}  // namespace acinus::runs
