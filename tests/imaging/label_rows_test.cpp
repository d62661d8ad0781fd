#include "imaging/label_rows.hpp"

#include <gtest/gtest.h>

#include <random>

#include "imaging/scalar.hpp"
#include "tests/imaging/images.hpp"

namespace acinus::imaging {
namespace {

LabelImage noise(std::uint32_t seed) {
  std::mt19937 random(seed);
  return make_image({13, 4, 3}, Vec3::Ones(), [&](const Vec3&) { return Label(random() % 3); });
}

TEST(LabelRows, HoldsWhatTheImageHolds) {
  const LabelImage image = noise(1);
  const LabelRows rows = make_rows(image);
  EXPECT_EQ(spread_rows(rows).label, image.label);
  EXPECT_LT(rows.count_rows(), image.label.size());
  for (const LabelLine& line : rows.line)
    for (std::size_t k = 1; k < line.size(); ++k) EXPECT_NE(line[k].label, line[k - 1].label);
}

TEST(LabelRows, AreTheSameFromPieces) {
  const LabelImage image = noise(2);
  const LabelRows whole = make_rows(image);
  for (int length = 1; length < 13; ++length) {
    LabelLine line;
    for (int x = 0; x < 13; x += length)
      append_voxels(x, std::span(image.label).subspan(x, std::min(length, 13 - x)), 0, line);
    EXPECT_EQ(line, whole.line[0]) << length;
  }
}

TEST(LabelRows, FillGapsAndEnds) {
  LabelRows image{{{10, 1, 1}, Vec3::Ones()}, std::vector<LabelLine>(1), 0};
  append_voxels(2, std::vector<Label>{7, 7, 5}, 7, image.line[0]);
  append_voxels(7, std::vector<Label>{5}, 5, image.line[0]);
  complete_lines(9, image);
  EXPECT_EQ(image.line[0], (LabelLine{{4, 7}, {8, 5}, {10, 9}}));
}

TEST(VisitOverlaps, CoversTheLine) {
  const LabelRows a = make_rows(noise(3)), b = make_rows(noise(4));
  for (std::size_t k = 0; k < a.line.size(); ++k) {
    int at = 0;
    visit_overlaps(a.line[k], b.line[k], [&](int first, int end, std::size_t i, std::size_t j) {
      EXPECT_EQ(first, at);
      EXPECT_LT(first, end);
      EXPECT_TRUE(first_of(a.line[k], i) <= first && end <= a.line[k][i].end);
      EXPECT_TRUE(first_of(b.line[k], j) <= first && end <= b.line[k][j].end);
      at = end;
    });
    EXPECT_EQ(at, 13);
  }
}

TEST(CheckMemory, StopsBeforeItIsFull) {
  EXPECT_NO_THROW(check_memory("a.tif", 1.5e9, 2e9));
  EXPECT_CONTAINS(test::message_of([] { check_memory("a.tif", 1.9e9, 2e9); }),
                  "a.tif: labels take 1.9 GB of memory already; this machine has 2");
}

}  // namespace
}  // namespace acinus::imaging
