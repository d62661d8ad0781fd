#include "geometry/implicit/vessel_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "geometry/implicit/cavities.hpp"
#include "geometry/implicit/extract.hpp"
#include "geometry/implicit/fit.hpp"
#include "geometry/implicit/shape.hpp"
#include "geometry/implicit/vessel_field.hpp"
#include "geometry/implicit/vessel_gaps.hpp"
#include "geometry/implicit/vessel_pieces.hpp"
#include "geometry/implicit/zero_surface.hpp"
#include "geometry/remesh.hpp"
#include "geometry/segment_shape.hpp"

namespace acinus::geometry {
namespace {

constexpr std::size_t kMostTriangles = 20'000'000;

/// Throws Error for far more triangles than are allowed, which would take too long to count.
void check_extent(const geometry::Network& network, const VesselMeshOptions& o) {
  constexpr double kMargin = 10;  // the estimate is rough
  double all = 0, most = 0;
  std::size_t worst = 0;
  for (std::size_t s = 0; s < network.segment.size(); ++s) {
    const auto& [a, b] = network.segment[s];
    const double length = (network.node[b] - network.node[a]).norm();
    const double r = 0.5 * (network.radius[s][0] + network.radius[s][1]);
    // Triangles of side f r on 2 pi r L, each of half the square of it.
    const double n = 4 * kPi * length / (o.fineness * o.fineness * r);
    all += n;
    if (n > most) {
      most = n;
      worst = s;
    }
  }
  check(all <= kMargin * static_cast<double>(kMostTriangles),
        fmt::format(
            "the surface would have some {:.2g} triangles; at most {} are made. Segment {} "
            "alone needs {:.2g}: it is {:.4g} um long with a radius of {:.4g} um. Check "
            "its nodes and the unit of the file.",
            all, kMostTriangles, worst, most,
            (network.node[network.segment[worst][1]] - network.node[network.segment[worst][0]])
                .norm(),
            0.5 * (network.radius[worst][0] + network.radius[worst][1])));
}

void check_network(const geometry::Network& network) {
  check(!network.segment.empty(), "a network without segments has no surface");
  for (std::size_t s = 0; s < network.segment.size(); ++s)
    for (const double r : network.radius[s])
      check(
          std::isfinite(r) && r > 0,
          fmt::format("segment {} has the radius {} um; it must be a finite number above 0", s, r));
}

Shape make_shape(const VesselPieces& pieces, const VesselField& field) {
  Shape shape;
  shape.size = pieces.size;
  shape.value = [&](const Vec3& x, std::span<const int> parts) { return field.value(x, parts); };
  shape.distance = [&](const Vec3& x, int part) { return field.distance(x, part); };
  for (std::size_t k = 0; k < pieces.whole.size(); ++k) {
    shape.box.push_back(geometry::cone_box(pieces.network, k));
    shape.reach.push_back(field.crease_reach(static_cast<int>(k)));
  }
  return shape;
}

/// Search structure for the pieces that matter at a place near the surface: a grid of cubes.
class NearbyPieces {
 public:
  /// Sorts pieces into cubes. @param farthest  um, largest distance of a query from the surface
  NearbyPieces(const geometry::Network& pieces, const Shape& shape, double farthest) {
    std::vector<double> sizes = shape.size;
    std::ranges::nth_element(sizes, sizes.begin() + sizes.size() / 2);
    side_ = 2 * sizes[sizes.size() / 2];
    for (int s = 0; s < static_cast<int>(shape.box.size()); ++s) {
      const auto& [a, b] = pieces.segment[s];
      const Vec3 &from = pieces.node[a], along = pieces.node[b] - from;
      // Bit by bit: a box about all of a slanting piece is mostly empty.
      const double bits = std::ceil(along.norm() / side_);
      const double reach = shape.reach[s] + std::max(farthest, shape.size[s]);
      for (double k = 0; k < bits; ++k) {
        const auto& [ra, rb] = pieces.radius[s];
        const double t = (k + 0.5) / bits, half = 0.5 * along.norm() / bits;
        add(shape, s, sphere_box(from + t * along, ra + t * (rb - ra) + 2 * half + reach), reach);
      }
    }
  }
  std::span<const int> at(const Vec3& x) const {
    const auto found = cube_.find(place(x));
    return found == cube_.end() ? std::span<const int>{} : found->second;
  }

