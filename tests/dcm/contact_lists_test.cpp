/// Lists outlive movement, growth and new numbers of the cells, and never change what is found.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dcm/bounded_clump.hpp"

namespace acinus::dcm {
namespace {

TEST(ContactLists, OldListsGiveWhatNewListsGive) {
  Clump c = make_bounded_clump(88);
  auto random = reference::stream(89);
  c.find();
  const State start = c.state;
  for (int k = 0; k < 5; ++k) {
    c.state = start;
    c.for_each_node([&](Address a) {
      add_point(c.state.position.data(), a, random.uniform(0, 0.13) * random.unit_vector());
    });
    const auto made = c.work.lists.made;
    c.find();
    EXPECT_EQ(c.work.lists.made, made) << "less than the skin, two and two";
    const auto features = features_of(c);
    const auto gap = gaps_of(c);
    const auto force = c.node_force();
    Clump fresh = c;
    fresh.find_afresh();
    EXPECT_EQ(fresh.work.lists.made,
              fresh.work.lists.pair.size() + fresh.work.lists.segment.size());
    EXPECT_EQ(features, features_of(fresh));
    EXPECT_EQ(gap, gaps_of(fresh));
    EXPECT_EQ(force, fresh.node_force());
  }
  store_point(c.state.position.data(), node_address(c.state, 0, 5),
              c.work.body[0].node[5] + Vec3(0, 0, 0.4));
  const auto made = c.work.lists.made;
  c.find();
  EXPECT_GT(c.work.lists.made, made);
}

TEST(ContactLists, OnlyListsOfACellThatMovedAreMade) {
  Clump c = make_bounded_clump(92);
  c.find();
  const auto made = c.work.lists.made;
  for (int i = 0; i < 162; ++i)
    add_point(c.state.position.data(), node_address(c.state, 3, i), Vec3(0, 0, 0.4));
  c.find();
  const auto with_it = std::ranges::count_if(c.work.lists.pair, [](const contact::Candidates& p) {
    return (p.body_a == 3) != (p.body_b == 3);
  });
  EXPECT_GT(with_it, 0);
  EXPECT_EQ(c.work.lists.made, made + with_it + 1) << "and its list of vessels";
  Clump fresh = c;
  fresh.find_afresh();
  EXPECT_EQ(features_of(c), features_of(fresh));
  EXPECT_EQ(gaps_of(c), gaps_of(fresh));
}

TEST(ContactLists, ListsOutliveNewNumbersOfTheCells) {
  Clump c = make_bounded_clump(93);
  c.find();
  const auto made = c.work.lists.made;
  const std::vector<SelectedCell<State>> rest{
      {&c.state, 3}, {&c.state, 8}, {&c.state, 0}, {&c.state, 2}};
  std::vector<std::size_t> lane;
  State fewer = compose(rest, lane);
  c.state = std::move(fewer);
  c.work.body.clear();
  c.find();
  EXPECT_EQ(c.work.lists.body.size(), 4u);
  EXPECT_EQ(c.work.lists.made, made);
  Clump fresh = c;
  fresh.find_afresh();
  EXPECT_GT(fresh.work.lists.made, 0);
  EXPECT_EQ(features_of(c), features_of(fresh));
  EXPECT_EQ(gaps_of(c), gaps_of(fresh));
  EXPECT_EQ(c.node_force(), fresh.node_force());
}

TEST(ContactLists, GrowthAloneRenewsTheLists) {
  Clump c = make_clump(90);
  c.options.friction_range = 0.01;
  c.find();
  const auto made = c.work.lists.made;
  for (Ramp& v : c.state.volume) v = Ramp::constant(v.to * 1.2);  // range grows by 6 % of 0.9 um
  c.find();
  EXPECT_EQ(c.work.lists.made, made);
  for (Ramp& v : c.state.volume) v = Ramp::constant(v.to * 2.5);
  c.find();
  EXPECT_GT(c.work.lists.made, made);
}

}  // namespace
}  // namespace acinus::dcm
