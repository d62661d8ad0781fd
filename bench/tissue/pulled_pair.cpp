#include "bench/tissue/pulled_pair.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "coupling/measure/adhesion.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/node_measures.hpp"
#include "coupling/simulation.hpp"
#include "dcm/contact/contact_params.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/pull_off_experiment.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::bench {
namespace {

constexpr double kRestSpeed = 2e-4;      ///< speed of a node at rest, um/s
constexpr double kFirstIncrement = 0.2;  ///< first force increment, in pi W R^
constexpr int kMostHalvings = 5;         ///< of the increment after separation
constexpr double kMostForce = 40;        ///< force beyond any pull-off, in pi W R^

runs::Scene make_scene(const PairCase& c) {
  runs::Scene scene = runs::read_scene(runs::scene_folder() + "/adhering_pair.json");
  scene.seed = c.seed;
  scene.numerics.max_step = c.step;
  scene.contact.quadrature = c.quadrature;
  scene.contact.law = c.law;
  scene.contact.cohesive_range = c.h0;
  scene.contact.cell_friction = c.friction;
  runs::CellType& type = scene.cell_types.begin()->second;
  type.adhesion = c.adhesion;
  type.dcm.nodes = c.nodes;
  return scene;
}

coupling::World make_world(const PairCase& c) {
  coupling::World world = runs::build_world(make_scene(c), Ranks::serial()).world;
  for (dcm::Params& p : world.params.dcm) {
    p.bending_stiffness *= c.bending;
    p.spring_stiffness *= c.stretching;
    p.area_modulus *= c.stretching;
  }
  if (c.range > 0) {
    const double edge = world.state.dcm.group[0].topology->mean_rest_length *
                        dcm::reference_radii(world.state.dcm, 0)[0];
    world.params.dcm_contact.range_factor = c.range / edge;
  }
  return world;
}

class PulledPair {
 public:
  explicit PulledPair(const PairCase& c) : hold_(c.hold), simulation_(make_world(c)) {}

  /// Holds a force (nN) until the pair is at rest, or for the longest hold time.
  /// @return true if the pair still adheres
  bool hold(double force) {
    dcm::State& cells = state().dcm;
    const Vec3 along = (center(1) - center(0)).normalized();
    cells.pull[kLane[0]] = -force * along;
    cells.pull[kLane[1]] = force * along;
    state().clock.last_step = 0;  // the last move says nothing about the next
    coupling::Observer watch;
    watch.events_over = [this] { return adheres() && !is_still(); };
    const coupling::LoopResult result = simulation_.run_until(simulation_.time() + hold_, watch);
    check(!result.last.interrupted, "bench pull-off: stopped", Exit::kStopped);
    check(result.ok, "bench pull-off: a step failed: " + result.last.cause, Exit::kCannotContinue);
    return adheres();
  }

  PairRest measure() {
    coupling::observe(simulation_.world(), simulation_.work());
    const auto adhesion = coupling::measure_adhesion(simulation_.world(), simulation_.work());
    const auto nodes = coupling::measure_nodes(simulation_.world(), simulation_.work());
    const auto cells = coupling::measure_cells(simulation_.world(), simulation_.work());
    const auto tension = coupling::compute_contact_tensions(nodes.tension, adhesion);
    return {adhesion.area,
            (center(1) - center(0)).norm(),
            0.5 * (cells[0].cytosol_pressure + cells[1].cytosol_pressure),
            0.5 * (cells[0].contact_area + cells[1].contact_area),
            tension.outside,
            tension.least};
  }

