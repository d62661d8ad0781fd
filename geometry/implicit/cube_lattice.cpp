#include "geometry/implicit/cube_lattice.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/box.hpp"
#include "core/error.hpp"

namespace acinus::geometry {

int CubeLattice::level_of(double size) const {
  const int finest = 3 * halvings - 1;
  int level = 0;
  while (level < finest && kLongest[level % 3] * std::ldexp(root, -(level / 3)) > size) ++level;
  return level;
}

CubeLattice make_lattice(const Shape& shape) {
  constexpr double kMostRoots = 64;
  constexpr int kSpare = 4;  // halvings for what an extraction bisects beyond what it was asked for
  Box box;
  for (const Box& b : shape.box) {
    box.include(b.low);
    box.include(b.high);
  }
  const double extent = (box.high - box.low).maxCoeff();
  const double largest = *std::ranges::max_element(shape.size);
  double least = largest;
  for (const double size : shape.size) least = std::min(least, size);
  for (const FineBall& ball : shape.fine) least = std::min(least, ball.size);
  CubeLattice l;
  l.root = std::max(largest, extent / kMostRoots);
  l.origin = box.low - Vec3::Constant(l.root);
  for (std::size_t k = 0; k < 3; ++k) {
    const int axis = static_cast<int>(k);
    l.n_root[k] = static_cast<int>(std::ceil((box.high[axis] - l.origin[axis]) / l.root)) + 1;
  }
  int most = 0;  // halvings
  while (*std::ranges::max_element(l.n_root) << (most + 1) < (1 << kPlaceBits)) ++most;
  l.halvings = most;
  const int level = l.level_of(least);
  check(kLongest[level % 3] * std::ldexp(l.root, -(level / 3)) <= least,
        fmt::format("triangles of {:.3g} um on a surface {:.3g} um across are too small: no more "
                    "than {} fit side by side. Take larger ones, or leave out what is thin.",
                    least, extent, 1 << kPlaceBits));
  l.halvings = std::min(level / 3 + 1 + kSpare, most);
  for (const double size : shape.size) l.last.push_back(l.level_of(size));
  for (const FineBall& ball : shape.fine) l.last_fine.push_back(l.level_of(ball.size));
  l.spacing = std::ldexp(l.root, -l.halvings);
  for (int k = 0; k <= 3 * l.halvings; ++k) {
    l.side.push_back(std::ldexp(l.root, -(k / 3)));
    l.remaining.push_back(kRemaining[k % 3] * l.side.back());
  }
  return l;
}

}  // namespace acinus::geometry
