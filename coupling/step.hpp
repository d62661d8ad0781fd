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

/// What to assemble.
struct Selection {
  bool interface = true;       ///< tests look at one model with and without it
  double stiffness_scale = 1;  ///< 0: friction only
  double friction_factor = 1;  ///< on Gamma/h
};

/// Stages 1 and 2: reference values at the end of the step, migration choices, contacts of the
/// present positions. State is not touched.
void find_all_contacts(const World& world, double step, Workspace& work);

/// First half of stage 3: both models and the interface add their loads to one system.
void assemble(const World& world, double step, Workspace& work, Selection selection = {});

/// Takes out of the product of the assembled matrix with `move` what the ties of held cells add.
void leave_out_holds(const Workspace& work, std::span<const double> move,
                     std::span<double> product);

/// Forces between deformable cells and spheres, per pair of cells.   @pre assemble
std::vector<InterfaceForce> interface_forces(const World& world, const Workspace& work);

/// Contacts between spheres one by one.   @pre find_all_contacts
std::vector<cbm::SphereContact> sphere_contacts(const World& world, const Workspace& work);

/// Second half of stage 3: the system's own forces as right-hand side, the last step's velocity as
/// first guess, then solve_system.
Status solve_step(const World& world, double step, Workspace& work, int& cg_iterations);

/// The same after the system changed, with the displacement found before as first guess.
Status solve_again(const World& world, Workspace& work, int& cg_iterations);

/// Solves for work.move from the guess it holds and the right-hand side in work.rhs, then puts the
/// rigid motion of every cluster right. Adds to cg_iterations.
Status solve_system(const World& world, Workspace& work, int& cg_iterations);

/// Advances by one accepted step no longer than `limit`, with as many smaller retries as it takes.
/// Sleepers keep their place to the bit (awake.hpp).
/// Not accepted: a step of min_step was still bad; State is the last good one.
StepResult advance(World& world, Workspace& work, double limit);

}  // namespace acinus::coupling
