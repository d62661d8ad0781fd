#include "geometry/audit_body.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "core/error.hpp"

namespace acinus::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Faces = std::vector<Triangle>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Faces::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point to_point(const Vec3& x) { return {x.x(), x.y(), x.z()}; }
Vec3 to_vec(const Point& p) { return {p.x(), p.y(), p.z()}; }

constexpr int kMaxRays = 64;

/// Test for a segment that passes through the interior of the triangle from one side to the other.
/// Only then does a crossing count exactly once in a parity. @pre the segment meets the triangle
/// and does not start on it
bool passes_through(const Point& from, const Point& to, const Triangle& t) {
  const auto turn = [&](int i, int j) {
    return CGAL::orientation(from, to, t.vertex(i), t.vertex(j));
  };
  const CGAL::Orientation first = turn(0, 1);
  return first != CGAL::COPLANAR && turn(1, 2) == first && turn(2, 0) == first;
}

/// Boxes in CGAL's algorithm, by pointer: it copies and sorts them.
struct BoxPointerTraits {
  using Box_parameter = const Box*;
  using NT = double;
  using ID = const Box*;
  static double min_coord(const Box* b, int axis) { return b->low[axis]; }
  static double max_coord(const Box* b, int axis) { return b->high[axis]; }
  static const Box* id(const Box* b) { return b; }
  static int dimension() { return 3; }
};

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double edges = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return edges > 0 ? 2 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / edges : 0.0;
}

}  // namespace

struct AuditBody::Surface {
  Faces face;
  std::vector<int> triangle;  ///< [n_face] triangle of each face
  std::vector<Point> node;
  Tree tree;
};

void for_each_meeting(std::span<const Box> box,
                      const std::function<void(std::size_t, std::size_t)>& f) {
  using Predicates = CGAL::Box_intersection_d::Predicate_traits_d<BoxPointerTraits, true>;
  constexpr std::ptrdiff_t kSweep = 500;  // so few are sorted along one axis and swept
  std::vector<const Box*> one(box.size());
  for (std::size_t k = 0; k < box.size(); ++k) one[k] = &box[k];
  std::vector<const Box*> other = one;
  const auto number_of = [&](const Box* b) { return static_cast<std::size_t>(b - box.data()); };
  CGAL::box_intersection_custom_predicates_d(
      one.begin(), one.end(), other.begin(), other.end(),
      [&](const Box* a, const Box* b) {
        const auto [i, j] = std::minmax({number_of(a), number_of(b)});
        f(i, j);
      },
      Predicates(), kSweep, CGAL::Box_intersection_d::COMPLETE);
}

std::vector<std::pair<int, int>> meeting_boxes(std::span<const Box> box) {
  std::vector<std::pair<int, int>> pair;
  for_each_meeting(box, [&](std::size_t i, std::size_t j) {
    pair.emplace_back(static_cast<int>(i), static_cast<int>(j));
  });
  std::ranges::sort(pair);
  return pair;
}

AuditBody::AuditBody(std::span<const Vec3> nodes, std::span<const std::array<int, 3>> triangles)
    : n_node(static_cast<int>(nodes.size())),
      triangle_(triangles),
      surface_(std::make_unique<Surface>()) {
  sample.assign(nodes.begin(), nodes.end());
  sample.reserve(nodes.size() + triangles.size() * 5 / 2);
  surface_->node.reserve(nodes.size());
  surface_->face.reserve(triangles.size());
  surface_->triangle.reserve(triangles.size());
  edge.reserve(triangles.size() * 3 / 2);
  for (const Vec3& x : nodes) surface_->node.push_back(to_point(x));
  if (nodes.empty()) return;
  box = segment_box(nodes[0], nodes[0]);
  for (const Vec3& x : nodes) box.low = box.low.cwiseMin(x), box.high = box.high.cwiseMax(x);

  const auto node = [&](int i) -> const Vec3& { return nodes[i]; };
  const Vec3 origin = nodes[0];  // moments about a near point lose no digits
  Vec3 moment = Vec3::Zero();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [i, j, k] = triangles[t];
    const Vec3 a = node(i) - origin, b = node(j) - origin, c = node(k) - origin;
    const double part = a.dot(b.cross(c)) / 6;
    volume += part;
    moment += part * (a + b + c) / 4;
    quality = std::min(quality, triangle_quality(a, b, c));
    for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}})
      if (from < to) edge.push_back({from, to});  // its opposite belongs to the neighbour
    const Triangle face(to_point(node(i)), to_point(node(j)), to_point(node(k)));
    if (face.is_degenerate()) continue;
    surface_->face.push_back(face);
    surface_->triangle.push_back(static_cast<int>(t));
  }
  centroid = origin + (volume != 0 ? Vec3(moment / volume) : Vec3::Zero());
  for (const auto& [i, j] : edge) sample.push_back((node(i) + node(j)) / 2);
  for (const auto& [i, j, k] : triangles) sample.push_back((node(i) + node(j) + node(k)) / 3);

  surface_->tree.insert(surface_->face.cbegin(), surface_->face.cend());
  surface_->tree.build();
  surface_->tree.accelerate_distance_queries(surface_->node.begin(), surface_->node.end());
}

