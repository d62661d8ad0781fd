#include "coupling/substances/vessel_feed.hpp"

#include <algorithm>
#include <cmath>

namespace acinus::coupling {
namespace {

/// Pieces of a wall per voxel along it, and around it.
constexpr double kPiecesPerVoxel = 4;
constexpr int kPiecesAround = 12;

}  // namespace

void add_vessel_feed(const substances::VoxelGrid& grid, const geometry::Network& vessels,
                     double permeability, double concentration, std::span<double> gain,
                     std::span<double> loss) {
  const Box box = grid.box();
  for (std::size_t k = 0; k < vessels.segment.size(); ++k) {
    const Vec3 &from = vessels.node[vessels.segment[k][0]],
               &to = vessels.node[vessels.segment[k][1]];
    const Vec3 along = to - from;
    const double length = along.norm();
    if (!(length > 0)) continue;
    const auto [r0, r1] = vessels.radius[k];
    const double slant = std::hypot(1.0, (r1 - r0) / length);
    const Vec3 u = along.unitOrthogonal(), v = along.normalized().cross(u);
    const int n = std::max(
        1, static_cast<int>(std::ceil(kPiecesPerVoxel * length / grid.spacing.minCoeff())));
    for (int i = 0; i < n; ++i) {
      const double share = (i + 0.5) / n, radius = r0 + share * (r1 - r0);
      const double area = 2 * kPi * radius * slant * length / n / kPiecesAround;
      for (int j = 0; j < kPiecesAround; ++j) {
        const double angle = 2 * kPi * (j + 0.5) / kPiecesAround;
        const Vec3 x = from + share * along + radius * (std::cos(angle) * u + std::sin(angle) * v);
        if (!box.contains(x)) continue;
        const Vec3 place = (x - grid.low).cwiseQuotient(grid.spacing);
        const auto at = [&](int axis) {
          return std::clamp(static_cast<int>(place[axis]), 0, grid.n[axis] - 1);
        };
        const std::size_t voxel = grid.index(at(0), at(1), at(2));
        const double rate = permeability * area / grid.voxel_volume();
        loss[voxel] += rate;
        gain[voxel] += rate * concentration;
      }
    }
  }
}

}  // namespace acinus::coupling
