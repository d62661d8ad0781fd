#pragma once
/// Closest place on a surface to each of many points, for eight pairs of point and triangle at a
/// time.

#include <cstddef>
#include <cstdint>
#include <span>

#include "contact/candidate_list.hpp"
#include "contact/surface.hpp"

namespace acinus::contact {

/// Bound of the rounding error of single-precision distances in a list, um.
inline constexpr double kRounding = 1e-4;

/// Block of points that are searched together. The caller fills all members that no function is
/// listed to write.
struct alignas(64) PointBlock {
  static constexpr int kSize = 64;
  int n = 0;
  double x[3 * kSize];  ///< um, [point][component]
  std::uint32_t begin[kSize],
      end[kSize];  ///< range of candidates: at least one, the likeliest first
  // written by find_closest:
  int triangle[kSize];      ///< -1: none closer than the horizon
  double squared[kSize];    ///< um^2
  double weight_b[kSize];   ///< barycentric weight of the second corner
  double weight_c[kSize];   ///< barycentric weight of the third corner
  float rounded[2][kSize];  ///< weights of the first two corners as the solver stores them
  // written by compute_gaps; undefined where triangle is -1:
  double outward[3][kSize];  ///< unit normal of the surface, blended from the nodes
  double gap[kSize];         ///< um, negative inside
  double normal[3][kSize];   ///< unit, d gap / d x
};

/// Candidate triangles, and a lower bound of the distance of each, um.
struct ListedTriangles {
  std::span<const int> triangle;
  std::span<const float> bound;

  int triangle_at(std::size_t k) const { return triangle[k]; }
  float bound_at(std::size_t k) const { return bound[k]; }
};

/// Search for the closest candidate triangle of each point of the block. A tie goes to the lowest
/// triangle number.
/// @param shift     um, amount by which a triangle may be closer than its bound
/// @param horizon   um, distance from which on triangles are ignored
/// @param distance  um, [candidate] written for those whose bound is below the closest distance
///     plus the shift; may be empty
void find_closest(const SurfaceBody& b, const ListedTriangles& candidates, double shift,
                  double horizon, PointBlock& block, std::span<float> distance = {});
void find_closest(const SurfaceBody& b, const CandidateList& candidates, double shift,
                  double horizon, PointBlock& block);

enum class Place {
  kRounded,  ///< place given by the rounded weights
  kExact     ///< exact closest place
};

/// Gap and normal of each point of the block at its closest place. @pre find_closest
void compute_gaps(const SurfaceBody& b, Place place, PointBlock& block);

}  // namespace acinus::contact
