#include "bench/work_precision/work_precision_scenes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bench/step/packed_clump.hpp"
#include "runs/scene/scene.hpp"

namespace acinus::bench {
namespace {

using coupling::Integrator;

const Discretisation kUsual{};  ///< defaults of a scene
const Discretisation kNodes{162, "nodes"};
const Discretisation kNodesAndEdges{162, "nodes-and-edges"};

std::string clump_text(int count, const Discretisation& space) {
  return packed_clump_text(
      {.count = count, .nodes = space.nodes, .quadrature = space.quadrature, .step = {}});
}

/// Stretches the first cell by a tenth along the axis at constant volume.
void stretch_first(coupling::World& world, const Vec3& axis) {
  constexpr double kStretch = 1.1;
  dcm::State& s = world.state.dcm;
  const Vec3 center = dcm::cell_center(s, 0);
  for (int i = 0; i < s.group.front().topology->n_node; ++i) {
    const Address a = dcm::node_address(s, 0, i);
    const Vec3 arm = load_point(s.position.data(), a) - center;
    const Vec3 along = axis.dot(arm) * axis;
    store_point(s.position.data(), a,
                center + kStretch * along + (arm - along) / std::sqrt(kStretch));
  }
  world.state.clock.last_step = 0;  // what the cell did before says nothing about what comes
}

void add_steps(std::vector<PrecisionSetting>& list, const Discretisation& space,
               Integrator integrator, const std::vector<double>& steps,
               double cg_tolerance = solve::CgOptions{}.tolerance) {
  for (const double h : steps) list.push_back({space, integrator, h, cg_tolerance});
}
void add_tolerances(std::vector<PrecisionSetting>& list, const Discretisation& space, double step,
                    const std::vector<double>& tolerances) {
  for (const double t : tolerances) list.push_back({space, Integrator::kLinearlyImplicit, step, t});
}
PrecisionSetting usual_control(const Discretisation& space) {
  return {.space = space, .step = coupling::Numerics{}.max_step, .adaptive = true};
}

/// Study of meshes and quadratures with the same numerics, against the finest mesh.
PrecisionStudy space_study(double window, int samples, double step, int finest,
                           const std::vector<int>& meshes) {
  PrecisionStudy s{"error of mesh and quadrature", window, samples, {{finest, "3-point"}}, {}};
  s.reference.step = step;
  for (const char* quadrature : {"nodes", "3-point"})
    for (const int nodes : meshes)
      if (Discretisation d{nodes, quadrature}; d != s.reference.space)
        s.setting.push_back({.space = d, .step = step});
  return s;
}

}  // namespace

WorkCase stretch_case() {
  const Vec3 axis = Vec3::UnitZ();
  WorkCase c;
  c.scene = {.name = "stretch",
             .title = "one stretched cell in a liquid, released",
             .text =
                 [](const Discretisation& d) {
                   return fmt::format(
                       R"({{"name": "stretch", "time": {{"end": "1 h"}},
  "cell_types": {{"cell": {{"dcm": {{"nodes": {}}}}}}},
  "cells": {{"source": "list", "model": "dcm",
             "list": [{{"position": ["0 um", "0 um", "0 um"]}}]}},
  "friction": {{"medium": "liquid"}},
  "motility": {{"random": false}}, "contact": {{"quadrature": "{}"}}}})",
                       d.nodes, d.quadrature);
                 },
             .warm_up = 60,
             .warm_up_step = 1,
             .begin = [axis](coupling::World& w) { stretch_first(w, axis); },
             .axis = axis};
  PrecisionStudy s{
      "error of time stepping", 4, 4, {kUsual, Integrator::kLinearlyImplicit, 0.00025, 1e-7}, {}};
  add_steps(s.setting, kUsual, Integrator::kLinearlyImplicit,
            {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1});
  add_tolerances(s.setting, kUsual, 0.02, {1e-2, 1e-3, 1e-4, 1e-5});
  add_steps(s.setting, kUsual, Integrator::kExplicitEuler, {0.0025, 0.005, 0.008, 0.01});
  add_steps(s.setting, kUsual, Integrator::kNewton, {0.02, 0.1, 0.5});
  for (const double tolerance : {0.01, 0.001}) {
    s.setting.push_back(usual_control(kUsual));
    s.setting.back().tolerance = tolerance;
  }
  c.time = {s};
  c.space = {space_study(4, 4, 0.02, 2562, {42, 162, 642})};
  // Nothing touches: the quadrature has nothing to do.
  std::erase_if(c.space.front().setting,
                [](const PrecisionSetting& t) { return t.space.quadrature == "nodes"; });
  return c;
}

