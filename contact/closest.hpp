#pragma once
/// The closest place on a surface to many points, eight pairs of point and triangle at a time.

#include <cstdint>
#include <span>

#include "contact/surface.hpp"

namespace acinus::contact {

/// um, more than floats lose on the distances of a list.
inline constexpr double kRounding = 1e-4;

/// Points that are looked up together. What is not listed as written by a function is filled in by
/// the caller.
struct alignas(64) PointBlock {
  static constexpr int kSize = 64;
  int n = 0;
  double x[3 * kSize];  ///< um, [point][component]
  std::uint32_t begin[kSize],
      end[kSize];  ///< candidates of each: at least one, the likeliest first
  // written by find_closest:
  int triangle[kSize];      ///< -1: nothing closer than the horizon
  double squared[kSize];    ///< um^2
  double weight_b[kSize];   ///< barycentric, of the second
  double weight_c[kSize];   ///< and the third corner
  float rounded[2][kSize];  ///< weights of the first two corners as the solver keeps them
  // written by find_gaps; numbers of no meaning where triangle is -1:
  double outward[3][kSize];  ///< unit normal of the surface, blended from the nodes
  double gap[kSize];         ///< um, negative inside
  double normal[3][kSize];   ///< unit, d gap / d x
};

/// Triangles that may be the closest, and a lower bound of the distance of each, um.
struct ListedTriangles {
  std::span<const int> triangle;
  std::span<const float> bound;
};

/// Closest of its candidate triangles to each point of the block; of triangles at the same distance
/// the one with the lowest number.
/// @param shift            um, how much closer than its bound a triangle may be
/// @param horizon          um: triangles as far as this are not found
/// @param distance         um, of each candidate, written for those closer by their bound than
///                         the closest and the shift; may be empty
void find_closest(const SurfaceBody& b, const ListedTriangles& candidates, double shift,
                  double horizon, PointBlock& block, std::span<float> distance = {});

enum class Place {
  kRounded,  ///< that which the rounded weights name
  kExact     ///< the closest place
};

/// Gap and normal of each point of the block, from the closest place. @pre find_closest
void find_gaps(const SurfaceBody& b, Place place, PointBlock& block);

}  // namespace acinus::contact
