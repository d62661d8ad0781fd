#include <fmt/format.h>

#include "core/units/units.hpp"
#include "runs/scene/scene_rules.hpp"

namespace acinus::runs {
namespace {

std::string hours(double value) { return "\"" + format_quantity(value, kTime, "h") + "\""; }

void check_cycle(const Scene& scene, const coupling::CycleParams& cycle, const std::string& pointer,
                 Report& report) {
  if (cycle.axis == coupling::DivisionAxis::kGiven && cycle.direction.norm() <= 1e-12) {
    report.add_relation({pointer + "/direction"}, "[0, 0, 0]",
                        "must not be zero: it is the direction in which cells divide");
  }
  if (cycle.time == 0) return;
  const double shortest = cycle.time * (1 - 3 * cycle.spread);
  if (cycle.mitosis > shortest) {
    report.add_relation(
        {pointer + "/mitosis", pointer + "/time", pointer + "/spread"}, hours(cycle.mitosis),
        fmt::format(
            "must not exceed {:.4g} h: mitosis is part of the cycle, and the shortest cycle "
            "drawn is {}/time = {} minus three times {}/spread = {} of it",
            shortest / 3600, pointer, hours(cycle.time), pointer, cycle.spread));
  }
  if (cycle.axis == coupling::DivisionAxis::kVessel && scene.vessels.file.empty() &&
      !scene.lobule) {
    report.add_relation({pointer + "/axis", "/vessels/file", "/lobule"}, "\"vessel\"",
                        "needs vessels: give /vessels/file or a lobule block");
  }
}

/// Checks the integrator: only the linearly implicit one can add and remove cells.
void check_integrator(const Scene& scene, const std::string& pointer, Report& report) {
  if (scene.numerics.integrator == coupling::Integrator::kLinearlyImplicit) return;
  report.add_relation({"/time/integrator", pointer},
                      "\"" + name_of_choice(scene.numerics.integrator) + "\"",
                      fmt::format("cannot follow cells that grow, divide or die ({}). Choose "
                                  "\"linearly-implicit\"",
                                  pointer));
}

void check_proliferation(const Scene& scene, Report& report) {
  if (!scene.life.proliferation) return;
  const ProliferationBlock& p = *scene.life.proliferation;
  const std::string pointer = "/life/proliferation";
  if (p.edge_at_start && !scene.lobule)
    report.add_relation({pointer + "/edge", "/lobule"}, "\"start\"",
                        "needs a lobule block, whose lesion_radius is that edge. Choose \"now\"");
  for (std::size_t i = 0; i < p.rate.size(); ++i) {
    const coupling::EntryRate& r = p.rate[i];
    const std::string at = fmt::format("{}/rates/{}", pointer, i);
    if (r.last_layer < r.first_layer)
      report.add_relation({at + "/last_layer", at + "/first_layer"},
                          fmt::format("{}", r.last_layer),
                          fmt::format("must not be below {}/first_layer = {}", at, r.first_layer));
    if (r.until <= r.from)
      report.add_relation({at + "/until", at + "/from"}, hours(r.until),
                          fmt::format("must be after {}/from = {}", at, hours(r.from)));
  }
  for (const auto& [name, type] : scene.cell_types)
    if (type.cycle.time > 0) return;
  report.add_relation(
      {pointer, "/cell_types"}, "",
      "has no cells to call: no cell type has a cycle. Give cell_types.<name>.cycle "
      "a time");
}

}  // namespace

void check_life(const Scene& scene, Report& report) {
  std::string reason;  // one complaint about the integrator is enough
  for (const auto& [name, type] : scene.cell_types) {
    const std::string pointer = "/cell_types/" + name + "/cycle";
    check_cycle(scene, type.cycle, pointer, report);
    if (type.cycle.time > 0 && reason.empty()) reason = pointer + "/time";
  }
  check_proliferation(scene, report);
  for (std::size_t i = 0; i < scene.life.rules.size(); ++i) {
    const LifeRuleBlock& rule = scene.life.rules[i];
    const std::string pointer = fmt::format("/life/rules/{}", i);
    if (rule.region) check_region(*rule.region, pointer + "/region", report);
    if (rule.until <= rule.from) {
      report.add_relation({pointer + "/until", pointer + "/from"}, hours(rule.until),
                          fmt::format("must be after {}/from = {}", pointer, hours(rule.from)));
    }
    if (rule.die && reason.empty()) reason = pointer + "/do";
  }
  for (std::size_t i = 0; i < scene.rules.size(); ++i)
    if (scene.rules[i].behaviour == coupling::Behaviour::kDeath && reason.empty())
      reason = fmt::format("/rules/{}/behaviour", i);
  if (!reason.empty()) check_integrator(scene, reason, report);
}

}  // namespace acinus::runs
