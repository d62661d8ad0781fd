/// Last moves and shapes of birth follow their cells from owner to owner.

#include "coupling/step/held_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "geometry/topology.hpp"

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::coupling {
namespace {

constexpr int kHeldShells = 60, kHeldSpheres = 4000;

/// Cells of both models with random last moves.
World make_held_world() {
  World world;
  world.ranks = Ranks::world();
  State& s = world.state;
  std::vector<dcm::NewCell> shells(kHeldShells);
  for (dcm::NewCell& c : shells) {
    c.topology = &geometry::shared_icosphere(42);
    c.radius = 5;
  }
  s.dcm = dcm::make_state(shells);
  s.cbm = cbm::make_state(std::vector<cbm::NewCell>(kHeldSpheres));
  s.last_move = make_zeros<double>(count_unknowns(s));
  std::mt19937_64 random(3);
  for (double& x : s.last_move) x = std::uniform_real_distribution<double>(-1, 1)(random);
  s.clock.last_step = 60;
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); lane += 3) {
    s.dcm.birth[lane].edge = std::vector<double>(20 + lane, 1 + 0.01 * static_cast<double>(lane));
    s.dcm.birth[lane].triangle = std::vector<double>(10, static_cast<double>(lane));
  }
  return world;
}

/// Blocks with random owners; with one process all are own.
void draw_block_owners(std::uint64_t seed, const World& world, Workspace& w) {
  const auto n = static_cast<unsigned>(world.ranks.size());
  std::mt19937_64 random(seed);
  solve::Blocks blocks = dcm::make_blocks(world.state.dcm, std::vector<dcm::Params>(1));
  cbm::append_blocks(world.state.cbm, blocks);
  w.system.ownership = {};
  if (n > 1) {
    w.system.ownership.ranks = world.ranks;
    for (std::size_t b = 0; b < blocks.size(); ++b)
      w.system.ownership.owner.push_back(static_cast<int>(random() % n));
  }
  solve::set_blocks(w.system, std::move(blocks));
  set_size(w.move, w.system.n_dof());
}

/// Expects own cells to be those of `all`, and no others to be there.
void expect_own_cells(const World& world, const Workspace& w, const State& all) {
  std::size_t wrong = 0;
  for (std::size_t lane = 0; lane < all.dcm.n_lane(); ++lane) {
    const dcm::BirthShape wanted =
        w.system.ownership.owns(lane / kLanes) ? all.dcm.birth[lane] : dcm::BirthShape();
    const dcm::BirthShape& b = world.state.dcm.birth[lane];
    if (!(b.edge == wanted.edge) || !(b.triangle == wanted.triangle)) ++wrong;
  }
  for (std::size_t b = 0; b < w.system.block.size(); ++b)
    for (std::size_t k = w.system.row_of(b) * kPointStride;
         k < w.system.row_of(b + 1) * kPointStride; ++k)
      if (world.state.last_move[k] != (w.system.ownership.owns(b) ? all.last_move[k] : 0)) ++wrong;
  EXPECT_EQ(wrong, 0U);
}

TEST(HeldCells, AreWithTheOwnersOfTheirCells) {
  World world = make_held_world();
  const State all = world.state;
  Workspace w;
  for (std::uint64_t seed = 1; seed < 4; ++seed) {
    draw_block_owners(seed, world, w);
    hand_over_cells(world, w);
    expect_own_cells(world, w, all);
    const State copy = world.state;
    EXPECT_EQ(copy.last_move, world.state.last_move);
    const std::uint64_t hash = hash_state(world.ranks, world.state);
    if (world.ranks.is_root()) {
      EXPECT_EQ(hash, hash_state(all));
    }
  }
  complete_cells(world.ranks, world.state);
  EXPECT_EQ(hash_state(world.state), hash_state(all));
  EXPECT_TRUE(world.state.cell_holder.empty());
}

TEST(HeldCells, OfOthersTakeNoMemory) {
  World world = make_held_world();
  Workspace w;
  draw_block_owners(1, world, w);
  std::ranges::fill(w.system.ownership.owner, world.ranks.size() - 1);  // those of the last process
  solve::set_blocks(w.system, solve::Blocks(w.system.block));
  hand_over_cells(world, w);
  const std::size_t bytes = world.state.last_move.size() * sizeof(double);
  const State copy = world.state;
  const bool owns = world.ranks.rank() == world.ranks.size() - 1;
  for (const State* s : {&std::as_const(world.state), &copy}) {
    if (!RowVector<double>::allocator_type::is_mapped(s->last_move.size())) continue;
    const std::size_t memory = memory_of(s->last_move);
    EXPECT_TRUE(owns ? memory >= bytes : memory == 0) << memory << " bytes";
  }
}

TEST(HeldCells, ComeBackWhenEveryProcessDoesAllWork) {
  World world = make_held_world();
  const State all = world.state;
  Workspace w;
  draw_block_owners(7, world, w);
  hand_over_cells(world, w);
  w.system.ownership.owner.clear();
  hand_over_cells(world, w);
  EXPECT_EQ(hash_state(world.state), hash_state(all));
}

}  // namespace
}  // namespace acinus::coupling
