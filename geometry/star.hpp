#pragma once
/// Star-shaped bodies: every ray from some inner point meets the surface exactly once.

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "core/vec.hpp"
#include "geometry/surface.hpp"

namespace acinus::geometry {

/// Smallest signed distance of a point from the planes of the faces, um, positive on their inner
/// side: the closed surface is star-shaped from the point if it is positive. Faces of no area are
/// skipped.
double compute_star_margin(const Surface& surface, const Vec3& point);

/// Point from which the closed surface is star-shaped with a margin of a hundredth of its volume
/// radius: the volume centroid if it has that margin, else one found by repeated steps away from
/// the nearest face plane. Nothing if there is none or it was not found.
std::optional<Vec3> find_star_center(const Surface& surface);

/// Intersection of a ray with the surface.
struct Hit {
  Vec3 point = Vec3::Zero();
  int triangle = 0;
};

/// Star-shaped surface prepared for rays from its centre.
class StarSurface {
 public:
  /// Prepares the surface. @pre compute_star_margin(surface, center) > 0, surface closed and
  /// oriented
  StarSurface(const Surface& surface, const Vec3& center);

  /// Casts a ray by a walk over the faces from `start`. Never misses: a ray through an edge or a
  /// node goes to one of the faces there. @param direction  of any length but zero
  Hit cast(const Vec3& direction, int start = 0) const;

  const Vec3& center() const { return center_; }
  const Vec3& normal(int triangle) const {  ///< outward, of length 1 or zero
    return face_[triangle].normal;
  }

 private:
  struct Face {
    Vec3 normal;
    std::array<Vec3, 3> corner;    // from the centre
    std::array<Vec3, 3> side;      // normals of the planes through the centre and the side opposite
                                   // to each corner, inward
    std::array<int, 3> neighbour;  // across that side
  };
  Hit cast_to_nearest(const Vec3& direction) const;
  Hit make_hit(const Vec3& weight, std::size_t face) const;

  Vec3 center_;
  std::vector<Face> face_;
};

}  // namespace acinus::geometry
