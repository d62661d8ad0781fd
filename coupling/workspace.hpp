#pragma once
/// Scratch of the step, sized when the set of cells changes.

#include <memory>
#include <vector>

#include "core/solve/cg.hpp"
#include "core/solve/operator.hpp"
#include "core/solve/rigid.hpp"
#include "core/timing.hpp"
#include "coupling/migration.hpp"
#include "coupling/world.hpp"

namespace acinus::coupling {

struct StageScratch;
struct AwakePart;

/// Where a step was linearised, as displacements from the present positions; empty: there.
struct Ahead {
  std::vector<double> move;           ///< [n_row][3][lane] um
  std::vector<double> friction;       ///< Gamma/h times it, nN
  std::vector<double> product;        ///< Gamma/h + K times it, nN
  std::vector<double> pair_friction;  ///< of that what cells exert on each other
  bool used() const { return !move.empty(); }
};

struct Workspace {
  solve::System system;
  solve::Operator op;
  solve::CgWorkspace cg;
  solve::RigidWorkspace rigid;
  solve::CoarseSpace coarse;
  dcm::ContactWorkspace dcm;
  cbm::ContactWorkspace cbm;
  InterfaceWorkspace interface;
  dcm::LaneData lanes;                         ///< written by: find_all_contacts
  std::vector<double> cbm_radius;              ///< written by: find_all_contacts
  std::vector<double> cbm_strength;            ///< empty: all 1; written by: find_all_contacts
  std::vector<std::int64_t> cbm_mother;        ///< lineage; empty with cbm_strength; by the same
  std::vector<double> medium_area;             ///< [dcm rows][lane]; written by: assemble
  std::vector<double> dcm_medium, cbm_medium;  ///< nN s/um per cell; written by: assemble
  CellForces forces;                           ///< written by: assemble
  std::vector<double> position;                ///< [n_row][3][lane]; written by: assemble
  std::vector<std::uint8_t> active;            ///< written by: size_workspace
  /// [dcm lanes, then cbm lanes] 1: the solver does not move it; empty: all move.
  std::vector<std::uint8_t> held;    ///< written by: find_all_contacts
  std::vector<double> rhs;           ///< written by: solve_step
  std::vector<double> move;          ///< displacement of the step; written by: solve_step
  std::vector<double> way;           ///< scratch of solve_step
  Ahead ahead;                       ///< written by: attempt_step
  std::vector<std::uint8_t> leader;  ///< choice for this step; written by: choose stage
  std::int64_t leader_interval = -1;
  bool holds = false;   ///< sleepers take part in the steps made here, held in place
  bool glides = false;  ///< what is held goes on at the pace of its last move (linearly implicit)
  /// Where a world with sleepers steps; see awake.hpp.
  std::shared_ptr<AwakePart> awake, sleepers;
  Timings timings;
  std::shared_ptr<StageScratch> stages;  ///< of methods with more than one stage
  int reject_every = 0;                  ///< tests: throw away every n-th attempt, as if judged bad
  bool partitioned = false;  ///< tests: solve each model alone, interface forces exchanged
};

}  // namespace acinus::coupling