 private:
  using Place = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Place& p) const {
      std::size_t key = 0;
      for (const int k : p) key = (key ^ static_cast<std::uint32_t>(k)) * 0x9e3779b97f4a7c15u;
      return key;
    }
  };
  void add(const Shape& shape, int piece, const Box& box, double reach) {
    const double half_diagonal = 0.5 * std::sqrt(3.0) * side_;
    const Place low = place(box.low), high = place(box.high);
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x) {
          const double d = shape.distance(side_ * Vec3(x + 0.5, y + 0.5, z + 0.5), piece);
          if (std::abs(d) > reach + half_diagonal) continue;
          std::vector<int>& near = cube_[{x, y, z}];
          if (near.empty() || near.back() != piece) near.push_back(piece);
        }
  }
  Place place(const Vec3& x) const {
    const Vec3 v = (x / side_).array().floor();
    return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
  }
  double side_ = 0;
  std::unordered_map<Place, std::vector<int>, Hash> cube_;
};

/// Fits the triangles to the vessels' wall; where they cross each other then, nodes go back.
/// @return true if no triangles cross in the end
bool fit_without_crossing(const Distance& distance, geometry::Surface& surface) {
  constexpr double kMost = 0.3;
  constexpr int kRounds = 6;
  const std::vector<Vec3> before = surface.node;
  fit(distance, kMost, surface);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> crossing = geometry::find_crossing_triangles(surface);
    if (crossing.empty()) return true;
    // With all triangles about them.
    std::vector<char> back(before.size(), 0), wider;
    for (const int t : crossing)
      for (const int k : surface.triangle[t]) back[k] = 1;
    for (int ring = 0; ring < round; ++ring) {
      wider = back;
      for (const auto& corner : surface.triangle)
        if (std::ranges::any_of(corner, [&](int k) { return back[k] != 0; }))
          for (const int k : corner) wider[k] = 1;
      back = wider;
    }
    for (std::size_t k = 0; k < back.size(); ++k)
      if (back[k] != 0) surface.node[k] = before[k];
  }
  surface.node = before;
  return !geometry::crosses_itself(surface);
}

}  // namespace

VesselMesh make_vessel_mesh(const geometry::Network& network, const VesselMeshOptions& o) {
  constexpr double kFiner = 0.6;
  check_network(network);
  check_extent(network, o);
  VesselMesh out;
  out.expected = geometry::compute_connectivity(network);
  out.fineness = o.fineness;
  VesselPieces pieces;
  std::optional<VesselField> field;
  Shape shape;
  ZeroSurface raw;
  for (int attempt = 0; attempt < o.attempts; ++attempt) {
    const double of_radius = kTetrahedra * out.fineness;
    pieces = cut_vessels(network, of_radius);
    field.emplace(network, pieces, o.rounding);
    shape = make_shape(pieces, *field);
    VesselGaps gaps = find_narrow_gaps(network, o.rounding, of_radius);
    shape.fine = std::move(gaps.fine);
    out.overlapping = gaps.overlapping;
    // Loops may be narrower than the triangles. For walls that cross no triangle is small enough.
    const auto count_faults = [&](ZeroSurface& z) {
      remove_cavities(z);
      out.found = geometry::compute_connectivity(z.surface);
      if (out.overlapping > 0) return 0L;
      return std::abs(out.found.parts - out.expected.parts) +
             std::abs(out.found.handles() - out.expected.handles());
    };
    raw = extract_zero(shape, kMostTriangles, count_faults);
    out.found = geometry::compute_connectivity(raw.surface);
    if (out.is_as_expected() || out.overlapping > 0) break;
    if (attempt + 1 < o.attempts) out.fineness *= kFiner;
  }
  const NearbyPieces nearby(pieces.network, shape, o.edge);
  const Distance distance = [&](const Vec3& x) { return field->value(x, nearby.at(x)); };
  fit(distance, raw);
  out.surface = std::move(raw.surface);
  if (o.edge > 0) {
    geometry::Surface even = geometry::remesh(out.surface, o.edge);
    out.remeshed =
        geometry::compute_connectivity(even) == out.found && fit_without_crossing(distance, even);
    if (out.remeshed) out.surface = std::move(even);
  }
  return out;
}

std::string describe_connectivity(const VesselMesh& m) {
  const auto number = [](int n, const char* of) {
    return fmt::format("{} {}{}", n, of, n == 1 ? "" : "s");
  };
  return fmt::format(
      "the network has {} and {}, the surface {} and {}: {}", number(m.expected.parts, "part"),
      number(m.expected.handles(), "loop"), m.found.parts, m.found.handles(),
      m.overlapping > 0
          ? fmt::format("{} pairs of segments that share no node cross", m.overlapping)
          : std::string("vessels nearly touch, or a loop is nearly closed"));
}

}  // namespace acinus::geometry
