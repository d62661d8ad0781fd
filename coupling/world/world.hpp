#pragma once
/// Hybrid world: cells of both models, their boundary, and the constants of a run.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cbm/contact.hpp"
#include "cbm/params.hpp"
#include "cbm/state.hpp"
#include "contact/boundary.hpp"
#include "core/parallel/paged_values.hpp"
#include "core/parallel/ranks.hpp"
#include "core/parallel/row_vector.hpp"
#include "coupling/apparatus/apparatus.hpp"
#include "coupling/interface/interface.hpp"
#include "coupling/vessels/vessel_tree.hpp"
#include "coupling/world/cycle.hpp"
#include "coupling/world/fading_force.hpp"
#include "coupling/world/signal.hpp"
#include "coupling/world/substance.hpp"
#include "coupling/world/zoom.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/cg.hpp"

namespace acinus::coupling {

/// Phase of a run: start-up brings small seeds to size and rest and ends at t = 0.
enum class Phase : std::int64_t { kGrow, kAdhere, kSettle, kRun };

struct StartUp {
  bool enabled = false;
  double growth_time = 3600;                ///< s
  double adhesion_ramp = 900;               ///< s
  double max_settle = 3 * 3600;             ///< s
  double speed_tolerance = 0.01 / 60;       ///< um/s
  double pressure_tolerance = 0.01 / 3600;  ///< 1/s, relative
};

/// Rules for the choice of leaders (migration/leaders.hpp).
enum class Leaders {
  kForemost,  ///< cells without another nearer the vein within one diameter in arc and height
  kFront,     ///< cells with an unobstructed straight path to the vein
  kBorder,    ///< cells with an unobstructed path into the lesion within 45 degrees of the vein
  kSector,    ///< nearest cell of every sector of the circle and slice of height
  kNearest    ///< cells nearest the vein
};

struct Motility {
  std::uint64_t seed = 1;
  bool random = true;
  bool in_plane = false;     ///< the random force is horizontal: cells crawl on a substrate
  double grid = 60;          ///< s, time grid of the random force
  double leader_force = 0;   ///< nN toward the vein axis
  double leader_grid = 600;  ///< s
  Leaders leaders = Leaders::kForemost;
  int leader_count = 24;           ///< kNearest: cells; kSector: sectors of the whole circle
  double leader_slice = 24;        ///< um, kSector: height of a slice
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical through this point
  double axis_radius = 0;          ///< um, radius of the vein; leaders stop at its wall
};

/// Exclusion of cells in balance from the step (sleep/sleep.hpp).
struct Sleep {
  bool enabled = false;
  double grid = 600;       ///< s between updates
  double traction = 1e-3;  ///< kPa, residual force per area below which a cell falls asleep
};

enum class Integrator { kLinearlyImplicit, kExplicitEuler, kNewton };

struct Numerics {
  double max_step = 60, min_step = 1e-5;  ///< s
  bool adaptive = true;
  double tolerance = 0.01;  ///< um, error per step
  double max_move = 0.3;    ///< displacement cap in mean edge lengths, 0 = none
  solve::CgOptions cg;
  Integrator integrator = Integrator::kLinearlyImplicit;
  /// Linearisation at the positions extrapolated with the velocity of the last step, instead of the
  /// present ones; linearly implicit steps only.
  bool extrapolate = false;
};

/// Constants of a run.
struct Params {
  std::vector<dcm::Params> dcm;
  std::vector<cbm::Params> cbm;
  dcm::ContactParams dcm_contact;
  cbm::ContactParams cbm_contact;
  InterfaceParams interface;
  StartUp start_up;
  Motility motility;
  LifeParams life;
  Sleep sleep;
  ZoomParams zoom;
  Numerics numerics;
  contact::Boundary boundary;  ///< vessels with a tree follow it
  VesselTree tree;
  Apparatus apparatus;
  SubstanceParams substances;
  RuleParams rules;
};

/// Pending events after the last step. A step and its events are one, unless the process is asked
/// to stop during divisions, a step of sleepers, changes of model, or settling of new meshes.
enum class EventsDue : std::uint8_t { kNone, kAll, kMeshes, kSleep, kZoom };

struct Clock {
  double time = 0;    ///< s since the beginning of start-up
  double origin = 0;  ///< s, time of t = 0; meaningful in Phase::kRun
  Phase phase = Phase::kRun;
  double phase_start = 0;  ///< s
  double step = 0;         ///< s, length of the next step
  double last_step = 0;    ///< s, length of the last accepted step; 0 = none
  std::int64_t accepted = 0, rejected = 0, cg_iterations = 0;
  /// Accepted steps that are part of a computed one (step/shorten.hpp) or had late cells
  /// (step/late_cells.hpp).
  std::int64_t shortened = 0;
  bool coarse = false;      ///< true: coarse space of the solver is on, by the effort of solves
  std::int64_t solves = 0;  ///< linear systems of accepted and rejected steps
  std::int64_t longest_solve = 0;  ///< iterations, of the last step
  EventsDue due = EventsDue::kNone;
};

/// Time of walls at a clock time, s: they start to move at t = 0.
inline double wall_time(const Clock& clock, double time) {
  return clock.phase == Phase::kRun ? time - clock.origin : 0;
}

/// Largest imbalance |sum| / sum |.| over all steps.
struct Balance {
  double momentum = 0;  ///< of all pair forces, friction included; over all forces
  double torque = 0;    ///< conservative pair forces
  double friction_torque =
      0;  ///< pair friction and changes of pair forces in a step, which need not balance
};

/// Part of the state that a step reads: all but the displacements of the last step.
struct PresentState {
  dcm::State dcm;
  cbm::State cbm;
  TreeState tree;
  Clock clock;
  Balance balance;
  std::vector<std::uint8_t> leader;   ///< [dcm lanes, then cbm cells]
  std::int64_t leader_interval = -1;  ///< grid interval of the last choice of leaders
  std::vector<std::uint8_t> asleep;   ///< [dcm lanes, then cbm cells] 1: sleeps; empty: none
  std::int64_t sleep_interval = -1;   ///< grid interval of the last update of sleep
  HeldRows<Cycle> cycle;              ///< [dcm lanes, then cbm cells]; empty: nothing grows
  std::int64_t life_interval = -1;    ///< grid interval of the last update of the rules of life
  std::int64_t next_lineage = 0;      ///< lineage of the next daughter
  std::int64_t divisions = 0, deaths = 0;
  /// [dcm lanes, then cbm cells] s, clock time of the last change of model; empty: none has changed
  std::vector<double> model_since;
  std::vector<FadingForce> fading;
  std::vector<double> settle_pressure;    ///< kPa per cell at the last check of the settling phase
  double settle_time = -1;                ///< s, time of that check
  std::vector<SubstanceState> substance;  ///< empty: none
  SignalState signal;
  /// [dcm lanes, then cbm cells] written before each step; empty: no rule acts on motion
  std::vector<Guidance> guidance;
  /// [dcm lanes, then cbm cells] factor on the adhesion energy of a cell, written before each step
  /// and constant in it; that of a pair is the geometric mean. Empty: all 1
  std::vector<double> adhesion;
  /// Set of near cells on all processes: a process has the points, and of spheres volume, strength,
  /// modulus and cycle, of its own cells and of near ones only. 0: every process has those of all,
  /// as in a checkpoint. kOwnPoints: of its own cells only. See step/near_cells.hpp
  std::int64_t near_set = 0;
  /// [near cell] lanes of all rows of cells, ascending
  std::vector<std::size_t> near;
};

/// State of the world: exactly the contents of a checkpoint.
struct State : PresentState {
  HeldRows<double> last_move;  ///< [n_row][3][lane] um, displacement of the last step
  /// [lanes of all rows of cells] process that has the last move of a cell and the numbers of its
  /// shape of birth, kEverywhere: all have them; empty: all have all. See step/held_cells.hpp
  PagedValues<int> cell_holder;
  /// [cbm cells] process that has the contacts of a sphere in cbm.touching, kEverywhere: all have
  /// them; empty: all are everywhere, as in a checkpoint. See step/held_contacts.hpp
  PagedValues<int> holder;
};

inline constexpr int kEverywhere = -1;  ///< holder of what every process has
/// State::near_set after cells or owners have changed, until near cells are found.
inline constexpr std::int64_t kOwnPoints = -1;

/// Number of cells of both models.
int count_cells(const State& state);

/// Number of cells asleep.
int count_asleep(const State& state);

/// Vessels at rest, constant in a run.
inline const geometry::Network& vessels_at_rest(const Params& p) {
  return p.tree.exists() ? p.tree.rest : p.boundary.vessels.network;
}

/// Number of coordinates of all unknowns.
inline std::size_t count_unknowns(const State& s) {
  return s.dcm.position.size() + s.cbm.position.size() + s.tree.n_row() * kPointStride;
}

/// True if `last_move` belongs to the present rows; false before the first step.
inline bool has_last_move(const State& s) {
  return s.clock.last_step > 0 && s.last_move.size() == count_unknowns(s);
}

/// Partition of the work of a step among processes (sharing.hpp).
enum class Sharing {
  kBalanced,
  kRandom  ///< random owners even of few blocks, to test that no result depends on ownership
};

struct World {
  Params params;
  State state;
  Ranks ranks = Ranks::serial();
  Sharing sharing = Sharing::kBalanced;
};

/// Time since t = 0, s; during start-up minus the longest time left to its end.
double time_since_start(const World& world);

/// Factors on adhesion, cell-cell friction and motility in the present phase.
struct Controls {
  double adhesion = 1, friction = 1;
  bool motility = true;
};
Controls controls_at(const Clock& clock, const StartUp& start_up);

/// First row of the spheres.
inline std::size_t cbm_first_row(const State& s) { return s.dcm.n_row(); }
/// First row of the vessel tree; kAtRest without one.
inline std::size_t tree_first_row(const State& s) {
  return s.tree.node.empty() ? contact::kAtRest : s.dcm.n_row() + s.cbm.n_row();
}

/// [dcm lanes, then cbm cells, then the tree] 1 for occupied lanes. All lanes of sphere rows and of
/// the block of the tree count, as the solver requires.
std::vector<std::uint8_t> active_lanes(const State& state);

/// Positions of all unknowns in one array, [n_row][3][lane].
std::vector<double> gather_positions(const State& state);
void gather_positions(const State& state, RowVector<double>& out);

/// Coordinates of a point, kLanes apart.
double* position_of(State& state, Address point);
const double* position_of(const State& state, Address point);

/// Hash of the whole state in storage order; equal bits give equal hashes. Of a state with holders:
/// state_parts.hpp.
std::uint64_t hash_state(const State& state);

/// Name for messages: "DCM cell 12" of a lane, "CBM cell 40" of a sphere.
std::string name_dcm(const State& state, std::size_t lane);
std::string name_cbm(const State& state, std::size_t cell);
/// Name of a lane of active_lanes, for messages.
std::string name_body(const State& state, std::size_t lane);

}  // namespace acinus::coupling
