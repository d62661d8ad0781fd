/// New states made of cells of others: nothing that belongs to a cell gets lost or mixed up.

#include "coupling/subworld/population.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "coupling/world/cell.hpp"
#include "tests/coupling/lives.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::coupling {
namespace {

using Touching = std::set<std::pair<std::int64_t, std::int64_t>>;

/// Twelve shells of two meshes and eleven spheres, every number of every cell different.
State make_state(std::int64_t first_lineage = 0) {
  auto random = reference::stream(61);
  std::vector<dcm::NewCell> shells;
  std::vector<cbm::NewCell> spheres;
  const auto place = [&] { return reference::random_vector(random, 100); };
  for (std::int64_t k = 0; k < 12; ++k)
    shells.push_back({first_lineage + k, static_cast<int>(k % 2),
                      &geometry::shared_icosphere(k % 3 == 0 ? 12 : 42), place(), 10 + 0.1 * k,
                      place(), reference::random_rotation(random)});
  for (std::int64_t k = 0; k < 11; ++k)
    spheres.push_back({first_lineage + 12 + k,
                       static_cast<int>(k % 2),
                       place(),
                       10 + 0.1 * k,
                       0.4 + 0.01 * k,
                       place(),
                       {0, 1, 0.5 * k, 100.0 + k}});
  State s;
  s.dcm = dcm::make_state(shells);
  s.cbm = cbm::make_state(spheres);
  s.cbm.touching = {{0, ~5}, {0, 3}, {2, 3}, {2, 7}, {4, ~1}, {5, 10}};
  const std::size_t n = s.dcm.n_lane() + s.cbm.n_cell();
  s.leader.assign(n, 0);
  s.asleep.assign(n, 0);
  s.cycle.assign(n, Cycle{});
  s.last_move.assign(s.dcm.position.size() + s.cbm.position.size(), 0.0);
  for (double& m : s.last_move) m = random.uniform(-1, 1);
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t id = lineage_of(s, c);
    s.leader[c.index] = id % 2 == 0;
    s.asleep[c.index] = id % 5 == 0;
    s.cycle[c.index] = {id - 100, id - 200, Fate::kGrow, 1.0 * id, 2.0 * id, 3.0 * id, 4.0 * id};
    volume_of(s, c) = {1000.0 + static_cast<double>(id), 2000, 1, 2};
    if (c.deformable) {
      dcm::BirthShape& b = s.dcm.birth[c.at];
      const geometry::Topology& t = *s.dcm.group[c.at / kLanes].topology;
      b = {{1, 0, 0, 1.0 * static_cast<double>(id)}, 1.1, {}, {}, {}};
      b.edge = std::vector<double>(static_cast<std::size_t>(t.n_edge),
                                   1 + 0.01 * static_cast<double>(id));
      b.triangle = std::vector<double>(static_cast<std::size_t>(t.n_triangle), 1.2);
    }
  });
  s.clock.time = 7200;
  s.clock.last_step = 60;
  s.balance.momentum = 1e-12;
  s.life_interval = 12;
  s.sleep_interval = 13;
  s.leader_interval = 14;
  s.next_lineage = 23;
  s.divisions = 5;
  s.deaths = 6;
  return s;
}

Touching touching_lineages(const cbm::State& s) {
  Touching t;
  for (const auto& [a, b] : s.touching) {
    const std::int64_t i = s.lineage[a];
    if (b < 0) {
      t.emplace(i, b);
      continue;
    }
    const std::int64_t j = s.lineage[b];
    t.emplace(std::min(i, j), std::max(i, j));
  }
  return t;
}

Vec3 last_move(const State& s, const Cell& c, int node) {
  return load_point(s.last_move.data(), c.deformable ? dcm::node_address(s.dcm, c.at, node)
                                                     : cbm::cell_address(s.dcm.n_row(), c.at));
}

void expect_same_ramp(const Ramp& a, const Ramp& b) {
  EXPECT_EQ((std::array{a.from, a.to, a.start, a.end}), (std::array{b.from, b.to, b.start, b.end}));
}

