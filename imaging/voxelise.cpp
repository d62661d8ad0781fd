#include "imaging/voxelise.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "core/box.hpp"
#include "core/error.hpp"
#include "core/numbers/random.hpp"
#include "core/parallel/threads.hpp"
#include "imaging/distance.hpp"
#include "imaging/scalar.hpp"

namespace acinus::imaging {
namespace {

/// Part of the image, with the share of each voxel that one body fills.
struct BodyShare {
  Voxel low{};
  Grid grid;
};

Box box_of(const geometry::Surface& s) {
  Box box;
  for (const Vec3& x : s.node) box.include(x);
  return box;
}

/// Lines along x through every voxel, in y and in z: where a face is parallel to a lattice plane, a
/// share is accurate to half a line.
constexpr int kLines = 4;

/// Adds a segment of a line, from and to in voxels, to the voxels along it.
void add_interval(double from, double to, Grid& g, std::size_t first) {
  constexpr double kWeight = 1.0 / (kLines * kLines);
  from = std::max(from, 0.0);
  to = std::min(to, static_cast<double>(g.size[0]));
  for (int x = static_cast<int>(from); x < to; ++x)
    g.value[first + x] +=
        kWeight * (std::min(to, x + 1.0) - std::max(from, static_cast<double>(x)));
}

/// Fills in the share of every voxel that is inside: lines along x are intersected with all
/// triangles, upward and downward crossings counted. Lines are slightly displaced from the lattice,
/// so that they miss nodes.
void fill_inside(const geometry::Surface& body, const Vec3& corner, BodyShare& share) {
  constexpr double kAside = 1.3e-7, kAsideZ = 0.7e-7;  // lines
  Grid& g = share.grid;
  const int n_y = kLines * g.size[1], n_z = kLines * g.size[2];
  const std::size_t stride = n_y;
  std::vector<std::vector<std::pair<double, int>>> crossing(n_z * stride);
  const auto line_of = [&](int y, int z) -> auto& { return crossing[z * stride + y]; };
  const Vec3 low(share.low[0], share.low[1], share.low[2]);
  const auto place = [&](const Vec3& x) -> Vec3 {  // x in voxels, y and z in lines, from the corner
    const Vec3 v = (x - corner).cwiseQuotient(g.voxel) - low;
    return {v[0], kLines * v[1] - 0.5 - kAside, kLines * v[2] - 0.5 - kAsideZ};
  };
  for (const auto& [i, j, k] : body.triangle) {
    const std::array<Vec3, 3> v{place(body.node[i]), place(body.node[j]), place(body.node[k])};
    const auto [y_low, y_high] = std::minmax({v[0][1], v[1][1], v[2][1]});
    const auto [z_low, z_high] = std::minmax({v[0][2], v[1][2], v[2][2]});
    const auto side = [&](const Vec3& a, const Vec3& b, double y, double z) {
      return (b[1] - a[1]) * (z - a[2]) - (b[2] - a[2]) * (y - a[1]);
    };
    const double area = side(v[0], v[1], v[2][1], v[2][2]);
    if (area == 0) continue;
    const int y_first = std::max(0, static_cast<int>(std::ceil(y_low))),
              y_last = std::min(n_y - 1, static_cast<int>(std::floor(y_high))),
              z_first = std::max(0, static_cast<int>(std::ceil(z_low))),
              z_last = std::min(n_z - 1, static_cast<int>(std::floor(z_high)));
    for (int z = z_first; z <= z_last; ++z)
      for (int y = y_first; y <= y_last; ++y) {
        const std::array<double, 3> w{side(v[1], v[2], y, z) / area, side(v[2], v[0], y, z) / area,
                                      side(v[0], v[1], y, z) / area};
        if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
        line_of(y, z).emplace_back(w[0] * v[0][0] + w[1] * v[1][0] + w[2] * v[2][0],
                                   area > 0 ? -1 : 1);
      }
  }
  for (int z = 0; z < n_z; ++z)
    for (int y = 0; y < n_y; ++y) {
      auto& line = line_of(y, z);
      std::ranges::sort(line);
      int winding = 0;
      for (std::size_t c = 0; c + 1 < line.size(); ++c) {
        winding += line[c].second;
        if (winding > 0)
          add_interval(line[c].first, line[c + 1].first, g, g.index({0, y / kLines, z / kLines}));
      }
    }
}

/// Correlated noise at every voxel, with a grain of one voxel and standard deviation 1.
Grid make_grain(const Grid& like, std::uint64_t seed, std::uint64_t body) {
  constexpr double kGrain = 1;  // voxels
  Grid grain = like;
  UniformStream random(seed, Purpose::kImage, body);
  for (double& v : grain.value) v = random.normal();
  smooth(Vec3::Constant(kGrain), grain);
  double square = 0;
  for (const double v : grain.value) square += v * v;
  const double scale = std::sqrt(static_cast<double>(grain.value.size()) / square);
  for (double& v : grain.value) v *= scale;
  return grain;
}

BodyShare make_share(const geometry::Surface& body, std::uint64_t number, const Vec3& corner,
                     const Voxel& size, const Voxelise& how) {
  constexpr double kReach = 3;  // standard deviations of the blur
  const Box box = box_of(body).grown(kReach * how.blur);
  BodyShare share;
  share.grid.voxel = how.voxel;
  for (int k = 0; k < 3; ++k) {
    const int low = static_cast<int>(std::floor((box.low[k] - corner[k]) / how.voxel[k])) - 1,
              high = static_cast<int>(std::ceil((box.high[k] - corner[k]) / how.voxel[k])) + 1;
    share.low[k] = std::clamp(low, 0, size[k] - 1);
    share.grid.size[k] = std::clamp(high, 0, size[k] - 1) - share.low[k] + 1;
  }
  share.grid.value.resize(share.grid.n_voxel());
  fill_inside(body, corner, share);
  if (how.blur > 0) smooth(how.blur * how.voxel.cwiseInverse(), share.grid);
  if (how.noise > 0) {
    const Grid grain = make_grain(share.grid, how.seed, number);
    for (std::size_t k = 0; k < grain.value.size(); ++k) {
      double& v = share.grid.value[k];
      v += how.noise * 4 * v * (1 - v) * grain.value[k];
    }
  }
  return share;
}

}  // namespace

VoxelisedBodies voxelise(std::span<const geometry::Surface> bodies, const Voxelise& how) {
  constexpr const char* kName = "the image";
  constexpr std::size_t kAtOnce = 64;  // bodies whose shares are in memory
  check(!bodies.empty(), "there is nothing to make an image of");
  Box box;
  for (const geometry::Surface& s : bodies)
    for (const Vec3& x : s.node) box.include(x);
  box = box.grown(how.margin);
  VoxelisedBodies out;
  out.corner = box.low;
  std::array<std::int64_t, 3> size{};
  for (int k = 0; k < 3; ++k) {
    constexpr double kMost = 1e9;
    const double n = std::ceil((box.high[k] - box.low[k]) / how.voxel[k]);
    size[k] = static_cast<std::int64_t>(std::clamp(n, 1.0, kMost));
    out.image.size[k] = static_cast<int>(size[k]);
  }
  const std::size_t n_voxel = count_voxels(kName, size);
  out.image.voxel = how.voxel;
  out.image.label.assign(n_voxel, 0);
  std::vector<float> largest(n_voxel, 0), sum(n_voxel, 0);
  for (std::size_t first = 0; first < bodies.size(); first += kAtOnce) {
    std::vector<BodyShare> share(std::min(kAtOnce, bodies.size() - first));
    for_each_part(share.size(), [&](std::size_t k) {
      share[k] = make_share(bodies[first + k], first + k, out.corner, out.image.size, how);
    });
    for (std::size_t b = 0; b < share.size(); ++b) {
      const Grid& g = share[b].grid;
      const Voxel& low = share[b].low;
      for (int z = 0; z < g.size[2]; ++z)
        for (int y = 0; y < g.size[1]; ++y)
          for (int x = 0; x < g.size[0]; ++x) {
            const std::size_t at = out.image.index({low[0] + x, low[1] + y, low[2] + z});
            const auto value = static_cast<float>(g.value[g.index({x, y, z})]);
            sum[at] += value;
            if (value <= largest[at]) continue;
            largest[at] = value;
            out.image.label[at] = static_cast<Label>(first + b + 1);
          }
    }
  }
  for (std::size_t k = 0; k < n_voxel; ++k)
    if (1 - sum[k] > largest[k]) out.image.label[k] = 0;
  return out;
}

}  // namespace acinus::imaging
