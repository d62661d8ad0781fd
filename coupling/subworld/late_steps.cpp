#include "coupling/subworld/late_steps.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "coupling/step/ghost_cells.hpp"
#include "coupling/step/held_cells.hpp"
#include "coupling/step/held_contacts.hpp"
#include "coupling/subworld/ring.hpp"
#include "coupling/world/cell.hpp"
#include "coupling/world/state_parts.hpp"
#include "solve/ownership.hpp"

namespace acinus::coupling {
namespace {

/// First step of late cells over that of the whole tissue.
constexpr double kFirstPart = 0.125;

/// Gathers the displacements of some cells on every process, one number after the other.
/// Collective.
std::vector<double> gather_moves(const World& world, const Workspace& w,
                                 std::span<const std::size_t> lanes) {
  const State& s = world.state;
  const auto owner = [&](std::size_t k) { return owner_of_lane(w, lanes[k]); };
  const auto count = [&](std::size_t k) {
    return 3 * static_cast<std::size_t>(points_of(s, lanes[k]));
  };
  std::vector<double> own, all;
  for (std::size_t k = 0; k < lanes.size(); ++k)
    if (w.system.ownership.is_whole() || owner(k) == world.ranks.rank())
      for_each_number_of(s, lanes[k], [&](std::size_t i) { own.push_back(w.move[i]); });
  if (w.system.ownership.is_whole()) return own;
  solve::gather_in_order(world.ranks, lanes.size(), owner, count, own, all);
  return all;
}

/// Gives the cells of a subworld the displacements of a step of the whole world as last moves.
/// @param moves  of the moving, then of the constrained cells
void put_moves(std::span<const double> moves, double step, Subworld& sub) {
  State& s = sub.world.state;
  s.last_move.assign(count_unknowns(s), 0.0);
  s.clock.last_step = step;
  auto next = moves.begin();
  const auto put = [&](std::size_t lane) {
    for_each_number_of(s, lane, [&](std::size_t k) { s.last_move[k] = *next++; });
  };
  for (const std::size_t lane : sub.lane) put(lane);
  for (const std::size_t lane : sub.constrained_lane) put(lane);
  for (std::size_t c = 0; c < s.cbm.n_cell(); ++c) put(cell_index(s, c));
}

/// Late cells of one step and their subworld.
class LateCells {
 public:
  LateCells(World& world, Workspace& work) : world_(world), work_(work) {}

  bool advance(double step, std::span<const std::size_t> lanes) {
    const auto scope = work_.timings.scope("late cells");
    State& s = world_.state;
    complete_contacts(world_.ranks, s);
    bring_points(world_.ranks, lanes, s);
    CellSet late{{lanes.begin(), lanes.end()}, {}}, ring = find_ring(world_, late);
    const std::vector<std::size_t> around = lanes_of(s, ring);
    bring_points(world_.ranks, around, s);
    std::vector<std::size_t> all = late.dcm;
    all.insert(all.end(), around.begin(), around.end());
    complete_shapes(world_.ranks, all, s);
    const std::vector<double> moves = gather_moves(world_, work_, all);

    sub_ = std::make_unique<Subworld>();
    take_params(world_, *sub_);
    sub_->work.constraint.prescribed_velocity = true;
    take_cells(s, std::move(late), std::move(ring), *sub_);
    put_moves(moves, step, *sub_);
    sub_->world.state.clock.step = kFirstPart * step;
    step_ = step;
    const bool ok = relax(*sub_, step).ok;
    hand_over_contacts(world_.ranks, work_, s);
    return ok;
  }

  void write() {
    State& s = world_.state;
    write_positions(*sub_, s);
    write_last_moves(*sub_, step_ / sub_->world.state.clock.last_step, s);
  }

 private:
  World& world_;
  Workspace& work_;
  std::unique_ptr<Subworld> sub_;
  double step_ = 0;  ///< s
};

}  // namespace

LateSteps late_steps(World& world, Workspace& work) {
  const auto cells = std::make_shared<LateCells>(world, work);
  return {[cells](double step, std::span<const std::size_t> lanes) {
            return cells->advance(step, lanes);
          },
          [cells] { cells->write(); }};
}

}  // namespace acinus::coupling
