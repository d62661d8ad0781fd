#include "substances/diffusion.hpp"

#include <algorithm>
#include <cmath>

#include "substances/membrane.hpp"
#include "substances/planes.hpp"

namespace acinus::substances {
namespace {

/// Michaelis-Menten rates are linearised anew until concentrations settle, so often at most.
constexpr int kMostLinearisations = 20;

/// Rate of exchange with a voxel side outside, 1/s: half a voxel in series with the face.
double face_rate(const FaceCondition& face, double diffusion, double h) {
  if (face.kind == FaceKind::kNoFlux || !(diffusion > 0)) return 0;
  const double resistance = 0.5 * h / diffusion;
  if (face.kind == FaceKind::kFixed) return 1 / (resistance * h);
  return face.coefficient > 0 ? 1 / ((1 / face.coefficient + resistance) * h) : 0;
}

std::array<double, 6> face_rates(const VoxelGrid& grid, const Medium& m) {
  std::array<double, 6> rate{};
  for (int side = 0; side < 6; ++side)
    rate[side] = face_rate(m.face[side], m.diffusion, grid.spacing[side / 2]);
  return rate;
}

/// Calls f(voxel, side, face) for every voxel at every face of the box.
template <class F>
void for_each_face_voxel(const VoxelGrid& grid, const F& f) {
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 3> at{};
    at[axis] = side % 2 == 0 ? 0 : grid.n[axis] - 1;
    for (at[v] = 0; at[v] < grid.n[v]; ++at[v])
      for (at[u] = 0; at[u] < grid.n[u]; ++at[u]) {
        std::array<int, 3> face = at;
        face[axis] += side % 2;
        f(grid.index(at[0], at[1], at[2]), side, grid.face_index(axis, face[0], face[1], face[2]));
      }
  }
}

/// Exchange linearised at a concentration: gain - loss c.
struct Linear {
  double gain, loss;
};
Linear linearise(const Exchange& e, double c) {
  Linear l{e.secretion, e.uptake};
  if (e.saturation > 0) l.loss += e.secretion / e.saturation;
  if (!(e.uptake_max > 0)) return l;
  const double at = std::max(c, 0.0), sum = e.half_max + at;
  l.loss += e.uptake_max * e.half_max / (sum * sum);
  l.gain -= e.uptake_max * at * at / (sum * sum);
  return l;
}

/// Calls f(body, share, exchange) for every share of a body that exchanges.
template <class F>
void for_each_exchange(const ExchangingBodies& bodies, const F& f) {
  for (std::size_t b = 0; b < bodies.exchange.size(); ++b)
    if (bodies.exchange[b].acts())
      for (const VoxelShare& s : bodies.shares.of(b)) f(b, s, bodies.exchange[b]);
}

/// One substance during one call.
class Stepper {
 public:
  Stepper(const VoxelGrid& grid, const Medium& medium, const ExchangingBodies& bodies,
          const Advance& how, Solver& solver)
      : grid_(grid),
        medium_(medium),
        bodies_(bodies),
        tolerance_(how.tolerance),
        supply_(how.supply),
        rate_(face_rates(grid, medium)),
        space_(how.space),
        parts_(how.parts),
        permeability_(how.permeability),
        held_(how.held),
        solver_(solver),
        system_(solver.scratch().system),
        before_(solver.scratch().before),
        around_(solver.scratch().around) {
    for (const Exchange& e : bodies.exchange) nonlinear_ = nonlinear_ || e.uptake_max > 0;
    const std::size_t n = grid.n_voxel() + (parts_ == nullptr ? 0 : parts_->n());
    if (parts_ != nullptr) {
      capacity_ = space_->volume;
      for (const double volume : parts_->volume) capacity_.push_back(volume / grid.voxel_volume());
    }
    system_.own.resize(n);
    system_.rhs.resize(n);
    system_.open = space_ == nullptr ? nullptr : &space_->face;
  }