AuditBody::~AuditBody() = default;
AuditBody::AuditBody(AuditBody&&) noexcept = default;
AuditBody& AuditBody::operator=(AuditBody&&) noexcept = default;

Location AuditBody::locate(const Vec3& point) const {
  if (surface_->face.empty() || !box.contains(point)) return Location::kOutside;
  const Point p = to_point(point);
  const Vec3 size = box.high - box.low;
  // The first ray goes straight up or down, the cheapest to search; the others lean, by amounts
  // that no regular mesh repeats.
  const bool up = 2 * point.z() > box.low.z() + box.high.z();
  std::vector<Tree::Primitive_id> hit;
  for (int attempt = 0; attempt < kMaxRays; ++attempt) {
    Vec3 end(point.x(), point.y(), up ? box.high.z() + size.z() : box.low.z() - size.z());
    if (attempt > 0) {
      end.x() += size.x() * std::sin(1.7 * attempt);
      end.y() += size.y() * std::cos(2.3 * attempt);
    }
    hit.clear();
    surface_->tree.all_intersected_primitives(Kernel::Segment_3(p, to_point(end)),
                                              std::back_inserter(hit));
    bool clean = true, odd = false;
    for (const auto& face : hit) {
      if (face->has_on(p)) return Location::kOn;
      clean = clean && passes_through(p, to_point(end), *face);
      odd = !odd;
    }
    if (clean) return odd ? Location::kInside : Location::kOutside;
  }
  ACINUS_ASSERT(
      false);  // every ray met an edge: impossible for a finite number of edges in practice
  return Location::kOutside;
}

Vec3 AuditBody::closest_point(const Vec3& point) const {
  return to_vec(surface_->tree.closest_point(to_point(point)));
}

std::vector<double> AuditBody::crossings(const Vec3& a, const Vec3& b) const {
  std::vector<double> parameter;
  if (surface_->face.empty() || !box.overlaps(segment_box(a, b)) || a == b) return parameter;
  std::vector<Tree::Primitive_id> hit;
  surface_->tree.all_intersected_primitives(Kernel::Segment_3(to_point(a), to_point(b)),
                                            std::back_inserter(hit));
  for (const auto& face : hit) {
    const Vec3 p = to_vec(face->vertex(0));
    const Vec3 normal = (to_vec(face->vertex(1)) - p).cross(to_vec(face->vertex(2)) - p);
    const double from = (a - p).dot(normal), to = (b - p).dot(normal);
    if (from != to) parameter.push_back(std::clamp(from / (from - to), 0.0, 1.0));
  }
  std::sort(parameter.begin(), parameter.end());
  return parameter;
}

bool AuditBody::self_intersects() const {
  std::vector<Box> boxes;
  for (const Triangle& face : surface_->face) {
    const CGAL::Bbox_3 b = face.bbox();
    boxes.push_back({{b.xmin(), b.ymin(), b.zmin()}, {b.xmax(), b.ymax(), b.zmax()}});
  }
  // A segment opposite to a shared corner; the edges at that corner meet the other triangle anyway.
  const auto opposite = [&](const std::array<int, 3>& t, int corner) {
    std::vector<Point> end;
    for (const int i : t)
      if (i != corner) end.push_back(surface_->node[i]);
    return Kernel::Segment_3(end[0], end[1]);
  };
  for (const auto& [i, j] : meeting_boxes(boxes)) {
    const std::size_t f = i, g = j;
    const auto& t = triangle_[surface_->triangle[f]];
    const auto& u = triangle_[surface_->triangle[g]];
    int n_shared = 0, corner = -1;
    for (const int a : t)
      for (const int b : u)
        if (a == b) ++n_shared, corner = a;
    const Triangle &first = surface_->face[f], &second = surface_->face[g];
    if (n_shared == 0 && CGAL::do_intersect(first, second)) return true;
    if (n_shared == 1 && (CGAL::do_intersect(opposite(t, corner), second) ||
                          CGAL::do_intersect(opposite(u, corner), first)))
      return true;
  }
  return false;
}

bool AuditBody::closed() const {
  std::vector<std::pair<int, int>> there, back;
  for (const auto& [i, j, k] : triangle_)
    for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, k}, std::pair{k, i}}) {
      there.emplace_back(from, to);
      back.emplace_back(to, from);
    }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  return there == back && std::adjacent_find(there.begin(), there.end()) == there.end();
}

}  // namespace acinus::geometry
