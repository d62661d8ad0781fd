#include "runs/session/idle_rules.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/assemble/build_rules.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {
namespace {

constexpr double kNoticeableSlowing = 0.01;  ///< share of the free growth rate

/// Extreme of a series by an order; `none` without any value.
template <class Choose>
double extreme(const Measures& m, const std::string& name, double none, Choose choose) {
  const auto found = m.find(name);
  return found == m.end() || found->second.empty()
             ? none
             : *choose(found->second.begin(), found->second.end());
}

double largest(const Measures& m, const std::string& name) {
  return extreme(m, name, 0, [](auto a, auto b) { return std::max_element(a, b); });
}

std::string describe_inhibition(const coupling::Inhibition& p, const Measures& m, double slowest) {
  const std::string by = "inhibition by " + name_of_choice(p.by);
  if (p.by == coupling::InhibitedBy::kPressure)
    return fmt::format("{} at {} never slowed growth (highest contact pressure {:.2g} Pa)", by,
                       fmt::format("{:.4g} Pa", 1e3 * p.threshold),
                       std::max(largest(m, "contact_pressure_max_dcm_Pa"),
                                largest(m, "contact_pressure_max_cbm_Pa")));
  const std::string at = p.by == coupling::InhibitedBy::kDensity
                             ? fmt::format("{:.4g} 1/um^3", p.threshold)
                             : fmt::format("{:.3g} of the volume at rest", p.threshold);
  return fmt::format("{} at {} never slowed growth (slowest rate {:.1f} % of the free one)", by, at,
                     100 * slowest);
}

}  // namespace

std::vector<std::string> list_idle_rules(const Scene& scene, const Measures& measures,
                                         const coupling::World& world, double time) {
  std::vector<std::string> list;
  const double slowest =
      extreme(measures, "slowest_growth", 1, [](auto a, auto b) { return std::min_element(a, b); });
  if (slowest > 1 - kNoticeableSlowing)
    for (const auto& [name, type] : scene.cell_types)
      if (type.cycle.inhibition.by != coupling::InhibitedBy::kNothing)
        list.push_back(fmt::format("cell_types.{}: {}", name,
                                   describe_inhibition(type.cycle.inhibition, measures, slowest)));
  const coupling::State& state = world.state;
  const bool lyses = std::ranges::any_of(
      state.cycle, [](const coupling::Cycle& c) { return c.fate == coupling::Fate::kLyse; });
  const bool dies = world.ranks.any(state.deaths > 0 || lyses);
  const bool rests = largest(measures, "resting_cells") > 0;
  for (std::size_t k = 0; k < scene.life.rules.size(); ++k) {
    const bool die = scene.life.rules[k].die;
    if (scene.life.rules[k].from >= time || (die ? dies : rests)) continue;
    list.push_back(die ? fmt::format("life.rules.{} never acted: no cell died", k)
                       : fmt::format("life.rules.{} never acted: no cell rested in any frame", k));
  }
  for (std::size_t k = 0; k < scene.rules.size(); ++k)
    if (largest(measures, fmt::format("rule_{}_cells", k)) == 0)
      list.push_back(fmt::format("rules.{} acted on no cell in any frame by half or more: {}", k,
                                 describe_rule(scene, scene.rules[k])));
  return list;
}

}  // namespace acinus::runs
