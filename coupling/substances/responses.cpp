#include "coupling/substances/responses.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers/random.hpp"
#include "core/sphere.hpp"
#include "substances/sample.hpp"

namespace acinus::coupling {
namespace {

bool concerns(const SignalRule& r, Behaviour behaviour, int type) {
  return r.behaviour == behaviour && (r.type < 0 || r.type == type);
}

/// Direction of a gradient, its length the share of the full effect.
Vec3 sense(const substances::VoxelGrid& grid, const std::vector<double>& field, const Vec3& center,
           double radius, double sensitivity) {
  const Vec3 gradient = substances::gradient_at(grid, field, center);
  const double steep = gradient.norm(), here = substances::interpolate(grid, field, center);
  if (!(steep > 0) || !(here > 0)) return Vec3::Zero();
  const double across = 2 * radius * steep / here;
  return across / (across + sensitivity) / steep * gradient;
}

}  // namespace

double signal_response(const SignalRule& r, double concentration) {
  const double x = std::pow(std::max(concentration, 0.0) / r.half_max, r.power);
  const double rises = std::isinf(x) ? 1 : x / (1 + x);
  return r.decreases ? 1 - rises : rises;
}

bool has_rule(const SubstanceParams& p, Behaviour behaviour) {
  return std::ranges::any_of(p.rule, [&](const SignalRule& r) { return r.behaviour == behaviour; });
}

void scale_growth(const World& world, const std::vector<std::vector<double>>& concentration,
                  std::vector<double>& factor) {
  for_each_cell(world.state, [&](const Cell& c) {
    for (const SignalRule& r : world.params.substances.rule)
      if (concerns(r, Behaviour::kGrowth, type_of(world.state, c)))
        factor[c.index] *= signal_response(r, concentration[r.signal][c.index]);
  });
}

bool dies_of_signal(const World& world, const Cell& c,
                    const std::vector<std::vector<double>>& concentration, std::int64_t interval) {
  const std::vector<SignalRule>& rules = world.params.substances.rule;
  const LifeParams& life = world.params.life;
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const SignalRule& r = rules[k];
    if (!concerns(r, Behaviour::kDeath, type_of(world.state, c))) continue;
    const double rate = r.rate * signal_response(r, concentration[r.signal][c.index]);
    if (rate > 0 && uniform({life.seed, Purpose::kSignalDeath,
                             static_cast<std::uint64_t>(lineage_of(world.state, c)),
                             static_cast<std::uint64_t>(interval), static_cast<std::uint32_t>(k)}) <
                        -std::expm1(-rate * life.grid))
      return true;
  }
  return false;
}

bool has_exchange_rule(const SubstanceParams& p) {
  return has_rule(p, Behaviour::kSecretion) || has_rule(p, Behaviour::kUptake);
}

ExchangeFactors exchange_factors(const SubstanceParams& p, int substance, int type,
                                 std::size_t index,
                                 const std::vector<std::vector<double>>& concentration) {
  ExchangeFactors factors;
  for (const SignalRule& r : p.rule) {
    if (r.of != substance) continue;
    if (concerns(r, Behaviour::kSecretion, type))
      factors.secretion *= signal_response(r, concentration[r.signal][index]);
    if (concerns(r, Behaviour::kUptake, type))
      factors.uptake *= signal_response(r, concentration[r.signal][index]);
  }
  return factors;
}

void update_guidance(const SubstanceParams& p, State& s) {
  if (p.leader_signal < 0 && !has_rule(p, Behaviour::kChemotaxis) &&
      !has_rule(p, Behaviour::kMotility))
    return;
  if (s.clock.phase != Phase::kRun) return;
  s.guidance.assign(s.dcm.n_lane() + s.cbm.n_cell(), Guidance{});
  for_each_cell(s, [&](const Cell& c) {
    const Vec3 center = center_of(s, c);
    const double radius = sphere_radius(volume_of(s, c).at(s.clock.time));
    Guidance& g = s.guidance[c.index];
    if (p.leader_signal >= 0)
      g.heading = sense(p.grid, s.substance[p.leader_signal].concentration, center, radius,
                        p.leader_sensitivity);
    for (const SignalRule& r : p.rule) {
      const std::vector<double>& field = s.substance[r.signal].concentration;
      if (concerns(r, Behaviour::kMotility, type_of(s, c)))
        g.motility *= signal_response(r, substances::interpolate(p.grid, field, center));
      if (!concerns(r, Behaviour::kChemotaxis, type_of(s, c))) continue;
      g.force += r.force * signal_response(r, substances::interpolate(p.grid, field, center)) *
                 sense(p.grid, field, center, radius, r.sensitivity);
    }
  });
}

}  // namespace acinus::coupling