WorkCase clump_case() {
  WorkCase c;
  c.scene = {.name = "clump",
             .title = "13 packed growing cells",
             .text = [](const Discretisation& d) { return clump_text(13, d); },
             .prepare = grow,
             .warm_up = 3600,
             .warm_up_step = 10};
  constexpr double kHours = 6, kWindow = kHours * 3600;
  for (const Discretisation& d : {kUsual, kNodes}) {
    PrecisionStudy s{"error of time stepping, " + d.quadrature,
                     kWindow,
                     6,
                     {d, Integrator::kLinearlyImplicit, 3.75, 1e-5},
                     {}};
    add_steps(s.setting, d, Integrator::kLinearlyImplicit, {15, 30, 60, 120, 300, 600, 1200});
    add_tolerances(s.setting, d, 120, {1e-2, 1e-3, 1e-4, 1e-5});
    if (d == kUsual) {
      add_tolerances(s.setting, d, 30, {1e-2, 1e-3, 1e-4});
      add_steps(s.setting, d, Integrator::kNewton, {120, 600});
    }
    s.setting.push_back(usual_control(d));
    c.time.push_back(s);
  }
  PrecisionStudy brief{"error of time stepping over ten minutes",
                       600,
                       1,
                       {kUsual, Integrator::kLinearlyImplicit, 0.25, 1e-5},
                       {}};
  // A loose friction solve damps the fastest modes and so lengthens the stable step: both count.
  add_steps(brief.setting, kUsual, Integrator::kExplicitEuler, {0.1, 0.25, 0.5, 1, 2});
  add_steps(brief.setting, kUsual, Integrator::kExplicitEuler, {0.1, 0.25, 0.5}, 1e-3);
  add_steps(brief.setting, kUsual, Integrator::kLinearlyImplicit, {30, 60, 120, 300, 600});
  c.time.push_back(brief);
  c.space = {space_study(kWindow, 6, 60, 642, {42, 162, 642})};
  return c;
}

WorkCase packed_case() {
  WorkCase c;
  c.scene = {.name = "packed",
             .title = "27 packed growing cells",
             .text = [](const Discretisation& d) { return clump_text(27, d); },
             .prepare = grow,
             .warm_up = 3600,
             .warm_up_step = 7.5};
  for (const Discretisation& d : {kUsual, kNodes}) {
    PrecisionStudy s{"120 s against 7.5 s, " + d.quadrature,
                     6 * 3600,
                     6,
                     {d, Integrator::kLinearlyImplicit, 7.5, 1e-5},
                     {}};
    add_steps(s.setting, d, Integrator::kLinearlyImplicit, {60, 120, 300});
    add_tolerances(s.setting, d, 120, {1e-2, 1e-3, 1e-4});
    c.time.push_back(s);
  }
  return c;
}