  void take(double step, std::span<double> c, std::span<double> gained, Budget& budget) {
    before_.assign(c.begin(), c.end());
    if (space_ != nullptr)
      for (std::size_t v = 0; v < before_.size(); ++v)
        before_[v] = held_.empty() ? open_fraction(v) * c[v] : held_[v];
    held_ = {};
    const double held = total_amount(grid_, before_);
    for (int k = 0; k < (nonlinear_ ? kMostLinearisations : 1); ++k) {
      if (nonlinear_) around_.assign(c.begin(), c.end());
      assemble(step);
      const SolveResult solved =
          parts_ == nullptr ? solver_.solve(system_, tolerance_, c)
                            : solve_parts(grid_, *parts_, {permeability_, medium_.diffusion, step},
                                          system_, tolerance_, c);
      ++budget.solves;
      budget.iterations += solved.iterations;
      budget.converged = solved.converged;
      if (!nonlinear_ || !solved.converged) break;
      if (is_settled(c)) break;
      budget.converged = k + 1 < kMostLinearisations;
    }
    account(step, c, gained, budget);
    budget.change += total_amount(grid_, c, open()) - held;
    ++budget.substeps;
  }

 private:
  /// Fraction of a voxel that each unknown fills.
  std::span<const double> open() const {
    if (parts_ != nullptr) return capacity_;
    return space_ == nullptr ? std::span<const double>{} : space_->volume;
  }
  double open_fraction(std::size_t at) const { return space_ == nullptr ? 1 : open()[at]; }
  /// Rate of exchange through a face of the box, 1/s.
  double rate_through(int side, std::size_t face) const {
    return space_ == nullptr ? rate_[side] : rate_[side] * space_->face[side / 2][face];
  }
  std::size_t open_voxel(std::size_t voxel) const {
    return space_ == nullptr ? voxel : space_->nearest[voxel];
  }

  /// Concentration at which rates are linearised; linear ones need none.
  double around(std::size_t voxel) const { return nonlinear_ ? around_[voxel] : 0; }

  /// Matrix and right-hand side of backward Euler, Michaelis-Menten rates linearised at around_.
  void assemble(double step) {
    for (int axis = 0; axis < 3; ++axis)
      system_.conductance[axis] =
          medium_.diffusion * step / (grid_.spacing[axis] * grid_.spacing[axis]);
    for (std::size_t v = 0; v < system_.own.size(); ++v)
      system_.own[v] = open_fraction(v) * (1 + step * medium_.decay);
    std::ranges::copy(before_, system_.rhs.begin());
    for_each_face_voxel(grid_, [&](std::size_t voxel, int side, std::size_t face) {
      const double rate = rate_through(side, face);
      system_.own[voxel] += step * rate;
      system_.rhs[voxel] += step * rate * supply_ * medium_.face[side].value;
    });
    if (!medium_.gain.empty())
      for (std::size_t v = 0; v < medium_.gain.size(); ++v) {
        system_.own[v] += step * open_fraction(v) * medium_.loss[v];
        system_.rhs[v] += step * supply_ * open_fraction(v) * medium_.gain[v];
      }
    for (std::size_t v = 0; v < medium_.wall_gain.size(); ++v) {
      system_.own[open_voxel(v)] += step * medium_.wall_loss[v];
      system_.rhs[open_voxel(v)] += step * supply_ * medium_.wall_gain[v];
    }
    const double scale = step / grid_.voxel_volume();
    for_each_exchange(bodies_, [&](std::size_t, const VoxelShare& s, const Exchange& e) {
      const Linear l = linearise(e, around(s.voxel));
      system_.own[s.voxel] += scale * s.volume * l.loss;
      system_.rhs[s.voxel] += scale * s.volume * l.gain;
    });
  }

  bool is_settled(std::span<const double> c) const {
    double largest = 0, change = 0;
    for (std::size_t v = 0; v < c.size(); ++v) {
      largest = std::max(largest, std::abs(c[v]));
      change = std::max(change, std::abs(c[v] - around_[v]));
    }
    // Newton's method squares the error: after a correction this small it is below the tolerance.
    return change <= std::pow(tolerance_, 2.0 / 3) * largest;
  }

