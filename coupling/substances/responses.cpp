#include "coupling/substances/responses.hpp"

#include <algorithm>
#include <cmath>

#include "core/numbers/hill.hpp"
#include "core/numbers/random.hpp"
#include "core/sphere.hpp"
#include "substances/sample.hpp"

namespace acinus::coupling {
namespace {

/// Relative difference of concentration across a leader at which it has half its force.
constexpr double kLeaderSensitivity = 0.01;

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

double signal_response(const SignalRule& r, double signal) {
  const double rises = hill(signal, r.half_max, r.power);
  return r.decreases ? 1 - rises : rises;
}

bool has_rule(const RuleParams& p, Behaviour behaviour) {
  return std::ranges::any_of(p.rule, [&](const SignalRule& r) { return r.behaviour == behaviour; });
}

bool has_measured_signal(const RuleParams& p) {
  return std::ranges::any_of(p.rule, [](const SignalRule& r) { return is_measured(r.signal); });
}

bool acts_on(const SignalRule& r, Behaviour behaviour, int type) {
  return r.behaviour == behaviour &&
         (r.type < 0 || r.type == type || (r.lysing_type >= 0 && r.lysing_type == type));
}

double age_of(const State& s, const Cell& c) {
  const double birth = c.index < s.cycle.size() ? s.cycle[c.index].birth : s.clock.origin;
  return s.clock.time - birth;
}

double own_signal(const RuleParams& p, std::size_t k, const State& s, const Cell& c) {
  if (p.rule[k].signal == Signal::kAge) return age_of(s, c);
  return s.signal.value.empty() ? 0 : s.signal.value[k][c.index];
}

void scale_growth(const World& world, const RuleSignals& signal, std::vector<double>& factor) {
  const std::vector<SignalRule>& rules = world.params.rules.rule;
  for_each_cell(world.state, [&](const Cell& c) {
    for (std::size_t k = 0; k < rules.size(); ++k)
      if (acts_on(rules[k], Behaviour::kGrowth, type_of(world.state, c)))
        factor[c.index] *= signal_response(rules[k], signal[k][c.index]);
  });
}

bool dies_of_signal(const World& world, const Cell& c, const RuleSignals& signal,
                    std::int64_t interval) {
  const std::vector<SignalRule>& rules = world.params.rules.rule;
  const LifeParams& life = world.params.life;
  for (std::size_t k = 0; k < rules.size(); ++k) {
    const SignalRule& r = rules[k];
    if (!acts_on(r, Behaviour::kDeath, type_of(world.state, c))) continue;
    const double rate = r.rate * signal_response(r, signal[k][c.index]);
    if (rate > 0 && uniform({life.seed, Purpose::kSignalDeath,
                             static_cast<std::uint64_t>(lineage_of(world.state, c)),
                             static_cast<std::uint64_t>(interval), static_cast<std::uint32_t>(k)}) <
                        -std::expm1(-rate * life.grid))
      return true;
  }
  return false;
}

ExchangeFactors exchange_factors(const RuleParams& p, int substance, int type, std::size_t index,
                                 const RuleSignals& signal) {
  ExchangeFactors factors;
  for (std::size_t k = 0; k < p.rule.size(); ++k) {
    const SignalRule& r = p.rule[k];
    if (r.of != substance) continue;
    if (acts_on(r, Behaviour::kSecretion, type))
      factors.secretion *= signal_response(r, signal[k][index]);
    if (acts_on(r, Behaviour::kUptake, type))
      factors.uptake *= signal_response(r, signal[k][index]);
  }
  return factors;
}

void update_guidance(const Params& p, State& s) {
  const SubstanceParams& fields = p.substances;
  const RuleParams& rules = p.rules;
  const bool adheres = has_rule(rules, Behaviour::kAdhesion);
  const bool moves = fields.leader_signal >= 0 || has_rule(rules, Behaviour::kChemotaxis) ||
                     has_rule(rules, Behaviour::kMotility);
  if (s.clock.phase != Phase::kRun || !(moves || adheres)) return;
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  if (moves) s.guidance.assign(n_cell, Guidance{});
  if (adheres) s.adhesion.assign(n_cell, 1.0);
  for_each_cell(s, [&](const Cell& c) {
    const int type = type_of(s, c);
    const Vec3 center = center_of(s, c);
    const double radius = sphere_radius(volume_of(s, c).at(s.clock.time));
    const auto field = [&](int substance) -> const std::vector<double>& {
      return s.substance[substance].concentration;
    };
    if (fields.leader_signal >= 0)
      s.guidance[c.index].heading =
          sense(fields.grid, field(fields.leader_signal), center, radius, kLeaderSensitivity);
    for (std::size_t k = 0; k < rules.rule.size(); ++k) {
      const SignalRule& r = rules.rule[k];
      const auto response = [&] {
        return signal_response(
            r, r.signal == Signal::kConcentration
                   ? substances::interpolate(fields.grid, field(r.substance), center)
                   : own_signal(rules, k, s, c));
      };
      if (acts_on(r, Behaviour::kMotility, type)) s.guidance[c.index].motility *= response();
      if (acts_on(r, Behaviour::kAdhesion, type)) s.adhesion[c.index] *= response();
      if (acts_on(r, Behaviour::kChemotaxis, type))
        s.guidance[c.index].force +=
            r.force * response() * sense(fields.grid, field(r.of), center, radius, r.sensitivity);
    }
  });
}

}  // namespace acinus::coupling
