#pragma once
/// Representative liver lobule: vessels, mirror planes and hepatocyte seeds.

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
  int wanted_cells = 0;            ///< requested seeds; more than seeds.size() if they do not fit
  int n_branch_point = 0;
  double sinusoid_length = 0;         ///< um
  double sinusoid_target_length = 0;  ///< um
  double volume = 0;                  ///< um^3 between the planes
};

/// Makes a lobule. Veins run from -20 um to height + 20 um, which keeps their round ends away from
/// cells. Seeds are random darts: at least min_distance apart, sinusoid_radius + 4 um from sinusoid
/// axes, vein radius + 4 um from vein axes, initial_radius inside every plane, lesion_radius or
/// more from the vein axis. Sampling stops at the requested count or after 200 000 rejected darts
/// in a row. The result depends on the stream of random numbers alone; the network does not depend
/// on the requested count. Throws Error as make_domain does.
Lobule make_lobule(const LobuleParameters& parameters, const Uniform& uniform);

}  // namespace acinus::coupling
