#pragma once
/// The linear system of one step, (Gamma/h + K) dx = F, as loads that the models add to.
///
/// Unknowns: blocks of eight lanes; a DCM group has one row per mesh node, eight spheres share a
/// block with a single row. Three neutral operators: lane blocks (pairs of points of one cell),
/// rank-one families (one vector per cell: volume, global area) and links (contact stencils between
/// any points).

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lanes.hpp"
#include "core/ranks.hpp"
#include "core/sym3.hpp"
#include "core/vec.hpp"

namespace acinus::solve {

/// Which pairs of points within one cell interact; shared by all cells with the same mesh.
struct BlockPattern {
  int n_point = 0;
  std::vector<std::array<int, 2>> pair;  ///< i < j
};

/// Eight cells with one pattern.
struct Block {
  const BlockPattern* pattern = nullptr;
  std::size_t first_row = 0;   ///< first point row
  std::size_t first_pair = 0;  ///< first pair row
};

/// One vector per cell with a non-negative coefficient: adds c g g^T. Covers blocks [0, n_block).
struct RankOne {
  std::vector<double> vector;       ///< [rows of the covered blocks][3][lane]
  std::vector<double> coefficient;  ///< [n_block][lane]
};

/// Contact stencils. Link l joins the points start[l] .. start[l+1]; its weights sum to 0 (a pair)
/// or to 1 (a contact with surroundings, which have no unknowns). The relative vector is r = sum w
/// x; the force on point k is w_k force, so action equals reaction by construction.
struct Links {
  std::vector<std::uint32_t> start{0};
  std::vector<Address> address;
  std::vector<double> weight;
  std::vector<Vec3> force;             ///< nN, on the side with positive weights
  std::vector<Sym3> stiffness;         ///< nN/um, positive semi-definite
  std::vector<Sym3> friction;          ///< nN s/um, positive semi-definite
  std::vector<std::uint8_t> external;  ///< 1: other side is surroundings
  std::vector<Vec3> normal;            ///< direction in which r opens the gap
  std::vector<double> gap;  ///< um, for judging a step; +infinity where depth does not matter

  std::size_t size() const { return force.size(); }
  void clear();
  /// Adds a link; the points are those pushed by add_point since the last close.
  void add_point(Address a, double w) {
    address.push_back(a);
    weight.push_back(w);
  }
  void close(const Vec3& f, const Sym3& k, const Sym3& g, bool is_external, const Vec3& opens,
             double gap_now);
  /// Appends all links of another list, in order.
  void append(const Links& other);
};

/// Loads of one step. The caller clears; models add.
struct System {
  std::vector<Block> block;
  std::size_t n_row = 0;       ///< point rows over all blocks
  std::size_t n_pair = 0;      ///< pair rows over all blocks
  double friction_scale = 1;   ///< 1/h, 1/s: what friction is multiplied by in the matrix
  double stiffness_scale = 1;  ///< 1: linearly implicit; 0: friction only (explicit Euler)

  std::vector<double> force;           ///< [n_row][3][lane] nN, forces inside and between cells
  std::vector<double> external_force;  ///< [n_row][3][lane] nN, migration and prescribed loads
  std::vector<double> medium;          ///< [n_row][lane] nN s/um, friction with the medium at rest
  std::vector<double> diagonal;        ///< [n_row][6][lane] nN/um
  std::vector<double> upper;           ///< [n_pair][9][lane] nN/um, block (i, j) of pair i < j
  std::vector<RankOne> rank_one;
  Links links;
  Halo halo;  ///< copies of unknowns owned by other ranks; nothing on one rank

  std::size_t n_dof() const { return n_row * kPointStride; }
};

/// Sizes all arrays for the given blocks (offsets are filled in) and clears them.
void set_blocks(System& system, std::vector<Block> blocks);

/// Zeroes every load; keeps capacity and scales.
void clear_loads(System& system);

/// The full matrix of link l: friction_scale * friction + stiffness_scale * stiffness.
inline Sym3 link_matrix(const System& system, std::size_t l) {
  return system.friction_scale * system.links.friction[l] +
         system.stiffness_scale * system.links.stiffness[l];
}

}  // namespace acinus::solve
