#pragma once
/// A network of vessels as elastic tubes that cells bend: nodes with a place and a rotation, a beam
/// per segment, rigid joints. Not in [VanLiedekerke2020], whose vessels stand still; E_sin and
/// nu_sin are those of its Table 1.

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/boundary.hpp"
#include "coupling/vessels/beam.hpp"
#include "geometry/network.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// What holds the ends of the tree, nodes with one segment.
enum class VesselAnchors { kEnds, kNone };

struct TubeMaterial {
  double young = 0;     ///< kPa
  double poisson = 0;   ///< 1
  double wall = 0;      ///< um, thickness
  double pressure = 0;  ///< kPa, inside over outside
  double friction = 0;  ///< nN s/um^3, of the surface with what is around it
};

/// What does not change in a run. Without segments there is no tree: vessels stand still.
struct VesselTree {
  geometry::Network rest;  ///< without pressure
  TubeMaterial material;
  std::vector<Tube> tube;             ///< [segment]
  std::vector<Beam> beam;             ///< [segment]
  std::vector<Mat3> frame;            ///< [segment] axis at rest and two directions across
  std::vector<double> friction;       ///< [node] nN s/um
  std::vector<double> turn_friction;  ///< [node] nN um s
  /// [node] 1: neither moves nor turns. So are nodes without a segment, which nothing moves.
  std::vector<std::uint8_t> anchored;
  solve::BlockPattern pattern;  ///< nodes, then their rotations

  bool exists() const { return !rest.segment.empty(); }
  bool has_ends() const;  ///< nodes with one segment
  std::size_t n_node() const { return rest.node.size(); }
};

VesselTree make_tree(geometry::Network rest, const TubeMaterial& material, VesselAnchors anchors);

/// Where the nodes of a tree are: what a checkpoint holds. Empty without one.
struct TreeState {
  std::vector<Vec3> node;                    ///< um
  std::vector<Eigen::Quaterniond> rotation;  ///< from rest

  /// Of unknowns: a place and a rotation each.
  std::size_t n_row() const { return 2 * node.size(); }
};

TreeState at_rest(const VesselTree& tree);

/// The tree is one body, in the first lane of its block.
/// @param by  [n_row][3][lane] um, and rotations on a lever of 1 um
void move_tree(std::span<const double> by, TreeState& state);

/// The places of its unknowns; that of a rotation is its node's.
/// @param out  [n_row][3][lane] um
void copy_places(const TreeState& state, std::span<double> out);

/// Gives vessels the present places and radii of the tree. Without nodes in the state, as in a
/// subworld, they stay where they are.
void place_vessels(const VesselTree& tree, const TreeState& state, contact::Vessels& vessels);

/// Largest distance of a node from its place at rest, um.
double largest_displacement(const VesselTree& tree, const TreeState& state);

/// Adds forces, stiffness and friction of the tree to its block.
void add_tree_loads(const VesselTree& tree, const TreeState& state, const solve::Block& block,
                    solve::System& system);

}  // namespace acinus::coupling
