#include "coupling/generate/packing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"

namespace acinus::coupling {
namespace {

void check_spacing(double spacing, double jitter) {
  check(std::isfinite(spacing) && spacing > 0,
        fmt::format("/cells/spacing: {} um between cells, must be positive", spacing));
  check(std::isfinite(jitter) && jitter >= 0,
        fmt::format("/cells/jitter: {} um, must not be negative", jitter));
}

/// Displaces each point to a random place in the ball around it: cube root of a uniform number and
/// a direction from z and longitude, exactly three numbers per point.
void add_jitter(double jitter, const Uniform& uniform, std::vector<Vec3>& point) {
  if (jitter == 0) return;
  for (Vec3& x : point) {
    const double radius = jitter * std::cbrt(uniform());
    const double z = 2 * uniform() - 1, longitude = 2 * kPi * uniform();
    const double level = std::sqrt(1 - z * z);
    x += radius * Vec3(level * std::cos(longitude), level * std::sin(longitude), z);
  }
}

/// Gray code and its inverse, entry corner and direction of a Hilbert curve in the w-th of eight
/// octants.
unsigned gray(unsigned w) { return w ^ (w >> 1); }
unsigned gray_inverse(unsigned g) { return (g ^ (g >> 1) ^ (g >> 2)) & 7u; }
unsigned entry(unsigned w) { return w == 0 ? 0 : gray(2 * ((w - 1) / 2)); }
unsigned intra_direction(unsigned w) {
  if (w == 0) return 0;
  return static_cast<unsigned>(std::countr_one(w % 2 == 0 ? w - 1 : w)) % 3;
}
unsigned rotate_left(unsigned x, unsigned by) { return ((x << by) | (x >> (3 - by))) & 7u; }
unsigned rotate_right(unsigned x, unsigned by) { return ((x >> by) | (x << (3 - by))) & 7u; }

/// Position along the Hilbert curve: at each level the octant in the frame (corner of entry, main
/// direction) left by the levels above.
std::uint64_t hilbert_key(const std::array<std::uint32_t, 3>& cell, int bits) {
  std::uint64_t key = 0;
  unsigned corner = 0, direction = 0;
  for (int level = bits - 1; level >= 0; --level) {
    unsigned octant = 0;
    for (unsigned axis = 0; axis < 3; ++axis) octant |= ((cell[axis] >> level) & 1u) << axis;
    const unsigned turn = (direction + 1) % 3;
    const unsigned w = gray_inverse(rotate_right(octant ^ corner, turn));
    corner ^= rotate_left(entry(w), turn);
    direction = (direction + intra_direction(w) + 1) % 3;
    key = (key << 3) | w;
  }
  return key;
}

}  // namespace

std::vector<Vec3> make_clump(const ClumpParameters& p, const Uniform& uniform) {
  check_spacing(p.spacing, p.jitter);
  check(p.count >= 0, fmt::format("/cells/count = {}: must not be negative", p.count));
  // In half lattice constants: fcc has i + j + k even, bcc has i, j, k all even or all odd.
  const bool fcc = p.lattice == Lattice::kFcc;
  const int reach = 3 + static_cast<int>(std::ceil((fcc ? 1.0 : 1.3) * std::cbrt(2.0 * p.count)));
  using Point = std::tuple<int, int, int, int>;  // squared distance, z, y, x
  std::vector<Point> lattice;
  for (int z = -reach; z <= reach; ++z)
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const bool in = fcc ? (x + y + z) % 2 == 0 : (x - y) % 2 == 0 && (y - z) % 2 == 0;
        const int distance2 = x * x + y * y + z * z;
        if (in && distance2 <= reach * reach) lattice.emplace_back(distance2, z, y, x);
      }
  ACINUS_ASSERT(static_cast<int>(lattice.size()) >= p.count);
  std::sort(lattice.begin(), lattice.end());
  const double unit = p.spacing / std::sqrt(fcc ? 2.0 : 3.0);
  std::vector<Vec3> point;
  for (int i = 0; i < p.count; ++i) {
    const auto& [distance2, z, y, x] = lattice[i];
    point.emplace_back(unit * x, unit * y, unit * z);
  }
  add_jitter(p.jitter, uniform, point);
  return point;
}

std::vector<Vec3> make_box(const BoxParameters& p, const Uniform& uniform) {
  check_spacing(p.spacing, p.jitter);
  for (const int n : p.count) check(n >= 0, fmt::format("/cells/grid: {} must not be negative", n));
  const bool hexagonal = p.packing == BoxPacking::kHexagonal;
  std::vector<Vec3> point;
  for (int k = 0; k < p.count[2]; ++k)
    for (int j = 0; j < p.count[1]; ++j)
      for (int i = 0; i < p.count[0]; ++i) {
        Vec3 x(i, j, k);
        if (hexagonal) {  // layers ABAB: every other row moves half a cell, every other layer a
                          // third of a row
          x = {i + 0.5 * ((j + k) % 2), std::sqrt(3.0) / 2 * (j + (k % 2) / 3.0),
               std::sqrt(2.0 / 3.0) * k};
        }
        point.push_back(p.spacing * x);
      }
  if (point.empty()) return point;
  Vec3 low = point.front(), high = point.front();
  for (const Vec3& x : point) low = low.cwiseMin(x), high = high.cwiseMax(x);
  for (Vec3& x : point) x -= (low + high) / 2;
  add_jitter(p.jitter, uniform, point);
  return point;
}

std::vector<int> space_filling_order(std::span<const Vec3> point) {
  constexpr int kBits = 16;
  constexpr std::size_t kWorthThreads = 500;
  if (point.empty()) return {};
  Vec3 low = point[0], high = point[0];
  for (const Vec3& x : point) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double side = (high - low).maxCoeff();
  const double scale = side > 0 ? (1 << kBits) / side : 0.0;
  std::vector<std::pair<std::uint64_t, int>> key(point.size());
  for_each_index(point.size(), point.size() > kWorthThreads, [&](std::size_t i) {
    std::array<std::uint32_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis)
      cell[axis] = static_cast<std::uint32_t>(
          std::min((point[i][axis] - low[axis]) * scale, (1 << kBits) - 1.0));
    key[i] = {hilbert_key(cell, kBits), static_cast<int>(i)};
  });
  std::ranges::sort(key);
  std::vector<int> order;
  order.reserve(key.size());
  for (const auto& [at, i] : key) order.push_back(i);
  return order;
}

}  // namespace acinus::coupling