WorkCase growth_case(int cells) {
  WorkCase c;
  c.scene = {.name = fmt::format("growth{}", cells),
             .title = fmt::format("a spheroid that grows by division, from {} cells on", cells),
             .text =
                 [](const Discretisation& d) {
                   return fmt::format(
                       R"({{"name": "growth", "time": {{"end": "30 days"}},
  "cell_types": {{"cell": {{"dcm": {{"nodes": {}}}, "adhesion": "1e-5 J/m^2",
                           "cycle": {{"time": "24 h", "start": "birth"}}}}}},
  "cells": {{"source": "list", "model": "dcm", "list": [{{"position": ["0 um", "0 um", "0 um"]}}]}},
  "motility": {{"random": true, "grid": "10 min"}}, "contact": {{"quadrature": "{}"}}}})",
                       d.nodes, d.quadrature);
                 },
             .warm_up = 600,
             .warm_up_step = 120,
             .grow_to = cells};
  for (const Discretisation& d : {kNodesAndEdges, kNodes}) {
    PrecisionStudy s{"error of time stepping, " + d.quadrature,
                     2 * 3600,
                     4,
                     {.space = d, .step = 15, .cg_tolerance = 1e-4, .extrapolate = true},
                     {}};
    for (const bool extrapolate : {false, true})
      for (const double step : {30.0, 60.0, 120.0})
        s.setting.push_back({.space = d,
                             .step = step,
                             .cg_tolerance = 5e-2,
                             .adaptive = true,
                             .tolerance = 0.1,
                             .extrapolate = extrapolate});
    s.setting.push_back(s.setting[4]);
    s.setting.back().cg_tolerance = 2e-2;
    c.time.push_back(s);
  }
  return c;
}

WorkCase capsule_case() {
  WorkCase c;
  c.scene = {
      .name = "capsule",
      .title = "27 cells in a shrinking capsule",
      .text =
          [](const Discretisation& d) {
            return fmt::format(
                R"({{"name": "capsule", "time": {{"end": "12 h"}},
  "cell_types": {{"cell": {{"dcm": {{"nodes": {}}}}}}},
  "cells": {{"source": "clump", "lattice": "bcc", "model": "dcm", "count": 27,
             "spacing": 0.93, "jitter": 0.01}},
  "capsule": {{"radius": "49 um"}},
  "motility": {{"random": false}}, "contact": {{"quadrature": "{}"}}}})",
                d.nodes, d.quadrature);
          },
      .warm_up = 1800,
      .warm_up_step = 15,
      .begin = [](coupling::World& w) { w.params.boundary.capsules.front().speed = 4.5 / 3600; }};
  constexpr double kWindow = 2 * 3600;
  for (const Discretisation& d : {kUsual, kNodes}) {
    PrecisionStudy s{"error of time stepping, " + d.quadrature,
                     kWindow,
                     4,
                     {d, Integrator::kLinearlyImplicit, 7.5, 1e-4},
                     {}};
    add_steps(s.setting, d, Integrator::kLinearlyImplicit, {30, 60, 120, 300, 600});
    if (d == kUsual) {
      add_tolerances(s.setting, d, 60, {1e-2, 1e-3, 1e-4, 1e-5});
      add_steps(s.setting, d, Integrator::kNewton, {300});
    }
    s.setting.push_back(usual_control(d));
    c.time.push_back(s);
  }
  return c;
}

WorkCase cbm_case() {
  WorkCase c;
  c.scene = {.name = "cbm",
             .title = "1000 spheres with random motility",
             .text =
                 [](const Discretisation&) {
                   return std::string(
                       R"({"name": "cbm", "time": {"end": "12 h"}, "cell_types": {"cell": {}},
  "cells": {"source": "clump", "model": "cbm", "count": 1000, "spacing": 0.95, "jitter": 0.01},
  "motility": {"random": true, "grid": "60 s"}})");
                 },
             .warm_up = 1800,
             .warm_up_step = 15,
             .deformable = false};
  PrecisionStudy s{
      "error of time stepping", 2 * 3600, 4, {kUsual, Integrator::kExplicitEuler, 0.5, 1e-6}, {}};
  add_steps(s.setting, kUsual, Integrator::kLinearlyImplicit,
            {7.5, 15, 30, 60, 120, 300, 600, 1800});
  add_tolerances(s.setting, kUsual, 60, {1e-2, 1e-3, 1e-4, 1e-5});
  add_steps(s.setting, kUsual, Integrator::kExplicitEuler, {3.75, 7.5, 15, 30, 60, 120, 300});
  add_steps(s.setting, kUsual, Integrator::kNewton, {60, 300});
  s.setting.push_back(usual_control(kUsual));
  c.time = {s};
  return c;
}

}  // namespace acinus::bench
