#pragma once
/// Exact geometric queries on one closed triangle surface. CGAL stays in the .cpp.

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/box.hpp"
#include "core/vec.hpp"

namespace acinus::geometry {

/// Calls f(i, j), i < j, for all boxes that overlap, in no particular order. Cost: n log^3 n.
void for_each_meeting(std::span<const Box> box,
                      const std::function<void(std::size_t, std::size_t)>& f);

/// Index pairs i < j of boxes that overlap, ascending.
std::vector<std::pair<int, int>> meeting_boxes(std::span<const Box> box);

enum class Location { kInside, kOn, kOutside };

/// Closed surface prepared for exact queries. The spans must outlive it. After construction all
/// members may be called from many threads.
class AuditBody {
 public:
  /// Builds the search tree. Triangles of zero area count in volume and quality but are not part of
  /// the surface.
  /// @pre all coordinates finite
  AuditBody(std::span<const Vec3> nodes, std::span<const std::array<int, 3>> triangles);
  ~AuditBody();
  AuditBody(AuditBody&&) noexcept;
  AuditBody& operator=(AuditBody&&) noexcept;

  Location locate(const Vec3& point) const;     ///< exact
  Vec3 closest_point(const Vec3& point) const;  ///< on the surface
  double distance(const Vec3& point) const { return (point - closest_point(point)).norm(); }
  /// Intersections of the segment a-b with the surface: parameters in [0, 1], sorted. The set of
  /// intersected triangles is exact; touching along a triangle's plane gives no parameter.
  std::vector<double> crossings(const Vec3& a, const Vec3& b) const;
  /// True if two triangles cross that share no edge. Costs far less than a test of all pairs.
  bool self_intersects() const;
  /// True if every directed edge has its opposite exactly once.
  bool closed() const;

  Box box;
  double volume = 0;             ///< signed, um^3
  Vec3 centroid = Vec3::Zero();  ///< of the volume
  double quality = 1;            ///< smallest triangle quality
  int n_node = 0;
  std::vector<std::array<int, 2>> edge;
  std::vector<Vec3> sample;  ///< nodes, then edge midpoints, then triangle centroids

 private:
  struct Surface;
  std::span<const std::array<int, 3>> triangle_;
  std::unique_ptr<Surface> surface_;
};

}  // namespace acinus::geometry
