/// Boxes that meet, of the sizes of cells, vessels and triangles side by side.

#include <gtest/gtest.h>

#include <cstdio>
#include <utility>
#include <vector>

#include "geometry/audit_body.hpp"
#include "tests/reference/sample.hpp"

namespace acinus::geometry {
namespace {

using Pairs = std::vector<std::pair<int, int>>;

Pairs try_every_pair(const std::vector<Box>& box) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(box.size()); ++i)
    for (int j = i + 1; j < static_cast<int>(box.size()); ++j)
      if (box[i].overlaps(box[j])) pairs.emplace_back(i, j);
  return pairs;
}

TEST(MeetingBoxes, AreThoseThatTryingEveryPairFinds) {
  for (const int n : {0, 1, 2, 300, 4000}) {
    auto random = reference::stream(71);
    std::vector<Box> box;
    for (int k = 0; k < n; ++k) {
      const Vec3 middle = reference::random_vector(random, 100);
      const double size = k % 50 == 0 ? 80 : k % 3 == 0 ? 0.5 : 6;
      box.push_back(segment_box(middle, middle + reference::random_vector(random, size)));
    }
    const Pairs pairs = meeting_boxes(box);
    EXPECT_EQ(pairs, try_every_pair(box)) << n;
    std::printf("%d boxes: %zu pairs\n", n, pairs.size());
  }
}

TEST(MeetingBoxes, BoxesThatOnlyTouchMeetAndEqualOnesAllDo) {
  const Box unit = segment_box({0, 0, 0}, {1, 1, 1}), beside = segment_box({1, 0, 0}, {2, 1, 1}),
            apart = segment_box({2.5, 0, 0}, {3, 1, 1});
  EXPECT_EQ(meeting_boxes(std::vector<Box>{beside, apart, unit}), (Pairs{{0, 2}}));
  const std::vector<Box> same(700, unit);
  EXPECT_EQ(meeting_boxes(same).size(), 700u * 699u / 2);
}

}  // namespace
}  // namespace acinus::geometry