/// Checks that a cell has kept every bit of what belongs to it.
void expect_same_cell(State& now, const Cell& c, State& before, const Cell& d) {
  ASSERT_EQ(c.deformable, d.deformable);
  expect_same_ramp(volume_of(now, c), volume_of(before, d));
  EXPECT_EQ(now.leader[c.index], before.leader[d.index]);
  EXPECT_EQ(now.asleep.empty() ? 0 : now.asleep[c.index], before.asleep[d.index]);
  const Cycle &x = now.cycle[c.index], &y = before.cycle[d.index];
  EXPECT_EQ(
      std::tie(x.parent, x.founder, x.fate, x.birth, x.birth_volume, x.duration, x.wait_until),
      std::tie(y.parent, y.founder, y.fate, y.birth, y.birth_volume, y.duration, y.wait_until));
  if (!c.deformable) {
    EXPECT_EQ(cbm::center_of(now.cbm, c.at), cbm::center_of(before.cbm, d.at));
    EXPECT_EQ(last_move(now, c, 0), last_move(before, d, 0));
    EXPECT_EQ(now.cbm.young[c.at], before.cbm.young[d.at]);
    EXPECT_EQ(now.cbm.pull[c.at], before.cbm.pull[d.at]);
    expect_same_ramp(now.cbm.strength[c.at], before.cbm.strength[d.at]);
    return;
  }
  const geometry::Topology* topology = now.dcm.group[c.at / kLanes].topology;
  ASSERT_EQ(topology, before.dcm.group[d.at / kLanes].topology);
  for (int i = 0; i < topology->n_node; ++i) {
    EXPECT_EQ(load_point(now.dcm.position.data(), dcm::node_address(now.dcm, c.at, i)),
              load_point(before.dcm.position.data(), dcm::node_address(before.dcm, d.at, i)));
    EXPECT_EQ(last_move(now, c, i), last_move(before, d, i));
  }
  EXPECT_EQ(now.dcm.pull[c.at], before.dcm.pull[d.at]);
  EXPECT_EQ(now.dcm.birth[c.at].edge, before.dcm.birth[d.at].edge);
  EXPECT_EQ(now.dcm.birth[c.at].triangle, before.dcm.birth[d.at].triangle);
  expect_same_ramp(now.dcm.birth[c.at].weight, before.dcm.birth[d.at].weight);
}

TEST(Compose, KeepsAllThatBelongsToACellInAnyOrder) {
  State before = make_state();
  std::vector<SelectedCell<State>> shells = list_dcm(before), spheres = list_cbm(before);
  ASSERT_EQ(shells.size(), 12u);
  ASSERT_EQ(spheres.size(), 11u);
  std::ranges::reverse(shells);
  std::ranges::rotate(spheres, spheres.begin() + 4);
  State now = compose(shells, spheres, before);
  const auto old_index = index_cells(before), new_index = index_cells(now);
  ASSERT_EQ(new_index.size(), 23u);
  for (const auto& [id, c] : new_index) {
    EXPECT_EQ(type_of(now, c), type_of(before, old_index.at(id)));
    expect_same_cell(now, c, before, old_index.at(id));
  }
  EXPECT_EQ(touching_lineages(now.cbm), touching_lineages(before.cbm));
  EXPECT_TRUE(std::ranges::is_sorted(now.cbm.touching)) << "it is searched by halving";
  EXPECT_TRUE(has_last_move(now));
  EXPECT_EQ(now.clock.time, 7200);
  EXPECT_EQ(now.balance.momentum, 1e-12);
  EXPECT_EQ(now.life_interval, 12);
  EXPECT_EQ(now.sleep_interval, 13);
  EXPECT_EQ(now.leader_interval, 14);
  EXPECT_EQ(now.next_lineage, 23);
  EXPECT_EQ(now.divisions, 5);
  EXPECT_EQ(now.deaths, 6);
}

TEST(Compose, LanesWithoutACellHoldTheRestShapeAndNothingElse) {
  const State before = make_state();
  const State now = compose(list_dcm(before), {}, before);
  int empty = 0;
  for (std::size_t l = 0; l < now.dcm.n_lane(); ++l) {
    if (now.dcm.active(l)) continue;
    ++empty;
    const geometry::Topology& t = *now.dcm.group[l / kLanes].topology;
    for (int i = 0; i < t.n_node; ++i) {
      const Address a = dcm::node_address(now.dcm, l, i);
      EXPECT_EQ(load_point(now.dcm.position.data(), a), t.rest[i]);
      EXPECT_EQ(load_point(now.last_move.data(), a), Vec3::Zero());
    }
    EXPECT_EQ(now.cycle[l].fate, Fate::kIdle);
    EXPECT_TRUE(now.dcm.birth[l].edge.empty());
  }
  EXPECT_GT(empty, 0);
}

TEST(Compose, WithoutSomeCellsKeepsTheContactsOfTheOthers) {
  State before = make_state();
  std::vector<SelectedCell<State>> shells = list_dcm(before), spheres = list_cbm(before);
  shells.erase(shells.begin() + 2);
  spheres.erase(spheres.begin() + 3);  // touches 0 and 2
  State now = compose(shells, spheres, before);
  const auto old_index = index_cells(before), new_index = index_cells(now);
  ASSERT_EQ(new_index.size(), 21u);
  for (const auto& [id, c] : new_index) expect_same_cell(now, c, before, old_index.at(id));
  Touching expected = touching_lineages(before.cbm);
  std::erase_if(expected, [](const auto& p) { return p.first == 15 || p.second == 15; });
  EXPECT_EQ(expected.size(), 4u);
  EXPECT_EQ(touching_lineages(now.cbm), expected);
}

