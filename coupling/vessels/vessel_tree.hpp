#pragma once
/// Flexible network of vessels: nodes with position and rotation, a beam per segment, rigid joints.
/// Not in [VanLiedekerke2020], whose vessels are rigid; E_sin and nu_sin are those of its Table 1.

#include <Eigen/Geometry>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/boundary.hpp"
#include "coupling/vessels/beam.hpp"
#include "geometry/network.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// Anchoring of the ends of the tree, the nodes with one segment.
enum class VesselAnchors { kEnds, kNone };

struct TubeMaterial {
  double young = contact::kVesselMaterial.young;      ///< kPa
  double poisson = contact::kVesselMaterial.poisson;  ///< 1
  double wall = 1;                                    ///< um, thickness
  double pressure = 0;                                ///< kPa, inside over outside
  double friction = 0.1;  ///< nN s/um^3, of the surface with its environment
};

/// Constants of a vessel tree. Without segments there is no tree and vessels are rigid.
struct VesselTree {
  geometry::Network rest;  ///< without pressure
  TubeMaterial material;
  std::vector<Tube> tube;             ///< [segment]
  std::vector<Beam> beam;             ///< [segment]
  std::vector<Mat3> frame;            ///< [segment] axis at rest and two directions across
  std::vector<double> friction;       ///< [node] nN s/um
  std::vector<double> turn_friction;  ///< [node] nN um s
  /// [node] 1: fixed in position and rotation, as are nodes without a segment
  std::vector<std::uint8_t> anchored;
  solve::BlockPattern pattern;  ///< nodes, then their rotations

  bool exists() const { return !rest.segment.empty(); }
  bool has_ends() const;  ///< true if a node has one segment
  std::size_t n_node() const { return rest.node.size(); }
};

VesselTree make_tree(geometry::Network rest, const TubeMaterial& material, VesselAnchors anchors);

/// State of a tree, as in checkpoints; empty without a tree.
struct TreeState {
  std::vector<Vec3> node;                    ///< um
  std::vector<Eigen::Quaterniond> rotation;  ///< relative to rest

  /// Number of rows of unknowns: position and rotation of every node.
  std::size_t n_row() const { return 2 * node.size(); }
};

TreeState at_rest(const VesselTree& tree);

/// Moves the tree, one body in the first lane of its block.
/// @param by  [n_row][3][lane] um, and rotations on a lever of 1 um
void move_tree(std::span<const double> by, TreeState& state);

/// Writes the positions of its unknowns; a rotation has the position of its node.
/// @param out  [n_row][3][lane] um
void copy_places(const TreeState& state, std::span<double> out);

/// Updates positions and radii of vessels from the tree. Without nodes in the state, as in a
/// subworld, vessels are unchanged.
void place_vessels(const VesselTree& tree, const TreeState& state, contact::Vessels& vessels);

/// Largest displacement of a node from rest, um.
double largest_displacement(const VesselTree& tree, const TreeState& state);

/// Adds forces, stiffness and friction of the tree to its block.
void add_tree_loads(const VesselTree& tree, const TreeState& state, const solve::Block& block,
                    solve::System& system);

}  // namespace acinus::coupling
