#include "core/implicit/vessel_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/implicit/extract.hpp"
#include "core/implicit/fit.hpp"
#include "core/implicit/vessel_field.hpp"
#include "core/implicit/vessel_pieces.hpp"
#include "core/mesh/remesh.hpp"
#include "core/mesh/segment_shape.hpp"

namespace acinus::implicit {
namespace {

/// Longest edge of the tetrahedra over the mean edge of the triangles that they are cut in.
constexpr double kTetrahedra = 4;

void check_network(const mesh::Network& network) {
  check(!network.segment.empty(), "a network without segments has no surface");
  for (std::size_t s = 0; s < network.segment.size(); ++s)
    for (const double r : network.radius[s])
      check(
          std::isfinite(r) && r > 0,
          fmt::format("segment {} has the radius {} um; it must be a finite number above 0", s, r));
}

Shape make_shape(const VesselPieces& pieces, const VesselField& field) {
  const mesh::Network& network = pieces.network;
  Shape shape;
  shape.size = pieces.size;
  shape.value = [&](const Vec3& x, std::span<const int> parts) { return field.value(x, parts); };
  shape.distance = [&](const Vec3& x, int part) { return field.distance(x, part); };
  shape.reach = field.widest_crease();
  for (std::size_t s = 0; s < network.segment.size(); ++s)
    shape.box.push_back(mesh::cone_box(network, s));
  return shape;
}

std::vector<double> usual_sizes(const mesh::Network& n, double fineness) {
  std::vector<double> size;
  for (const auto& [ra, rb] : n.radius) size.push_back(kTetrahedra * fineness * std::min(ra, rb));
  return size;
}

/// Which segments are near a place, looked up in cubes.
class NearbySegments {
 public:
  NearbySegments(const Shape& shape, double margin) {
    for (const Box& b : shape.box) side_ = std::max(side_, (b.high - b.low).maxCoeff());
    for (int s = 0; s < static_cast<int>(shape.box.size()); ++s) {
      const Box box = shape.box[s].grown(margin);
      const Place low = place(box.low), high = place(box.high);
      for (int z = low[2]; z <= high[2]; ++z)
        for (int y = low[1]; y <= high[1]; ++y)
          for (int x = low[0]; x <= high[0]; ++x) cube_[{x, y, z}].push_back(s);
    }
  }
  std::span<const int> at(const Vec3& x) const {
    const auto found = cube_.find(place(x));
    return found == cube_.end() ? std::span<const int>{} : found->second;
  }

 private:
  using Place = std::array<int, 3>;
  Place place(const Vec3& x) const {
    const Vec3 v = (x / side_).array().floor();
    return {static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2])};
  }
  double side_ = 0;
  std::map<Place, std::vector<int>> cube_;
};

/// Lays the triangles about the vessels' wall; where they cross each other then, nodes go back.
/// @return whether they do not cross each other in the end
bool fit_without_crossing(const Distance& distance, mesh::Surface& surface) {
  constexpr double kMost = 0.3;
  constexpr int kRounds = 6;
  const std::vector<Vec3> before = surface.node;
  fit(distance, kMost, surface);
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<int> crossing = mesh::find_crossing_triangles(surface);
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
  return !mesh::crosses_itself(surface);
}

}  // namespace

VesselMesh make_vessel_mesh(const mesh::Network& network, const VesselMeshOptions& o) {
  constexpr double kFiner = 0.6;
  check_network(network);
  VesselMesh out;
  out.expected = mesh::find_connectivity(network);
  out.fineness = o.fineness;
  VesselPieces pieces;
  std::optional<VesselField> field;
  Shape shape;
  for (int attempt = 0; attempt < o.attempts; ++attempt) {
    pieces = cut_vessels(network, usual_sizes(network, out.fineness));
    field.emplace(pieces.network, o.rounding);
    shape = make_shape(pieces, *field);
    out.surface = extract_zero(shape, o.most_triangles);
    out.found = mesh::find_connectivity(out.surface);
    // Loops may be narrower than the triangles; walls that cross no triangle is small enough for.
    if (out.is_as_expected() || pieces.overlapping > 0 || attempt + 1 == o.attempts) break;
    out.fineness *= kFiner;
  }
  out.overlapping = pieces.overlapping;
  const NearbySegments nearby(
      shape, field->widest_crease() + std::max(o.edge, *std::ranges::max_element(shape.size)));
  const Distance distance = [&](const Vec3& x) { return field->value(x, nearby.at(x)); };
  if (o.edge > 0) {
    mesh::Surface even = mesh::remesh(out.surface, o.edge);
    out.remeshed =
        mesh::find_connectivity(even) == out.found && fit_without_crossing(distance, even);
    if (out.remeshed) out.surface = std::move(even);
  }
  if (!out.remeshed) fit_without_crossing(distance, out.surface);
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

}  // namespace acinus::implicit