TEST(Compose, OfTwoStatesAddsTheCellsOfTheSecond) {
  State before = make_state(), born = make_state(100);
  born.last_move.clear();
  born.leader.clear();
  born.asleep.clear();
  std::vector<SelectedCell<State>> shells = list_dcm(born), spheres = list_cbm(born);
  std::ranges::copy(list_dcm(before), std::back_inserter(shells));
  std::ranges::copy(list_cbm(before), std::back_inserter(spheres));
  State now = compose(shells, spheres, before);
  const auto index = index_cells(now), old_index = index_cells(before);
  ASSERT_EQ(index.size(), 46u);
  for (const auto& [id, c] : old_index) expect_same_cell(now, index.at(id), before, c);
  for (const auto& [id, c] : index) {
    if (id < 100) continue;
    EXPECT_EQ(now.cycle[c.index].founder, id - 200);
    EXPECT_EQ(last_move(now, c, 0), Vec3::Zero()) << "has not moved yet";
    EXPECT_EQ(now.leader[c.index] + now.asleep[c.index], 0);
  }
  Touching expected = touching_lineages(before.cbm);
  expected.merge(touching_lineages(born.cbm));
  EXPECT_EQ(touching_lineages(now.cbm), expected) << "none between cells of different states";
}

TEST(Compose, OfNobodyIsAnEmptyStateThatKeepsItsClock) {
  const State now = compose({}, {}, make_state());
  EXPECT_EQ(now.dcm.n_lane() + now.cbm.n_cell(), 0u);
  EXPECT_TRUE(now.cbm.touching.empty());
  EXPECT_EQ(now.clock.time, 7200);
}

TEST(Compose, OfAllCellsAsTheyStandIsTheSameStateToTheBit) {
  const State before = make_state(), once = compose(list_dcm(before), list_cbm(before), before),
              twice = compose(list_dcm(once), list_cbm(once), once);
  EXPECT_EQ(once.dcm.lineage, before.dcm.lineage);
  EXPECT_EQ(once.dcm.position, before.dcm.position);
  EXPECT_EQ(once.cbm.position, before.cbm.position);
  EXPECT_EQ(once.cbm.touching, before.cbm.touching);
  EXPECT_EQ(hash_state(twice), hash_state(once));
}

TEST(Compose, ChangesTheTypeOfAMemberAndNothingElse) {
  State before = make_state();
  std::vector<SelectedCell<State>> shells = list_dcm(before), spheres = list_cbm(before);
  shells[4].type = 2;
  spheres[7].type = 2;
  const std::int64_t shell = before.dcm.lineage[shells[4].index],
                     sphere = before.cbm.lineage[spheres[7].index];
  State now = compose(shells, spheres, before);
  const auto old_index = index_cells(before), new_index = index_cells(now);
  for (const auto& [id, c] : new_index) {
    EXPECT_EQ(type_of(now, c), id == shell || id == sphere ? 2 : type_of(before, old_index.at(id)));
    expect_same_cell(now, c, before, old_index.at(id));
  }
  for (std::size_t l = 0; l < now.dcm.n_lane(); ++l)
    if (now.dcm.group[l / kLanes].type == 2 && now.dcm.active(l)) {
      EXPECT_EQ(now.dcm.lineage[l], shell) << "a group has one type";
    }
}

TEST(SortByPlace, IsAPermutationThatBringsNeighboursTogether) {
  std::vector<TestCell> cells;
  for (int k = 0; k < 512; ++k) {
    const int shuffled = k * 181 % 512;
    cells.push_back({24.0 * Vec3(shuffled % 8, shuffled / 8 % 8, shuffled / 64), k % 8 == 0});
  }
  State s = make_test_world(cells, 60, 12).state;
  const auto walk = [&s] {
    double length = 0;
    for (std::size_t k = 1; k < s.cbm.n_cell(); ++k)
      length += (cbm::center_of(s.cbm, k) - cbm::center_of(s.cbm, k - 1)).norm();
    return length;
  };
  const double before = walk();
  const std::vector<std::int64_t> all = lineages(s);
  exchange_cells(Ranks::serial(), std::vector<std::uint8_t>(s.dcm.n_lane() + s.cbm.n_cell(), 0), {},
                 {}, s);
  EXPECT_EQ(lineages(s), all);
  EXPECT_LT(walk(), 0.4 * before);
  // A Hilbert curve through a full grid takes single steps; one place in eight is a shell.
  EXPECT_LT(walk(), 1.5 * 24 * 512);
}

}  // namespace
}  // namespace acinus::coupling
