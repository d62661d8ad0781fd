#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/numbers/time_grid.hpp"
#include "core/units/units.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

std::string time_text(double value) { return "\"" + format_quantity(value, kTime, "s") + "\""; }

void check_steps(const Scene& scene, Report& report) {
  const coupling::Numerics& numerics = scene.numerics;
  if (numerics.max_step < numerics.min_step) {
    report.add_relation({"/time/step", "/time/min_step"}, time_text(numerics.max_step),
                        fmt::format("must not be below /time/min_step = {}. Raise step or lower "
                                    "min_step",
                                    time_text(numerics.min_step)));
  }
}

/// Time between two events of a kind, and the largest number of them.
struct Period {
  const char* pointer;
  double value;                      ///< s
  double most;                       ///< events in a run
  const char* what;                  ///< name of the events
  double shortest = 10 * kSameTime;  ///< s; closer events are taken for one
};

/// Bounds the number of frames and of other periodic events: a slip of the unit would fill the
/// disk, or make steps so short that the run never ends.
void check_periods(const Scene& scene, Report& report) {
  constexpr double kMostFrames = 1e6, kMostLooks = 1e8, kMostSteps = 1e9;
  double span = scene.time.end, start_up = 0;
  if (scene.start_up.enabled)
    start_up =
        scene.start_up.growth_time + scene.start_up.adhesion_ramp + scene.start_up.max_settle;
  if (scene.output.start_up) span += start_up;
  std::vector<Period> periods{{"/output/every", scene.output.every, kMostFrames, "frames"}};
  periods.push_back({"/time/step", scene.numerics.max_step, kMostSteps, "steps", 0});
  if (scene.motility.random)
    periods.push_back({"/motility/grid", scene.motility.grid, kMostLooks, "random forces"});
  if (scene.motility.leader_force > 0)
    periods.push_back({"/motility/leader_grid", scene.motility.leader_grid, kMostLooks, "choices"});
  periods.push_back({"/life/grid", scene.life.grid, kMostLooks, "looks"});
  if (scene.moving_zoom)
    periods.push_back({"/moving_zoom/every", scene.moving_zoom->grid, kMostLooks, "looks"});
  for (const Period& p : periods) {
    const double least = std::max(span / p.most, p.shortest);
    if (p.value >= least) continue;
    report.add_relation(
        {p.pointer, "/time/end"}, time_text(p.value),
        fmt::format(
            "asks for {:.3g} {} until /time/end = {}; at most {:.3g} are possible. Raise it "
            "to at least {}",
            span / p.value, p.what, time_text(scene.time.end), span / least, time_text(least)));
  }
}

}  // namespace

void check_times(const Scene& scene, Report& report) {
  check_steps(scene, report);
  check_periods(scene, report);
}

}  // namespace acinus::runs
