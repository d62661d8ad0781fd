#pragma once
/// Capillary network of a lobule: a sub-graph of the Delaunay graph of random branch points that
/// contains its minimum spanning tree, as in real sinusoid networks [Karschau2020].

#include <array>
#include <vector>

#include "core/vec.hpp"
#include "coupling/generate/domain.hpp"
#include "coupling/generate/random_source.hpp"

namespace acinus::coupling {

struct Sinusoids {
  std::vector<Vec3> node;  ///< um: branch points, then vein-wall nodes
  int n_branch = 0;        ///< branch points
  std::vector<std::array<int, 2>> segment;
  double length = 0;         ///< um
  double target_length = 0;  ///< um, vessel_fraction * volume / (pi r^2)
};

/// Makes the capillary network:
/// 1 Poisson-disk branch points: branch_density * volume of them, no two nearer than 0.78
///   branch_density^(-1/3), none within 2 um of a vein; wall nodes every 12 um of z on each vein.
/// 2 Delaunay edges with cost L [1 + 0.6 (1 - |cos|)], by the angle to the radial direction of
///   flow.
/// 3 The cheapest edge of each wall node, then Kruskal's spanning tree (a vein joins its wall
///   nodes) with at most 4 sinusoids at a node, more only where a part cannot be joined otherwise.
/// 4 The cheapest edges below 45 um between nodes of degree below 3, then below 4, up to the length
///   target. If it is not met, length < target_length.
///
/// Edges through a vein are used only if the tree cannot be joined without them.
Sinusoids make_sinusoids(const LobuleParameters& parameters, const Domain& domain,
                         const Uniform& uniform);

}  // namespace acinus::coupling
