#pragma once
/// Scratch of the step, sized when the set of cells changes.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/parallel/timing.hpp"
#include "coupling/interface/interface.hpp"
#include "coupling/world/cell_forces.hpp"
#include "coupling/world/constraint.hpp"
#include "coupling/world/sharing.hpp"
#include "coupling/world/world.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/nucleus_contact.hpp"
#include "solve/cg.hpp"
#include "solve/operator.hpp"
#include "solve/rigid.hpp"

namespace acinus::coupling {

/// Linearisation point of a step, as displacements from the present positions; empty: these.
struct LinearisationPoint {
  std::vector<double> move;                        ///< [n_row][3][lane] um
  std::vector<double> friction;                    ///< Gamma/h times it, nN
  std::vector<double> product;                     ///< Gamma/h + K times it, nN
  std::vector<double> pair_friction;               ///< of that what cells exert on each other
  std::vector<double> dcm_position, cbm_position;  ///< um, where all were before
  bool is_ahead() const { return !move.empty(); }
};

struct Workspace {
  solve::System system;
  /// The boundary of the step, where vessels move; written by: find_all_contacts
  std::optional<contact::Boundary> boundary;
  std::size_t dcm_lanes = 0;    ///< written by: find_foreign_cells
  MeasuredCost cost;            ///< written by: balance_shares
  std::size_t bodies_sent = 0;  ///< whose shares others need; written by: exchange_shares
  solve::Operator op;
  solve::CgWorkspace cg;
  solve::RigidWorkspace rigid;
  solve::CoarseSpace coarse;
  dcm::ContactWorkspace dcm;
  dcm::NucleusWorkspace nuclei;
  cbm::ContactWorkspace cbm;
  InterfaceWorkspace interface;          ///< written by: find_all_contacts
  contact::ContactList contacts;         ///< written by: find_all_contacts, completed by: assemble
  dcm::LaneData lanes;                   ///< written by: find_references
  std::vector<double> cbm_radius;        ///< written by: find_references
  std::vector<double> cbm_strength;      ///< empty: all 1; written by: find_references
  std::vector<std::int64_t> cbm_mother;  ///< lineage; empty with cbm_strength; by the same
  std::vector<dcm::Params> dcm_params;   ///< of the step; written by: assemble
  std::size_t first_nucleus_link = 0;    ///< links from there on are of nuclei; by the same
  std::vector<double> medium_area;       ///< [dcm rows][lane]; written by: assemble
  MediumFriction medium_friction;        ///< written by: assemble
  CellForces forces;                     ///< written by: assemble
  std::vector<double> position;          ///< [n_row][3][lane]; written by: assemble
  std::vector<std::uint8_t> active;      ///< written by: size_workspace
  Constraint constraint;                 ///< set by the owner
  std::vector<double> rhs;               ///< written by: solve_step
  std::vector<double> move;              ///< displacement of the step; written by: solve_step
  std::vector<double> rest_of_move;      ///< scratch of solve_step
  LinearisationPoint linearisation;      ///< written by: attempt_step
  int failed_solves = 0;                 ///< attempts at this step; written by: take_step
  std::vector<std::uint8_t> leader;      ///< written by: choose_leaders_of_step
  std::int64_t leader_interval = -1;
  Timings timings;
  std::uint64_t sized = 0;  ///< number of calls of size_workspace: what depends on the set of cells
};

}  // namespace acinus::coupling
