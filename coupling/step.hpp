#pragma once
/// One step of the hybrid world. The only place that knows the order of the stages.

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/workspace.hpp"
#include "coupling/world.hpp"

namespace acinus::coupling {

/// What came of a step.
struct StepResult {
  bool accepted = false;
  double step = 0;                  ///< s, length of the accepted step
  double error = 0;                 ///< um, its estimated error
  double max_move = 0;              ///< um
  int rejections = 0;               ///< attempts thrown away before it
  std::string cause;                ///< why the last attempt was rejected
  std::vector<std::int64_t> cells;  ///< lineage ids of the cells concerned
};

/// Sizes everything for the present set of cells. Call after the set changed and before the first
/// step.
void size_workspace(const World& world, Workspace& work);

/// Which loads to assemble; tests look at one model with and without the interface.
struct Selection {
  bool interface = true;
};

/// Stages 1 and 2: reference values at the end of the step, migration choices, contacts of the
/// present positions. State is not touched.
void find_all_contacts(const World& world, double step, Workspace& work);

/// First half of stage 3: both models and the interface add their loads to one system.
void assemble(const World& world, double step, Workspace& work, Selection selection = {});

/// Forces between deformable cells and spheres, per pair of cells.   @pre assemble
std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& work);

/// Contacts between spheres one by one.   @pre find_all_contacts
std::vector<cbm::SphereContact> sphere_contacts(const World& world, const Workspace& work);

/// Second half of stage 3: (Gamma/h + K) dx = F, then exact rigid motion of every cluster.
Status solve_step(const World& world, double step, Workspace& work, int& cg_iterations);

/// Advances by one accepted step no longer than `limit`, with as many smaller retries as it takes.
/// Not accepted: a step of min_step was still bad; State is the last good one.
StepResult advance(World& world, Workspace& work, double limit);

}  // namespace acinus::coupling