  /// Attraction of the cells with their centres at +-x (um), nN.
  double attraction_at(double x) {
    for (const int k : {0, 1}) {
      const Vec3 shift = Vec3((k == 0 ? -1 : 1) * x, 0, 0) - center(k);
      dcm::State& cells = state().dcm;
      for (int i = 0; i < cells.group[0].topology->n_node; ++i)
        add_point(cells.position.data(), dcm::node_address(cells, kLane[k], i), shift);
    }
    coupling::observe(simulation_.world(), simulation_.work());
    const auto nodes = coupling::measure_nodes(simulation_.world(), simulation_.work());
    double sum = 0;
    for (std::size_t i = 0; i < nodes.force.size() / 2; ++i) sum += nodes.force[i].x();
    return sum;
  }

  bool is_still() {
    double largest = 0;
    for (const double x : state().last_move) largest = std::max(largest, std::abs(x));
    return largest < kRestSpeed * state().clock.last_step;
  }

  coupling::World& world() { return simulation_.world(); }
  coupling::State& state() { return simulation_.world().state; }
  void restore(const coupling::State& saved) {
    state() = saved;
    simulation_.resize();
  }

 private:
  /// Lanes of the two cells, which share type and mesh, in the order of the list.
  static constexpr std::array<std::size_t, 2> kLane{0, 1};

  Vec3 center(int cell) { return dcm::cell_center(state().dcm, kLane[cell]); }
  bool adheres() const { return coupling::any_adhesion(simulation_.world(), simulation_.work()); }

  double hold_;
  coupling::Simulation simulation_;
};

}  // namespace

double vesicle_force(const PairCase& c) {
  return runs::vesicle_pull_off(runs::pair_of(make_scene(c)));
}

PullOff measure_pull_off(const PairCase& c) {
  PulledPair pair(c);
  PullOff result;
  result.adhered = pair.hold(0);
  if (!result.adhered) return result;
  result.start = result.last = pair.measure();
  const double unit = vesicle_force(c);
  coupling::State borne = pair.state();
  double rise = kFirstIncrement * unit;
  for (int halvings = 0; halvings <= kMostHalvings;) {
    const double force = result.kept + rise;
    check(force < kMostForce * unit, "bench pull-off: the cells do not let go",
          Exit::kCannotContinue);
    const bool is_borne = pair.hold(force);
    if (is_borne) {
      borne = pair.state();
      result.kept = force;
      result.last = pair.measure();
    } else {
      result.lost = force;
      pair.restore(borne);
    }
    if (is_borne && halvings == 0) continue;  // not lost yet
    rise *= 0.5;
    ++halvings;
  }
  return result;
}

HeldPair hold_pair(const PairCase& c, double force, bool after_cohesive) {
  PulledPair pair(c);
  if (after_cohesive) {
    pair.world().params.dcm_contact.law = dcm::ContactLaw::kCohesive;
    check(pair.hold(0), "bench contact-laws: the cells do not adhere", Exit::kCannotContinue);
    pair.world().params.dcm_contact.law = c.law;
  }
  HeldPair result;
  const coupling::Clock before = pair.state().clock;
  check(pair.hold(0), "bench contact-laws: the cells let go", Exit::kCannotContinue);
  result.is_still = pair.is_still();
  result.free = pair.measure();
  result.steps = pair.state().clock.accepted - before.accepted;
  result.rejected = pair.state().clock.rejected - before.rejected;
  result.is_borne = pair.hold(force);
  result.held = pair.measure();
  return result;
}

double compute_rigid_pull_off(const PairCase& c) {
  PulledPair pair(c);
  const double radius = make_scene(c).cell_types.begin()->second.radius;
  double largest = 0, place = radius;
  const auto look = [&](double x) {
    if (const double f = pair.attraction_at(x); f > largest) largest = f, place = x;
  };
  // The top is sharp on the side where the first points begin to press.
  for (int k = 0; k <= 40; ++k) look(radius * (0.985 + 0.001 * k));
  const double about = place;
  for (int k = -9; k <= 9; ++k) look(about + 1e-4 * radius * k);
  return largest;
}

double compute_rigid_push(const PairCase& c, double distance) {
  return -PulledPair(c).attraction_at(0.5 * distance);
}

}  // namespace acinus::bench
