#include "runs/build/build_life.hpp"

#include <algorithm>
#include <limits>

#include "runs/build/place_cells.hpp"

namespace acinus::runs {
namespace {

coupling::CycleParams make_cycle(const CellType& t) {
  coupling::CycleParams p;
  const CycleBlock& c = t.cycle;
  p.time = c.time.value_or(0);
  p.spread = c.spread;
  p.mitosis = c.mitosis;
  p.force_ramp = c.force_ramp;
  p.axis = c.axis == "given"    ? coupling::DivisionAxis::kGiven
           : c.axis == "plane"  ? coupling::DivisionAxis::kPlane
           : c.axis == "vessel" ? coupling::DivisionAxis::kVessel
                                : coupling::DivisionAxis::kRandom;
  p.direction = c.direction;
  p.random_start = c.start == "random";
  const InhibitionBlock& i = t.inhibition;
  if (i.by == "pressure")
    p.inhibition = {coupling::InhibitedBy::kPressure, i.pressure_threshold, i.power};
  if (i.by == "volume")
    p.inhibition = {coupling::InhibitedBy::kVolume, i.volume_threshold, i.power};
  if (i.by == "density")
    p.inhibition = {coupling::InhibitedBy::kDensity, i.density_threshold, i.power};
  p.death.lysis = t.death.mode == "lysis";
  p.death.duration = t.death.duration;
  p.death.final_volume = t.death.final_volume;
  return p;
}

coupling::LifeRule make_rule(const Scene& scene, const LifeRuleBlock& r) {
  coupling::LifeRule rule;
  rule.die = r.action == "die";
  if (r.region)
    rule.inside = [region = *r.region, axis = scene.axis_point](const Vec3& x) {
      return in_region(region, axis, x);
    };
  rule.cells = r.cells;
  std::ranges::sort(rule.cells);
  rule.descendants = r.descendants;
  rule.from = r.from;
  rule.until = r.until.value_or(std::numeric_limits<double>::infinity());
  rule.share = r.share;
  return rule;
}

coupling::Proliferation make_proliferation(const Scene& scene, const ProliferationBlock& b) {
  coupling::Proliferation p;
  for (const EntryRateBlock& r : b.rates)
    p.rate.push_back({r.first_layer, r.last_layer, r.rate, r.from,
                      r.until.value_or(std::numeric_limits<double>::infinity())});
  p.thickness = b.layer_thickness.value_or(2 * scene.cell_types.begin()->second.radius);
  p.edge_at_start = b.edge == "start";
  if (scene.lobule) p.start_edge = scene.lobule->lesion_radius;
  p.cells = b.cells;
  p.axis_point = scene.axis_point;
  return p;
}

}  // namespace

void build_life(const Scene& scene, coupling::Params& p, std::vector<std::string>& type_names) {
  p.life.seed = scene.seed;
  p.life.grid = scene.life.grid;
  p.life.remesh = scene.life.remesh;
  if (scene.life.proliferation)
    p.life.proliferation = make_proliferation(scene, *scene.life.proliferation);
  p.sleep = {scene.life.sleep, scene.life.grid, scene.life.sleep_traction};
  for (const auto& [name, type] : scene.cell_types) p.life.type.push_back(make_cycle(type));
  for (const LifeRuleBlock& r : scene.life.rules) p.life.rule.push_back(make_rule(scene, r));
  std::size_t k = 0;
  for (const auto& [name, type] : scene.cell_types) {
    coupling::DeathParams& death = p.life.type[k].death;
    const double soft = type.death.softening;
    if (death.lysis && soft < 1) {
      death.type = static_cast<int>(p.dcm.size());
      dcm::Params shell = p.dcm[k];
      for (double* value : {&shell.spring_stiffness, &shell.bending_stiffness, &shell.bulk_modulus,
                            &shell.adhesion})
        *value *= soft;
      cbm::Params sphere = p.cbm[k];
      sphere.adhesion *= soft;
      p.dcm.push_back(shell);
      p.cbm.push_back(sphere);
      p.life.type.push_back({});
      type_names.push_back(name + " (dissolving)");
    }
    ++k;
  }
}

}  // namespace acinus::runs
