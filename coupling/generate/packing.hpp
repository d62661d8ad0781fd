#pragma once
/// Regular starting positions, and a space-filling order that keeps neighbours close in memory.

#include <array>
#include <span>
#include <vector>

#include "core/vec.hpp"
#include "coupling/generate/random_source.hpp"

namespace acinus::coupling {

enum class Lattice { kFcc, kBcc };
enum class BoxPacking { kCubic, kHexagonal };

struct ClumpParameters {
  Lattice lattice = Lattice::kFcc;
  int count = 13;
  double spacing = 24;  ///< um between nearest neighbours
  double jitter = 0;    ///< um, radius of the ball of random displacements
};

/// Makes a clump: the `count` lattice points nearest the origin, nearest first (equal distances: by
/// z, y, x). Draws three numbers per point, in that order, only if jitter > 0. Throws Error if
/// count < 0, spacing <= 0 or jitter < 0.
std::vector<Vec3> make_clump(const ClumpParameters& parameters, const Uniform& uniform);

struct BoxParameters {
  BoxPacking packing = BoxPacking::kCubic;
  std::array<int, 3> count{3, 3, 3};  ///< along x, y, z
  double spacing = 24;                ///< um between nearest neighbours
  double jitter = 0;                  ///< um
};

/// Makes a box: count[0] x count[1] x count[2] points centred on the origin, x fastest. Hexagonal:
/// rows along x, shifted in turn, stacked as a close packing. Errors as make_clump.
std::vector<Vec3> make_box(const BoxParameters& parameters, const Uniform& uniform);

/// Indices of the points along a Hilbert curve through their bounding cube (2^16 steps per axis):
/// order[k] is the k-th point. Equal keys keep the given order. Points must be finite.
std::vector<int> space_filling_order(std::span<const Vec3> point);

}  // namespace acinus::coupling
