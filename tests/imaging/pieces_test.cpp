#include "imaging/pieces.hpp"

#include <gtest/gtest.h>

#include <queue>
#include <random>
#include <set>

#include "tests/imaging/images.hpp"

namespace acinus::imaging {
namespace {

/// Pieces by flooding: (label, voxels) of each, sorted.
std::multiset<std::pair<Label, std::size_t>> flood(const LabelImage& image) {
  std::multiset<std::pair<Label, std::size_t>> pieces;
  std::vector<char> seen(image.label.size(), 0);
  for (int z = 0; z < image.size[2]; ++z)
    for (int y = 0; y < image.size[1]; ++y)
      for (int x = 0; x < image.size[0]; ++x) {
        const Voxel start{x, y, z};
        const Label label = image.label[image.index(start)];
        if (label == 0 || seen[image.index(start)] != 0) continue;
        std::size_t n = 0;
        std::queue<Voxel> todo{{start}};
        seen[image.index(start)] = 1;
        for (; !todo.empty(); todo.pop()) {
          ++n;
          for (std::size_t k = 0; k < 3; ++k)
            for (const int step : {-1, 1}) {
              Voxel v = todo.front();
              v[k] += step;
              if (v[k] < 0 || v[k] >= image.size[k] || seen[image.index(v)] != 0 ||
                  image.label[image.index(v)] != label)
                continue;
              seen[image.index(v)] = 1;
              todo.push(v);
            }
        }
        pieces.emplace(label, n);
      }
  return pieces;
}

TEST(FindPieces, FindsWhatFloodingFinds) {
  std::mt19937 random(1);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const LabelImage image =
        make_image({11, 7, 9}, Vec3::Ones(), [&](const Vec3&) { return Label(random() % 3); });
    const LabelRows rows = make_rows(image);
    const Pieces pieces = find_pieces(rows);
    std::multiset<std::pair<Label, std::size_t>> found;
    for (const Piece& p : pieces.piece) found.emplace(p.label, p.n_voxel);
    EXPECT_EQ(found, flood(image));
    EXPECT_TRUE(std::ranges::is_sorted(pieces.piece, [](const Piece& a, const Piece& b) {
      return a.label != b.label ? a.label < b.label : a.n_voxel > b.n_voxel;
    }));
    std::vector<std::size_t> n(pieces.piece.size(), 0);
    std::size_t row = 0;
    for (const LabelLine& line : rows.line)
      for (std::size_t k = 0; k < line.size(); ++k, ++row) {
        EXPECT_EQ(pieces.of_row[row] < 0, line[k].label == 0);
        if (pieces.of_row[row] >= 0) n[pieces.of_row[row]] += line[k].end - first_of(line, k);
      }
    for (std::size_t k = 0; k < n.size(); ++k) EXPECT_EQ(n[k], pieces.piece[k].n_voxel);
  }
}

TEST(FindPieces, KnowsBoxCentreAndBorder) {
  const LabelImage image = make_image({10, 10, 10}, {0.5, 1, 2}, [](const Vec3& x) {
    if (x[0] > 1 && x[0] < 3 && x[1] > 4 && x[1] < 6 && x[2] > 6 && x[2] < 12) return Label{7};
    return Label(x[2] > 18 ? 3 : 0);
  });
  const Pieces pieces = find_pieces(make_rows(image));
  ASSERT_EQ(pieces.piece.size(), 2u);
  EXPECT_TRUE(pieces.piece[0].at_border);
  const Piece& p = pieces.piece[1];
  EXPECT_EQ(p.label, 7u);
  EXPECT_FALSE(p.at_border);
  EXPECT_EQ(p.low, (Voxel{2, 4, 3}));
  EXPECT_EQ(p.high, (Voxel{5, 5, 5}));
  EXPECT_LT((p.center - Vec3(2, 5, 9)).norm(), 1e-12);
}

TEST(FindTouching, CountsFaces) {
  const LabelImage image = make_image({6, 4, 4}, Vec3::Ones(), [](const Vec3& x) {
    return x[0] < 2 ? Label{1} : x[0] < 4 ? Label{2} : Label{0};
  });
  EXPECT_EQ(find_touching(make_rows(image), 16), (std::vector<std::array<Label, 2>>{{1, 2}}));
  EXPECT_TRUE(find_touching(make_rows(image), 17).empty());
}

}  // namespace
}  // namespace acinus::imaging
