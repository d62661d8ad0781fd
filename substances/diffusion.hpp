#pragma once
/// Diffusion, decay and exchange with bodies: one substance advanced in time.
///
/// dc/dt = D lap c - k c + sum over bodies of share / voxel volume * rate(c), finite volumes on the
/// grid (second order in space), backward Euler in time (first order, unconditionally stable,
/// positive). Amounts are concentrations times um^3.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "substances/grid.hpp"
#include "substances/shares.hpp"
#include "substances/solve.hpp"

namespace acinus::substances {

enum class FaceKind : std::uint8_t { kNoFlux, kFixed, kExchange };

/// Condition on one face of the box.
struct FaceCondition {
  FaceKind kind = FaceKind::kNoFlux;
  double value = 0;        ///< concentration outside
  double coefficient = 0;  ///< um/s, kExchange: flux into the box = coefficient (value - c at face)
};

struct Medium {
  double diffusion = 0;                 ///< um^2/s
  double decay = 0;                     ///< 1/s
  std::array<FaceCondition, 6> face{};  ///< x low, x high, y low, y high, z low, z high
  /// Sources that stay in place, such as vessels: gain - loss c.  [n_voxel] or empty
  std::vector<double> gain;  ///< concentration / s
  std::vector<double> loss;  ///< 1/s
};

/// Exchange of a body with its surroundings per volume of the body, in concentration per s:
/// secretion (1 - c / saturation) - uptake c - uptake_max c / (half_max + c).
struct Exchange {
  double secretion = 0;   ///< concentration / s
  double saturation = 0;  ///< concentration at which secretion ends; 0: it never does
  double uptake = 0;      ///< 1/s
  double uptake_max = 0;  ///< concentration / s, Michaelis-Menten
  double half_max = 1;    ///< concentration of half that rate
  bool acts() const { return secretion > 0 || uptake > 0 || uptake_max > 0; }
};

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
};

/// Advances a field.
/// @param c       [n_voxel] concentration, changed
/// @param gained  [body] amount secreted minus taken up, added to; empty: not wanted
Budget advance(const VoxelGrid& grid, const Medium& medium, const ExchangingBodies& bodies,
               const Advance& how, Solver& solver, std::span<double> c, std::span<double> gained);

/// Amount in all voxels.
double total_amount(const VoxelGrid& grid, std::span<const double> c);

}  // namespace acinus::substances
