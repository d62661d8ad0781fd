#pragma once
/// The representative liver lobule: vessels, mirror planes and hepatocyte seeds.

#include <vector>

#include "coupling/generate/domain.hpp"
#include "coupling/generate/random_source.hpp"
#include "geometry/network.hpp"

namespace acinus::coupling {

enum class VesselKind { kSinusoid, kCentralVein, kPortalVein };

struct Lobule {
  geometry::Network vessels;     ///< sinusoids, then the central vein, then the portal veins
  std::vector<VesselKind> kind;  ///< [n_segment]
  std::vector<MirrorPlane> planes;
  std::vector<Vec3> seeds;         ///< hepatocyte centres outside the lesion, um
  Vec3 axis_point = Vec3::Zero();  ///< the vein axis is vertical through it
  int wanted_cells = 0;            ///< more than seeds.size() if there was no room
  int n_branch_point = 0;
  double sinusoid_length = 0;         ///< um
  double sinusoid_target_length = 0;  ///< um
  double volume = 0;                  ///< um^3 between the planes
};

/// Veins run from -20 um to height + 20 um so that no cell meets their round ends.
/// Seeds are darts: at least min_distance apart, sinusoid_radius + 4 um from sinusoid axes, vein
/// radius
/// + 4 um from vein axes, initial_radius inside every plane, lesion_radius or more from the vein
/// axis. Throwing stops at the wanted count, or when 200 000 darts in a row found no room. Depends
/// on the stream of random numbers alone; the network does not depend on the wanted count. Throws
/// Error as make_domain does.
Lobule make_lobule(const LobuleParameters& parameters, const Uniform& uniform);

}  // namespace acinus::coupling
