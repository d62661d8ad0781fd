#pragma once
/// Workspace of the step, sized after each change of the set of cells.

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel/timing.hpp"
#include "coupling/interface/interface.hpp"
#include "coupling/world/cell_forces.hpp"
#include "coupling/world/constraint.hpp"
#include "coupling/world/world.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "dcm/contact/nucleus_contact.hpp"
#include "solve/cg.hpp"
#include "solve/operator.hpp"
#include "solve/rigid.hpp"

namespace acinus::coupling {

/// Measured costs of cells, the weights of the partition.
struct MeasuredCost {
  /// (lineage, s per step) of the cells that were own at the last check, by lineage
  std::vector<std::pair<std::int64_t, double>> of_cell;
  double busy = 0;         ///< s, busy time of this process up to the last check
  std::int64_t steps = 0;  ///< steps accepted since then
};

/// Point of linearisation of a step, as displacements from the present positions; empty: the
/// present positions.
struct LinearisationPoint {
  RowVector<double> move;  ///< [n_row][3][lane] um
  bool moves_all = false;  ///< false: only constrained cells are displaced
  State state;             ///< at the point, if all are displaced; no last move
  /// nN, Gamma/h between cells times `move`; with K if not all are displaced
  RowVector<double> pair_friction;
  bool is_elsewhere() const { return !move.empty(); }
};

struct FloatBox {
  Eigen::Vector3f low, high;  ///< um
};

/// Near cells of other processes (step/near_cells.hpp).
struct NearCells {
  std::int64_t set = 0;       ///< State::near_set of the states that they belong to; 0: none
  double reach = 0;           ///< um, gap within which cells could touch when they were found
  std::vector<FloatBox> box;  ///< of own cells then, in the order of lanes
  std::vector<std::size_t> send, receive;  ///< lanes, those of each process ascending
  ExchangePlan plan;                       ///< of these lanes
};

struct Workspace {
  solve::System system;
  /// Boundary of the step if vessels move; written by: refresh_references
  std::optional<contact::Boundary> boundary;
  std::size_t tree_block = 0;   ///< block of the vessel tree; written by: size_workspace
  std::size_t dcm_lanes = 0;    ///< written by: mark_ghost_cells
  NearCells near;               ///< written by: refresh_near_cells
  std::int64_t near_sets = 0;   ///< found so far
  MeasuredCost cost;            ///< written by: balance_shares
  std::size_t bodies_sent = 0;  ///< with shares others need; written by: exchange_shares
  solve::Operator op;
  solve::CgWorkspace cg;
  solve::RigidWorkspace rigid;
  solve::CoarseSpace coarse;
  dcm::ContactWorkspace dcm;
  dcm::NucleusWorkspace nuclei;
  cbm::ContactWorkspace cbm;
  InterfaceWorkspace interface;   ///< written by: refresh_contacts
  contact::ContactList contacts;  ///< written by: refresh_contacts, completed by: add_loads
  dcm::LaneData lanes;            ///< written by: refresh_references
  /// [cbm cells] um, of own and near ones; written by: refresh_references
  RowVector<double> cbm_radius;
  RowVector<double> cbm_strength;       ///< as cbm_radius; empty: all 1
  RowVector<std::int64_t> cbm_mother;   ///< lineage; as cbm_strength
  std::vector<dcm::Params> dcm_params;  ///< of the step; written by: add_loads
  RowVector<double> medium_area;        ///< [dcm rows][lane]; written by: refresh_migration
  MediumFriction medium_friction;       ///< written by: refresh_migration
  CellForces forces;                    ///< written by: refresh_migration
  /// [n_row][3][lane] um, at the point of linearisation: an array of that state, or `gathered`;
  /// written by: add_loads
  std::span<const double> position;
  RowVector<double> gathered;        ///< positions that are not in one array
  std::vector<std::uint8_t> active;  ///< written by: size_workspace
  Constraint constraint;             ///< set by the owner
  /// [lane of all blocks] 1: late cell, which takes shorter steps of its own in this step
  /// (step/late_cells.hpp); empty: none
  std::vector<std::uint8_t> late;
  RowVector<double> rhs;             ///< written by: solve_step
  RowVector<double> move;            ///< displacement of the step; written by: solve_step
  LinearisationPoint linearisation;  ///< written by: choose_linearisation_point
  int failed_solves = 0;             ///< of this step; written by: take_step, assess_step
  std::vector<std::uint8_t> leader;  ///< written by: refresh_migration
  std::int64_t leader_interval = -1;
  Timings timings;
  bool is_late(std::size_t lane) const { return !late.empty() && late[lane] != 0; }
  std::uint64_t sized = 0;  ///< number of calls of size_workspace: changes with the set of cells
};

/// Calls f(array) for all arrays over rows, in which rows of other processes have no memory but for
/// points in contact with own ones.
template <class F>
void for_each_row_array(Workspace& w, const F& f) {
  solve::for_each_row_array(w.system, f);
  w.op.for_each_row_array(f);
  w.cg.for_each_row_array(f);
  w.coarse.for_each_row_array(f);
  LinearisationPoint& point = w.linearisation;
  for (auto* v : {&point.move, &point.pair_friction}) f(*v);
  for (auto* v : {&w.rigid.mode, &w.medium_area, &w.gathered, &w.rhs, &w.move, &w.cbm.force}) f(*v);
  for (auto* v : {&w.cbm.list_position, &w.cbm.list_radius, &w.cbm.contact_area}) f(*v);
  for (auto* v : {&w.cbm_radius, &w.cbm_strength}) f(*v);
  f(w.cbm_mother);
  f(w.rigid.tie_of_cell);
  f(w.cbm.modulus);
  f(w.forces.cbm);
  f(w.medium_friction.cbm);
}

}  // namespace acinus::coupling
