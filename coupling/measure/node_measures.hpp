#pragma once
/// Measures of nodes of the deformable cells, gathered at the root some cells at a time.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/parallel/ranks.hpp"
#include "core/vec.hpp"
#include "coupling/world/workspace.hpp"
#include "coupling/world/world.hpp"

namespace acinus::coupling {

/// Measures of a node of a cortex.
struct NodeValue {
  Vec3 position = Vec3::Zero();  ///< um
  Vec3 force = Vec3::Zero();     ///< nN, contact force
  double pressure = 0;           ///< kPa, normal contact traction, positive pressing inward
  double tension = 0;  ///< nN/um, cortex tension [VanLiedekerke2020, Eq. (8)] plus membrane
};

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::NodeValue> = true;
}  // namespace acinus

namespace acinus::coupling {

/// Calls `take` at the root with the nodes of all deformable cells, cell by cell in the order of
/// measure_cells, some cells at a time. Collective.   @pre observe
void visit_nodes(const World& world, const Workspace& work,
                 const std::function<void(std::span<const NodeValue>)>& take);

/// Calls `take` at the root with the nodes, um, of all nuclei, likewise. Collective.
void visit_nuclei(const World& world, const Workspace& work,
                  const std::function<void(std::span<const Vec3>)>& take);

/// Measures of all nodes, as visit_nodes() hands them over: at the root.
struct NodeMeasure {
  std::vector<Vec3> force;
  std::vector<double> pressure, tension;
};
NodeMeasure measure_nodes(const World& world, const Workspace& work);

}  // namespace acinus::coupling
