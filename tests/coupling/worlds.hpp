#pragma once
/// Small hybrid worlds with Table 1 constants, made without a scene.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

#include "coupling/measure/measure.hpp"
#include "coupling/sleep/partial_step.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/world.hpp"
#include "geometry/topology.hpp"

namespace acinus::coupling {

struct TestCell {
  Vec3 center;
  bool deformable = true;
  Vec3 pull = Vec3::Zero();
  double radius = 12;
};

inline World make_test_world(const std::vector<TestCell>& cells, double step = 60,
                             int n_node = 162) {
  World w;
  dcm::Params d = dcm::params_without_terms();
  d.spring_stiffness = dcm::cortex_spring_stiffness(1, 0.5);
  d.bending_stiffness = dcm::cortex_bending_stiffness(1, 0.5, 0.5);
  d.area_modulus = 0.8;
  d.bulk_modulus = 2.5;
  d.nodal_friction = 0.1;
  d.medium_friction = d.vessel_friction = 0.1;
  d.diffusion = 1e-4;
  d.adhesion = 0.01;
  cbm::Params c;
  c.young = 0.45;
  c.young_spread = 0;
  c.medium_friction = c.vessel_friction = 0.5;
  c.diffusion = 1e-4;
  c.adhesion = 0.01;
  c.cell_friction = 10;
  w.params.dcm = {d};
  w.params.cbm = {c};
  w.params.dcm_contact.cell_friction = 50;
  w.params.interface.friction = 2 * 50.0 * 10.0 / 60;
  w.params.motility.random = false;
  w.params.numerics.max_step = step;
  w.params.numerics.adaptive = false;
  w.params.numerics.max_move = 0;
  std::vector<dcm::NewCell> shells;
  std::vector<cbm::NewCell> spheres;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto id = static_cast<std::int64_t>(k);
    // Turned, so that no two meshes mirror each other.
    const Mat3 turn = Eigen::AngleAxisd(0.7 * static_cast<double>(k), Vec3(1, 2, 3).normalized())
                          .toRotationMatrix();
    if (cells[k].deformable)
      shells.push_back({id, 0, &geometry::shared_icosphere(n_node), cells[k].center,
                        cells[k].radius, cells[k].pull, turn});
    else
      spheres.push_back({id, 0, cells[k].center, cells[k].radius, cbm::young_from_bulk(2.5, 0.47),
                         cells[k].pull});
  }
  w.state.dcm = dcm::make_state(shells);
  w.state.cbm = cbm::make_state(spheres);
  return w;
}

/// Gives all deformable cells the nuclei of their types, at rest in their middle.
/// @pre they are round, one group a type
inline void give_nuclei(World& w) {
  std::vector<dcm::NewCell> shells;
  const dcm::State old = w.state.dcm;
  for (std::size_t l = 0; l < old.n_lane(); ++l) {
    if (!old.active(l)) continue;
    const dcm::Group& g = old.group[l / kLanes];
    const auto& nucleus = w.params.dcm[static_cast<std::size_t>(g.type)].nucleus;
    shells.push_back({old.lineage[l], g.type, g.topology, dcm::cell_center(old, l),
                      std::cbrt(3 * old.volume[l].to / (4 * kPi)), old.pull[l], Mat3::Identity(),
                      dcm::nucleus_mesh(nucleus ? &*nucleus : nullptr)});
  }
  w.state.dcm = dcm::make_state(shells);
}

/// Scratch of a world's size.
struct SizedWorkspace : Workspace {
  explicit SizedWorkspace(const World& w) { size_workspace(w, *this); }
};

/// Steps until the time is reached; returns false if a step failed.
inline bool run_until(World& world, Workspace& work, double time) {
  AwakePart awake;
  while (world.state.clock.time < time - 1e-9) {
    const StepResult step = advance(world, work, awake, time - world.state.clock.time);
    if (step.accepted) continue;
    std::printf("step failed: %s\n", step.cause.c_str());
    return false;
  }
  return true;
}

/// World with the forces of its contacts as they are reported, without a step.
struct Observed {
  World world;
  SizedWorkspace work{world};
  explicit Observed(World w) : world(std::move(w)) { observe(world, work); }
};

/// Nodes of the cell, or the centre of a sphere.
inline std::vector<Vec3> nodes_of(const State& s, std::int64_t lineage) {
  std::vector<Vec3> node;
  for_each_cell(s, [&](const Cell& c) {
    if (lineage_of(s, c) != lineage) return;
    if (c.deformable)
      dcm::copy_nodes(s.dcm, c.at, node);
    else
      node = {cbm::center_of(s.cbm, c.at)};
  });
  return node;
}

/// Four of each model in a checkered cube, just touching: every kind of pair occurs.
inline std::vector<TestCell> checkered_cube(double spacing = 24.2) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 8; ++k) {
    const Vec3 x(k & 1, (k >> 1) & 1, (k >> 2) & 1);
    cells.push_back({spacing * x, (((k & 1) + ((k >> 1) & 1) + ((k >> 2) & 1)) % 2) == 0});
  }
  return cells;
}

}  // namespace acinus::coupling