  /// Adds the gains and losses of the step with the rates that were solved for.
  void account(double step, std::span<const double> c, std::span<double> gained, Budget& budget) {
    const double volume = grid_.voxel_volume();
    double secreted = 0, entered = 0, supplied = 0;
    for_each_exchange(bodies_, [&](std::size_t body, const VoxelShare& s, const Exchange& e) {
      const Linear l = linearise(e, around(s.voxel));
      const double amount = step * s.volume * (l.gain - l.loss * c[s.voxel]);
      secreted += amount;
      if (!gained.empty()) gained[body] += amount;
    });
    for_each_face_voxel(grid_, [&](std::size_t voxel, int side, std::size_t face) {
      entered += step * rate_through(side, face) * volume *
                 (supply_ * medium_.face[side].value - c[voxel]);
    });
    if (!medium_.gain.empty())
      for (std::size_t v = 0; v < medium_.gain.size(); ++v)
        supplied +=
            step * volume * open_fraction(v) * (supply_ * medium_.gain[v] - medium_.loss[v] * c[v]);
    for (std::size_t v = 0; v < medium_.wall_gain.size(); ++v)
      supplied += step * volume *
                  (supply_ * medium_.wall_gain[v] - medium_.wall_loss[v] * c[open_voxel(v)]);
    budget.secreted += secreted;
    budget.entered += entered;
    budget.supplied += supplied;
    budget.decayed += step * medium_.decay * total_amount(grid_, c, open());
  }

  const VoxelGrid& grid_;
  const Medium& medium_;
  const ExchangingBodies& bodies_;
  double tolerance_, supply_;
  std::array<double, 6> rate_;
  const OpenSpace* space_;
  const Parts* parts_;
  double permeability_;
  std::vector<double> capacity_;  ///< [n_voxel, then parts], with parts
  std::span<const double> held_;  ///< of the first substep
  bool nonlinear_ = false;
  Solver& solver_;
  StepSystem& system_;
  std::vector<double>&before_, &around_;  ///< [n_voxel]
};

}  // namespace

double exchange_rate(const Exchange& e, double c) {
  double rate = e.secretion - e.uptake * c;
  if (e.saturation > 0) rate -= e.secretion / e.saturation * c;
  if (e.uptake_max > 0) rate -= e.uptake_max * c / (e.half_max + std::max(c, 0.0));
  return rate;
}

void Budget::add(const Budget& o) {
  change += o.change;
  secreted += o.secreted;
  entered += o.entered;
  supplied += o.supplied;
  decayed += o.decayed;
  substeps += o.substeps;
  solves += o.solves;
  iterations += o.iterations;
  converged = converged && o.converged;
}

Budget advance(const VoxelGrid& grid, const Medium& medium, const ExchangingBodies& bodies,
               const Advance& how, Solver& solver, std::span<double> c, std::span<double> gained) {
  constexpr double kRoundOff = 1e-9;
  const double n =
      how.longest > 0 ? std::max(1.0, std::ceil(how.step / how.longest - kRoundOff)) : 1;
  Stepper stepper(grid, medium, bodies, how, solver);
  Budget budget;
  for (int k = 0; k < static_cast<int>(n); ++k) {
    Budget one;
    stepper.take(how.step / n, c, gained, one);
    budget.add(one);
  }
  return budget;
}

double total_amount(const VoxelGrid& grid, std::span<const double> c,
                    std::span<const double> open) {
  const std::size_t n = grid.n_voxel();
  if (open.empty())
    return grid.voxel_volume() * (sum_voxels(grid.n[2], c.first(n)) + sum_numbers(c.subspan(n)));
  return grid.voxel_volume() * (dot_voxels(grid.n[2], open.first(n), c.first(n)) +
                                dot_numbers(open.subspan(n), c.subspan(n)));
}

}  // namespace acinus::substances
