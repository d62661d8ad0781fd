#include "imaging/label_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/box.hpp"
#include "core/error.hpp"
#include "core/parallel/memory.hpp"
#include "geometry/components.hpp"
#include "geometry/euler.hpp"
#include "geometry/implicit/extract.hpp"
#include "geometry/implicit/shape.hpp"
#include "geometry/measures.hpp"
#include "imaging/distance.hpp"

namespace acinus::imaging {
namespace {

constexpr std::size_t kMostTriangles = 2'000'000;

double volume_of(const geometry::Surface& s) {
  return geometry::compute_volume(s.node, s.triangle);
}

/// Throws Error if the distances in a box take more memory than there is.
void check_room(const Piece& piece, const Grid& grid) {
  constexpr double kBytes = 25;  // a voxel: one to mark it, three distances
  const double need = kBytes * static_cast<double>(grid.n_voxel()), memory = machine_memory();
  check(need <= memory,
        fmt::format("label {}: the surface of a piece that spans {} x {} x {} voxels takes {:.3g} "
                    "GB; this machine has {:.3g}. Crop the image, or make its voxels larger.",
                    piece.label, grid.size[0], grid.size[1], grid.size[2], 1e-9 * need,
                    1e-9 * memory));
}

/// Smoothed signed distance in and around the box of a piece.
Grid distance_about(const LabelRows& image, const Piece& piece, double smoothing) {
  const int margin = 2 + static_cast<int>(std::ceil(3 * smoothing));
  Grid grid;
  grid.voxel = image.voxel;
  Voxel low;
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = piece.low[k] - margin;
    grid.size[k] = piece.high[k] - piece.low[k] + 1 + 2 * margin;
  }
  grid.origin = image.center(low);
  check_room(piece, grid);
  std::vector<std::uint8_t> inside(grid.n_voxel());
  for (int z = piece.low[2]; z <= piece.high[2]; ++z)
    for (int y = piece.low[1]; y <= piece.high[1]; ++y) {
      const LabelLine& line = image.line[image.line_index(y, z)];
      const auto from = std::ranges::upper_bound(line, piece.low[0], {}, &LabelRow::end);
      for (std::size_t k = from - line.begin(); k < line.size(); ++k) {
        const int first = std::max(first_of(line, k), piece.low[0]);
        const int end = std::min(line[k].end, piece.high[0] + 1);
        if (first >= end) break;
        if (line[k].label == piece.label)
          std::fill_n(&inside[grid.index({first - low[0], y - low[1], z - low[2]})], end - first,
                      1);
      }
    }
  compute_signed_distance(inside, grid);
  smooth(Vec3::Constant(smoothing), grid);
  return grid;
}

/// Value of the grid below which a given volume lies: voxels within half their smallest side of the
/// wall count in part.
double find_level(const Grid& grid, double volume) {
  constexpr int kHalvings = 40;
  const double side = grid.voxel.minCoeff(), voxel = grid.voxel.prod();
  const auto [least, most] = std::ranges::minmax(grid.value);
  double low = least - side, high = most + side;
  for (int k = 0; k < kHalvings; ++k) {
    const double level = 0.5 * (low + high);
    double below = 0;
    for (const double v : grid.value) below += std::clamp(0.5 - (v - level) / side, 0.0, 1.0);
    (below * voxel < volume ? low : high) = level;
  }
  return 0.5 * (low + high);
}

/// Level surface of the grid; its largest part if it has several.
geometry::Surface surface_at(const Grid& grid, double level, double steepest, double edge) {
  geometry::Shape shape;
  shape.value = [&](const Vec3& x, std::span<const int>) { return grid.at(x) - level; };
  shape.distance = [&](const Vec3& x, int) { return (grid.at(x) - level) / steepest; };
  shape.size = {geometry::kTetrahedra * edge};
  shape.reach = {0};
  Box box;
  box.include(grid.origin);
  box.include(grid.origin +
              grid.voxel.cwiseProduct(Vec3(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1)));
  shape.box = {box};
  return geometry::extract_zero(shape, kMostTriangles).surface;
}

void scale_to(double volume, geometry::Surface& s) {
  const Vec3 middle = geometry::compute_centroid(s.node, s.triangle);
  const double factor = std::cbrt(volume / volume_of(s));
  for (Vec3& x : s.node) x = middle + factor * (x - middle);
}

}  // namespace

LabelSurface make_label_surface(const LabelRows& image, const Piece& piece, double edge,
                                double smoothing) {
  constexpr int kRounds = 4;
  constexpr double kNearly = 2e-3;  // of the volume; what is missing then is scaled
  const Grid grid = distance_about(image, piece, smoothing);
  const double steepest = std::max(1.0, compute_largest_slope(grid));
  LabelSurface out;
  out.volume = static_cast<double>(piece.n_voxel) * image.voxel_volume();
  // Where the distance rises by 1 um a um, the volume rises by the area.
  double level = find_level(grid, out.volume);
  std::vector<geometry::Surface> parts;
  for (int round = 0; round < kRounds; ++round) {
    const geometry::Surface all = surface_at(grid, level, steepest, edge);
    parts = geometry::split_components(all);
    const double missing = out.volume - volume_of(all);
    if (parts.empty() || std::abs(missing) < kNearly * out.volume) break;
    level += missing / geometry::compute_area(all.node, all.triangle);
  }
  check(!parts.empty(), fmt::format("label {}: its {} voxels are too few for a surface",
                                    piece.label, piece.n_voxel));
  std::ranges::stable_sort(parts, [](const geometry::Surface& a, const geometry::Surface& b) {
    return volume_of(a) > volume_of(b);
  });
  for (std::size_t k = 1; k < parts.size(); ++k) out.left_out += std::max(0.0, volume_of(parts[k]));
  out.surface = std::move(parts.front());
  scale_to(out.volume - out.left_out, out.surface);
  out.handles = geometry::compute_connectivity(out.surface).handles();
  return out;
}

}  // namespace acinus::imaging
