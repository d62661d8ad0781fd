#include "bench/tissue/out_of_sample_scenes.hpp"

#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"

namespace acinus::bench {
namespace {

/// Scenes for cells with a radius of 12 um.
constexpr const char* kPlates = R"({
  "experiment": "free", "model": "dcm",
  "time": { "end": "1.4 h", "step": "60 s", "tolerance": "0.05 um", "extrapolate": true },
  "start_up": { "enabled": true },
  "cell_types": { "hepatocyte": {} },
  "cells": { "source": "clump", "count": 27, "lattice": "bcc", "jitter": 0.01 },
  "walls": [
    { "name": "lower", "point": ["0 um", "0 um", "-42 um"], "normal": [0, 0, 1], "mirror": true, "speed": "10 um/h", "travel": "14 um" },
    { "name": "upper", "point": ["0 um", "0 um", "42 um"], "normal": [0, 0, -1], "mirror": true, "speed": "10 um/h", "travel": "14 um" }
  ],
  "motility": { "random": false }, "output": { "every": "6 min" } })";

constexpr const char* kBox = R"({
  "experiment": "free", "model": "dcm",
  "time": { "end": "6 h", "step": "60 s", "tolerance": "0.1 um", "extrapolate": true },
  "start_up": { "enabled": true, "growth_time": "4 h" },
  "cell_types": { "hepatocyte": {} },
  "cells": { "source": "box", "grid": [3, 3, 3], "spacing": 0.88, "jitter": 0.05 },
  "walls": [
    { "name": "x low", "point": ["-31.9 um", "0 um", "0 um"], "normal": [1, 0, 0], "mirror": true },
    { "name": "x high", "point": ["31.9 um", "0 um", "0 um"], "normal": [-1, 0, 0], "mirror": true, "speed": "2 um/h", "travel": "12 um" },
    { "name": "y low", "point": ["0 um", "-31.9 um", "0 um"], "normal": [0, 1, 0], "mirror": true },
    { "name": "y high", "point": ["0 um", "31.9 um", "0 um"], "normal": [0, -1, 0], "mirror": true },
    { "name": "z low", "point": ["0 um", "0 um", "-31.9 um"], "normal": [0, 0, 1], "mirror": true },
    { "name": "z high", "point": ["0 um", "0 um", "31.9 um"], "normal": [0, 0, -1], "mirror": true }
  ],
  "motility": { "random": false }, "output": { "every": "30 min" } })";

constexpr const char* kSlab = R"({
  "experiment": "free", "model": "dcm",
  "time": { "end": "3 h", "step": "60 s", "tolerance": "0.05 um", "extrapolate": true },
  "start_up": { "enabled": true, "growth_time": "2 h" },
  "cell_types": { "hepatocyte": {} },
  "cells": { "source": "list", "list": [ { "position": ["0 um", "0 um", "0 um"] } ] },
  "walls": [
    { "name": "lower", "point": ["0 um", "0 um", "-27 um"], "normal": [0, 0, 1], "mirror": true },
    { "name": "upper", "point": ["0 um", "0 um", "27 um"], "normal": [0, 0, -1], "mirror": true }
  ],
  "motility": { "random": false }, "output": { "every": "15 min" } })";

constexpr const char* kSpheroid = R"({
  "extends": "spheroid.json", "time": { "until_cells": 16 }, "output": { "every": "6 h" } })";

constexpr const char* kMonolayer = R"({
  "extends": "monolayer_type2.json", "time": { "until_cells": 16 }, "output": { "every": "6 h" } })";

constexpr const char* kLobule = R"({
  "extends": "lobule_dcm.json", "time": { "end": "2 h" }, "start_up": { "growth_time": "4 h" },
  "lobule": { "radius": "150 um", "lesion_radius": "80 um", "height": "30 um", "cells": 21 },
  "output": { "every": "30 min" } })";

runs::Scene read(const std::string& name, const char* text) {
  return runs::parse_scene(text, "out_of_sample_" + name + ".json", runs::scene_folder());
}

/// Adds springs that shear three layers of nine cells: they hold the lower layer and drag the upper
/// one, each by half a diameter. Springs are used since no key prescribes cell velocities, and
/// walls move along their normals only.
void shear(runs::Scene& s) {
  constexpr double kSpacing = 21.5, kLayer = 17.2, kMove = 12;  // um
  s.cells.list.clear();
  for (int layer = -1; layer <= 1; ++layer)
    for (int row = -1; row <= 1; ++row)
      for (int column = -1; column <= 1; ++column) {
        runs::CellEntry cell;
        const double aside = layer == 0 ? 0 : 0.5 * kSpacing;
        cell.position = {column * kSpacing + aside, row * kSpacing + aside, layer * kLayer};
        if (layer != 0) {
          runs::PullEntry pull;
          pull.cell = static_cast<int>(s.cells.list.size());
          pull.by = runs::PullBy::kSpring;
          pull.stiffness = 1;                                          // nN/um
          pull.displacement.entry = {{0, 0}, {10800, kMove * layer}};  // within 3 h
          s.pulls.push_back(pull);
        }
        s.cells.list.push_back(cell);
      }
}

void scale_lengths(double factor, runs::Scene& s) {
  for (runs::WallEntry& w : s.walls) {
    w.point *= factor;
    w.speed *= factor;
    w.travel *= factor;
  }
  for (runs::CellEntry& c : s.cells.list) c.position *= factor;
  for (runs::PullEntry& p : s.pulls)
    for (Schedule::Point& d : p.displacement.entry) d.value *= factor;
  if (!s.lobule) return;
  runs::LobuleBlock& l = *s.lobule;
  for (double* length : {&l.radius, &l.height, &l.lesion_radius, &l.central_vein_radius,
                         &l.portal_vein_radius, &l.sinusoid_radius, &l.min_distance})
    *length *= factor;
  l.branch_density /= factor * factor * factor;
}

}  // namespace

runs::CellType out_of_sample_type(const OutOfSampleCells& cells) {
  runs::CellType type =
      runs::read_scene(runs::scene_folder() + "/calibration.json").cell_types.begin()->second;
  type.radius = cells.radius;
  for (double* modulus :
       {&type.dcm.cortex_young, &type.dcm.bulk_modulus, &type.dcm.local_area_modulus})
    *modulus *= cells.stiffness;
  type.cbm.young *= cells.stiffness;
  return type;
}

std::vector<OutOfSampleScene> out_of_sample_scenes(const OutOfSampleCells& cells) {
  std::vector<OutOfSampleScene> all{
      {"plates", read("plates", kPlates)},          {"box", read("box", kBox)},
      {"slab", read("slab", kSlab), false},         {"spheroid", read("spheroid", kSpheroid)},
      {"monolayer", read("monolayer", kMonolayer)}, {"lobule", read("lobule", kLobule)}};
  shear(all[2].scene);
  const runs::CellType type = out_of_sample_type(cells);
  for (OutOfSampleScene& s : all) {
    for (auto& [name, own] : s.scene.cell_types) {
      runs::CellType changed = type;
      changed.cycle = own.cycle;
      changed.diffusion = own.diffusion;
      own = changed;
    }
    scale_lengths(cells.radius / 12, s.scene);
    set_canonical(s.scene);
  }
  return all;
}

}  // namespace acinus::bench
