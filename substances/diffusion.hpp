#pragma once
/// Diffusion, decay and exchange with bodies: one substance advanced in time.
///
/// dc/dt = D lap c - k c + sum over bodies of share / voxel volume * rate(c), finite volumes on the
/// grid (second order in space), backward Euler in time (first order, unconditionally stable,
/// positive). Amounts are concentrations times um^3.
///
/// With obstacles, c is the concentration of the open space. Voxels store c times their open
/// fraction, faces conduct D times their open fraction of the area. Decay and sources act on the
/// open fraction.
///
/// With parts, the substance is also inside bodies, behind membranes: unknowns of their own, whose
/// faces conduct D times the fraction of the area inside the body. A membrane lets through
/// permeability times area times the difference of concentrations. A closed voxel between
/// membranes is a cleft that holds nothing.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "substances/grid.hpp"
#include "substances/medium.hpp"
#include "substances/open_space.hpp"
#include "substances/parts.hpp"
#include "substances/shares.hpp"
#include "substances/solve.hpp"

namespace acinus::substances {

/// Rate of exchange at a concentration, concentration / s; positive: secretion.
double exchange_rate(const Exchange& exchange, double concentration);

/// Bodies and their exchange.
struct ExchangingBodies {
  const Shares& shares;
  std::span<const Exchange> exchange;  ///< [body]
};

/// Gains and losses of a substance, amounts.
struct Budget {
  double change = 0;    ///< of what the voxels hold
  double secreted = 0;  ///< net, by bodies
  double entered = 0;   ///< through the faces of the box
  double supplied = 0;  ///< net, by sources that stay in place
  double decayed = 0;
  std::int64_t substeps = 0, solves = 0, iterations = 0;
  bool converged = true;
  void add(const Budget& other);
};

struct Advance {
  double step = 0;       ///< s
  double longest = 0;    ///< s, longest substep; 0: the step
  double tolerance = 0;  ///< of the linear solver, relative to the right-hand side; also of the
                         ///< concentrations in Michaelis-Menten rates, relative to the largest
  double supply = 1;     ///< factor on the values of faces and the gain of sources
  const OpenSpace* space = nullptr;  ///< nullptr: all is open
  /// With `space`: [n_voxel] amounts at the start per volume of a voxel, 0 in closed voxels; empty:
  /// those of c.
  std::span<const double> held{};
  /// Insides of bodies; nullptr: none. c and held then go on with the parts, and so do the numbers
  /// of voxels in shares of bodies: n_voxel + part.
  const Parts* parts = nullptr;
  double permeability = 0;  ///< um/s, of membranes
};

/// Advances a field.
/// @param bodies  with obstacles, shares in open voxels
/// @param c       [n_voxel, then parts] concentration, changed; fill_closed gives closed voxels
/// their value
/// @param gained  [body] amount secreted minus taken up, added to; empty: not wanted
Budget advance(const VoxelGrid& grid, const Medium& medium, const ExchangingBodies& bodies,
               const Advance& how, Solver& solver, std::span<double> c, std::span<double> gained);

/// Amount in all voxels and parts.
/// @param c     [n_voxel, then parts]
/// @param open  fractions of a voxel that they fill; empty: all is open
double total_amount(const VoxelGrid& grid, std::span<const double> c,
                    std::span<const double> open = {});

}  // namespace acinus::substances
