#include "coupling/measure/audit_queries.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <optional>

#include "core/parallel/threads.hpp"
#include "core/sort_unique.hpp"

namespace acinus::coupling {
namespace {

using Partner = AuditPartner;

/// Number of queries whose bodies are built and dropped together.
constexpr std::size_t kBatch = 256;

double sphere_depth(const geometry::AuditBody& cell, const AuditSphere& sphere) {
  const double distance = cell.distance(sphere.center);
  const double sign = cell.locate(sphere.center) == geometry::Location::kInside ? 1 : -1;
  return sphere.radius + sign * distance;
}

/// Place of each cell in a sweep along the longest axis of the tissue.
std::vector<std::size_t> sweep_places(std::span<const Box> box) {
  Box all;
  for (const Box& b : box) {
    all.include(b.low);
    all.include(b.high);
  }
  int axis = 0;
  if (!box.empty()) (all.high - all.low).maxCoeff(&axis);
  std::vector<std::size_t> order(box.size()), place(box.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t c) { return box[c].low[axis]; });
  for (std::size_t k = 0; k < order.size(); ++k) place[order[k]] = k;
  return place;
}

/// Bodies of the cells, built for the queries that need them.
class SweptBodies {
 public:
  explicit SweptBodies(const AuditFrame& frame)
      : frame_(frame), cell_(frame.meshes.size()), last_(frame.meshes.size(), 0) {}

  /// States that query number k needs the bodies of these cells; later queries come later.
  void expect(const AuditQuery& q, std::size_t k) {
    for_cells(q, [&](auto c) { last_[c] = k; });
  }

  /// Builds the bodies that queries need and lack.
  void build(std::span<const AuditQuery* const> queries) {
    std::vector<std::size_t> missing;
    for (const AuditQuery* q : queries)
      for_cells(*q, [&](std::size_t c) {
        if (!cell_[c]) missing.push_back(c);
      });
    sort_unique(missing);
    for_each_part(missing.size(), [&](std::size_t k) {
      const AuditMesh& mesh = frame_.meshes[missing[k]];
      cell_[missing[k]].emplace(mesh.node, mesh.triangle);
    });
    built_.insert(built_.end(), missing.begin(), missing.end());
  }

  /// Drops the bodies that no query from number k on needs.
  void drop(std::size_t k) {
    std::erase_if(built_, [&](std::size_t c) {
      if (last_[c] >= k) return false;
      cell_[c].reset();
      return true;
    });
  }

  const geometry::AuditBody& operator[](std::size_t c) const { return *cell_[c]; }

 private:
  template <class F>
  static void for_cells(const AuditQuery& q, const F& f) {
    f(q.a);
    if (q.partner == Partner::kCell) f(q.b);
  }

  const AuditFrame& frame_;
  std::vector<std::optional<geometry::AuditBody>> cell_;
  std::vector<std::size_t> last_;   ///< [cell] last query that needs it
  std::vector<std::size_t> built_;  ///< cells
};

AuditAnswer answer(const AuditFrame& frame, const SweptBodies& cells,
                   std::span<const RoundCone> cone, const AuditQuery& q) {
  const geometry::AuditBody& a = cells[q.a];
  switch (q.partner) {
    case Partner::kNone:
      return {0, a.volume, a.quality, a.self_intersects()};
    case Partner::kCell:
      return {body_depth(a, cells[q.b])};
    case Partner::kSphere:
      return {sphere_depth(a, frame.spheres[q.b])};
    case Partner::kCone:
      return {vessel_depth(a, cone[q.b])};
    case Partner::kFixed:
      return {body_depth(a, frame.static_meshes[q.b].body)};
    case Partner::kEnvelope: {
      const geometry::AuditBody& fixed = frame.static_meshes[q.b].body;
      return {std::max(surface_depth(a, fixed, geometry::Location::kOutside),
                       surface_depth(fixed, a, geometry::Location::kInside))};
    }
    case Partner::kVesselSurface:
      return {body_depth(a, *frame.vessel_surface)};
  }
  return {};
}

}  // namespace

std::vector<AuditAnswer> answer_queries(const AuditFrame& frame, std::span<const Box> box,
                                        std::span<const RoundCone> cone,
                                        std::span<const AuditQuery> query) {
  const std::vector<std::size_t> place = sweep_places(box);
  std::vector<std::uint32_t> order(query.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t k) {
    const AuditQuery& q = query[k];
    return q.partner == Partner::kCell ? std::max(place[q.a], place[q.b]) : place[q.a];
  });

  SweptBodies cells(frame);
  for (std::size_t k = 0; k < query.size(); ++k) cells.expect(query[order[k]], k);
  std::vector<AuditAnswer> all(query.size());
  std::vector<const AuditQuery*> batch;
  for (std::size_t from = 0; from < query.size(); from += kBatch) {
    const std::size_t to = std::min(from + kBatch, query.size());
    batch.clear();
    for (std::size_t k = from; k < to; ++k) batch.push_back(&query[order[k]]);
    cells.drop(from);
    cells.build(batch);
    for_each_part(batch.size(), [&](std::size_t k) {
      all[order[from + k]] = answer(frame, cells, cone, *batch[k]);
    });
  }
  return all;
}

}  // namespace acinus::coupling
