#include "geometry/box_pairs.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/parallel/threads.hpp"

namespace acinus::geometry {
namespace {

/// Fewest boxes that are searched by all threads.
constexpr std::size_t kLeastShared = 500;

using Key = std::uint64_t;
using CellIndex = std::array<std::int64_t, 3>;

/// Boxes hashed by the grid cell of their centre; x runs fastest so a row of cells is one key
/// range.
class BoxGrid {
 public:
  using Item = std::pair<Key, int>;
  /// @param item  scratch that outlives the grid
  BoxGrid(std::span<const Box> boxes, double width, const Vec3& origin, std::vector<Item>& item)
      : width_(width), origin_(origin), item_(item) {
    item_.clear();
    item_.reserve(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i)
      item_.emplace_back(key(cell(boxes[i])), static_cast<int>(i));
    std::ranges::sort(item_);
  }
  CellIndex cell(const Box& b) const {
    const Vec3 at = (0.5 * (b.low + b.high) - origin_) / width_;
    CellIndex c;
    for (int k = 0; k < 3; ++k)
      c[k] = static_cast<std::int64_t>(std::floor(std::clamp(at[k], -1e6, 1e6))) + kBias;
    return c;
  }
  /// Calls f(box index) for every box in the 27 grid cells around c.
  template <class F>
  void for_each_near(const CellIndex& c, F f) const {
    for (std::int64_t dz = -1; dz <= 1; ++dz)
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        const Key from = key({c[0] - 1, c[1] + dy, c[2] + dz});
        const Key to = key({c[0] + 1, c[1] + dy, c[2] + dz});
        for (auto it = std::ranges::lower_bound(item_, std::pair<Key, int>{from, 0});
             it != item_.end() && it->first <= to; ++it)
          f(it->second);
      }
  }

 private:
  static constexpr std::int64_t kBias = 1 << 20;  ///< 21 bits per axis
  static Key key(const CellIndex& c) {
    return static_cast<Key>(c[0]) | static_cast<Key>(c[1]) << 21 | static_cast<Key>(c[2]) << 42;
  }
  double width_;
  Vec3 origin_;
  std::vector<Item>& item_;
};

double widest(std::span<const Box> boxes) {
  double w = 0;
  for (const Box& b : boxes) w = std::max(w, (b.high - b.low).maxCoeff());
  return w;
}

}  // namespace

std::vector<std::pair<int, int>> find_pairs(std::span<const Box> boxes, double margin) {
  const std::size_t n = boxes.size();
  if (n < 2) return {};
  std::vector<BoxGrid::Item> item;
  const BoxGrid grid(boxes, widest(boxes) + margin, boxes[0].low, item);
  // In the order of the boxes, for any number of threads.
  const std::size_t n_part = n < kLeastShared ? 1 : thread_count();
  std::vector<std::vector<std::pair<int, int>>> found(n_part);
  for_each_part(n_part, [&](std::size_t part) {
    std::vector<std::pair<int, int>>& pairs = found[part];
    for (std::size_t i = part * n / n_part; i < (part + 1) * n / n_part; ++i) {
      const Box reach = boxes[i].grown(margin);
      const std::size_t first = pairs.size();
      grid.for_each_near(grid.cell(boxes[i]), [&](int j) {
        if (j > static_cast<int>(i) && reach.overlaps(boxes[j]))
          pairs.emplace_back(static_cast<int>(i), j);
      });
      std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
    }
  });
  for (std::size_t part = 1; part < n_part; ++part)
    found[0].insert(found[0].end(), found[part].begin(), found[part].end());
  return std::move(found[0]);
}

std::vector<std::pair<int, int>> find_pairs_between(std::span<const Box> a, std::span<const Box> b,
                                                    double margin) {
  std::vector<std::pair<int, int>> pairs;
  find_pairs_between(a, b, margin, pairs);
  return pairs;
}

void find_pairs_between(std::span<const Box> a, std::span<const Box> b, double margin,
                        std::vector<std::pair<int, int>>& pairs) {
  pairs.clear();
  if (a.empty() || b.empty()) return;
  thread_local std::vector<BoxGrid::Item> item;
  const BoxGrid grid(b, std::max(widest(a), widest(b)) + margin, b[0].low, item);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Box reach = a[i].grown(margin);
    const std::size_t first = pairs.size();
    grid.for_each_near(grid.cell(a[i]), [&](int j) {
      if (reach.overlaps(b[j])) pairs.emplace_back(static_cast<int>(i), j);
    });
    std::sort(pairs.begin() + static_cast<std::ptrdiff_t>(first), pairs.end());
  }
}

}  // namespace acinus::geometry
