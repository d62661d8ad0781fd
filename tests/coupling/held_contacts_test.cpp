/// Contacts of spheres follow their spheres from owner to owner.

#include "coupling/step/held_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

// Run as it stands and under mpirun: the claims are the same.

namespace acinus::coupling {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

constexpr int kSpheres = 200;

/// Spheres of which neighbours by number touch, and some touch the boundary.
State make_spheres() {
  std::vector<cbm::NewCell> cells(kSpheres);
  State s;
  s.cbm = cbm::make_state(cells);
  std::mt19937_64 random(11);
  std::set<std::pair<int, int>> pairs;
  for (int k = 0; k < 600; ++k) {
    const int a = static_cast<int>(random() % kSpheres);
    const int b = std::min(a + 1 + static_cast<int>(random() % 20), kSpheres);
    pairs.emplace(a, b == kSpheres ? ~static_cast<int>(random() % 3) : b);
  }
  s.cbm.touching.assign(pairs.begin(), pairs.end());
  return s;
}

/// Blocks of spheres with random owners; with one process all are own.
void draw_owners(std::uint64_t seed, Workspace& w) {
  w.system.ownership.ranks = Ranks::world();
  w.system.ownership.owner.clear();
  const auto n = static_cast<unsigned>(w.system.ownership.ranks.size());
  if (n == 1) return;
  std::mt19937_64 random(seed);
  for (int b = 0; b < kSpheres / kLanes; ++b)
    w.system.ownership.owner.push_back(static_cast<int>(random() % n));
}

/// Those of all pairs with a sphere of this process.
Pairs find_own(const Workspace& w, const Pairs& all) {
  Pairs own;
  for (const auto& [a, b] : all)
    if (w.system.ownership.owns(static_cast<std::size_t>(a / kLanes)) ||
        (b >= 0 && w.system.ownership.owns(static_cast<std::size_t>(b / kLanes))))
      own.emplace_back(a, b);
  return own;
}

TEST(HeldContacts, AreWithTheOwnersOfTheirSpheres) {
  State s = make_spheres();
  const Pairs all = s.cbm.touching;
  Workspace w;
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    draw_owners(seed, w);
    hand_over_contacts(Ranks::world(), w, s);
    EXPECT_EQ(s.cbm.touching, find_own(w, all)) << "owners " << seed;
  }
  complete_contacts(Ranks::world(), s);
  EXPECT_EQ(s.cbm.touching, all);
  EXPECT_TRUE(s.holder.empty());
}

TEST(HeldContacts, ComeBackFromAnyOwners) {
  State s = make_spheres();
  const Pairs all = s.cbm.touching;
  Workspace w;
  draw_owners(7, w);
  hand_over_contacts(Ranks::world(), w, s);
  w.system.ownership.owner.clear();  // every process does all the work
  hand_over_contacts(Ranks::world(), w, s);
  EXPECT_EQ(s.cbm.touching, all);
}

}  // namespace
}  // namespace acinus::coupling
