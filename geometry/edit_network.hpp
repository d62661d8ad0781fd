#pragma once
/// Scaling, cropping and smoothing of vessel networks. All return a new network.

#include <array>

#include "geometry/network.hpp"

namespace acinus::geometry {

/// Transformation of a network, applied in this order: unit * scale on positions and radii,
/// radius_scale on radii, then the bounding box centre to the origin when `center`, then the shift.
struct NetworkTransform {
  double unit = 1;          ///< um per file unit
  double scale = 1;         ///< factor on positions and radii
  double radius_scale = 1;  ///< further factor on radii
  bool center = false;
  Vec3 shift = Vec3::Zero();  ///< um
};
/// Transformed network. Throws Error when a factor is not a finite number above 0 or the shift is
/// not finite.
Network transform_network(const Network& network, const NetworkTransform& transform);

/// Network of the segments whose centre line has a point inside the box (low corner, high corner;
/// the faces belong to it), each kept whole, and of the nodes they use, in their order. Throws
/// Error when low exceeds high.
Network crop_network(const Network& network, const std::array<Vec3, 2>& box);

/// Removes needless short segments. Nodes with equal coordinates become one; segments of no length
/// and repeated ones disappear. Then, along each chain between nodes that are not of degree 2, a
/// node is dropped when the segment from the last one kept would be shorter than half its mean
/// radius. Branch points and ends stay where they are, so a whole chain shorter than that stays as
/// one segment; every dropped node lies within half a radius of a kept one. A merged segment takes
/// the outer radii of its parts, shifted so that its mean radius is their mean weighted by length;
/// where that would put an end below all its parts, their smallest, and the mean is larger.
/// Networks without short segments keep their segments, in the order of the chains.
Network resample_network(const Network& network);

/// Network with segments longer than `longest`, um, cut into equal parts; radii run on linearly.
/// Nodes and segments keep their numbers; of a cut segment the first part has the number. Throws
/// Error when `longest` is not above 0.
Network split_network(const Network& network, double longest);

}  // namespace acinus::geometry
