#include "runs/assemble/build_life.hpp"

#include <algorithm>

#include "runs/assemble/build_params.hpp"
#include "runs/assemble/cell_constants.hpp"
#include "runs/assemble/place_cells.hpp"

namespace acinus::runs {
namespace {

coupling::LifeRule make_rule(const Scene& scene, const LifeRuleBlock& r) {
  coupling::LifeRule rule = r;
  if (r.region)
    rule.inside = [region = *r.region, axis = scene.axis_point](const Vec3& x) {
      return coupling::in_region(region, axis, x);
    };
  std::ranges::sort(rule.cells);
  return rule;
}

coupling::Proliferation make_proliferation(const Scene& scene, const ProliferationBlock& b) {
  coupling::Proliferation p = b;
  if (p.thickness == 0) p.thickness = 2 * scene.cell_types.begin()->second.radius;
  if (scene.lobule) p.start_edge = scene.lobule->lesion_radius;
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
  for (const auto& [name, type] : scene.cell_types) p.life.type.push_back(type.cycle);
  for (const LifeRuleBlock& r : scene.life.rules) p.life.rule.push_back(make_rule(scene, r));
  std::size_t k = 0;
  for (const auto& [name, type] : scene.cell_types) {
    coupling::DeathParams& death = p.life.type[k].death;
    if (death.lysis && type.softening < 1) {
      death.type = static_cast<int>(p.dcm.size());
      const CellType soft = softened(type);
      cbm::Params sphere = p.cbm[k];  // its modulus may be that of a law
      sphere.adhesion = soft.adhesion;
      p.dcm.push_back(make_dcm_params(scene, soft));
      p.cbm.push_back(sphere);
      p.life.type.push_back({});
      type_names.push_back(name + " (dissolving)");
    }
    ++k;
  }
}

}  // namespace acinus::runs
