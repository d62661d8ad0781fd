#include "coupling/life/rules.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "core/numbers/random.hpp"
#include "core/numbers/time_grid.hpp"
#include "core/sphere.hpp"
#include "coupling/life/cell_cycle.hpp"
#include "coupling/life/density.hpp"
#include "coupling/life/proliferation.hpp"
#include "coupling/measure/measure.hpp"
#include "coupling/measure/signals.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/responses.hpp"

namespace acinus::coupling {
namespace {

constexpr double kDoubledShare = 1 - 1e-9;  ///< of twice the birth volume at division

bool has_doubled(const State& s, const Cell& c) {
  return volume_of(s, c).at(s.clock.time) >= 2 * s.cycle[c.index].birth_volume * kDoubledShare;
}

bool applies(const LifeParams& p, std::size_t number, const State& s, const Cell& c) {
  const LifeRule& r = p.rule[number];
  const double t = time_of(s);
  if (t < r.from || t >= r.until) return false;
  const std::int64_t lineage = lineage_of(s, c);
  const std::int64_t named = r.descendants ? s.cycle[c.index].founder : lineage;
  if (!r.cells.empty() && !std::ranges::binary_search(r.cells, named)) return false;
  if (r.inside && !r.inside(center_of(s, c))) return false;
  return r.share >= 1 || uniform({p.seed, Purpose::kLifeRule, static_cast<std::uint64_t>(lineage),
                                  number, 0}) < r.share;
}
bool applies_any(const LifeParams& p, bool die, const State& s, const Cell& c) {
  for (std::size_t k = 0; k < p.rule.size(); ++k)
    if (p.rule[k].die == die && applies(p, k, s, c)) return true;
  return false;
}

bool is_inhibited(const CycleParams& p) { return p.inhibition.by != InhibitedBy::kNothing; }
bool needs_loads(const CycleParams& p) {
  return p.inhibition.by == InhibitedBy::kPressure || p.inhibition.by == InhibitedBy::kVolume;
}

/// True if something is updated at every interval of the grid of life.
bool has_updates(const Params& p) {
  return !p.life.rule.empty() || p.life.proliferation || has_rule(p.rules, Behaviour::kGrowth) ||
         has_rule(p.rules, Behaviour::kDeath) || has_measured_signal(p.rules) ||
         std::ranges::any_of(p.life.type, is_inhibited);
}

/// Input of contact inhibition, [dcm lanes, then cbm cells]; sleepers included, since they may grow
/// at the end of a rule.
std::vector<Crowding> measure_crowding(const World& world, Workspace& work) {
  const State& s = world.state;
  std::vector<Crowding> now(s.cycle.size());
  const auto asks = [&](auto question) {
    return std::ranges::any_of(world.params.life.type, question);
  };
  if (asks([](const CycleParams& p) { return p.inhibition.by == InhibitedBy::kDensity; })) {
    const std::vector<double> density = local_densities(world);
    for (std::size_t k = 0; k < now.size(); ++k) now[k].density = density[k];
  }
  if (!asks(needs_loads)) return now;
  observe(world, work);
  const std::vector<CellMeasure> measured = measure_cells(world, work);
  std::size_t k = 0;
  for_each_cell(s, [&](const Cell& c) {
    const CellMeasure& m = measured[k++];
    now[c.index].pressure = m.pressure;
    now[c.index].relative_volume = m.volume / sphere_volume(m.radius);
  });
  return now;
}

/// Relative growth rates, [dcm lanes, then cbm cells].
std::vector<double> growth_factors(const World& world, Workspace& work) {
  const State& s = world.state;
  std::vector<double> factor(s.cycle.size(), 1.0);
  if (std::ranges::none_of(world.params.life.type, is_inhibited)) return factor;
  const std::vector<Crowding> now = measure_crowding(world, work);
  for_each_cell(s, [&](const Cell& c) {
    factor[c.index] = growth_factor(cycle_of(world.params, s, c).inhibition, now[c.index]);
  });
  return factor;
}

void look_at_rules(World& world, Workspace& work, Plan& plan) {
  State& s = world.state;
  const LifeParams& p = world.params.life;
  const std::int64_t now = grid_interval(time_of(s), p.grid);
  if (now == s.life_interval) return;
  s.life_interval = now;
  std::vector<double> factor = growth_factors(world, work);
  refresh_signals(world, work);
  const bool signals_growth = has_rule(world.params.rules, Behaviour::kGrowth);
  constexpr Behaviour kLife[] = {Behaviour::kGrowth, Behaviour::kDeath};
  const RuleSignals signal = rule_signals(world, kLife);
  if (signals_growth) scale_growth(world, signal, factor);
  if (p.proliferation) let_proliferate(world, factor);
  for_each_cell(s, [&](const Cell& c) {
    Cycle& cycle = s.cycle[c.index];
    if (cycle.fate == Fate::kLyse) return;
    if (applies_any(p, true, s, c) || dies_of_signal(world, c, signal, now)) {
      (cycle_of(world.params, s, c).death.lysis ? plan.lyse : plan.remove).push_back(c);
      return;
    }
    if (cycle.duration > 0 && (is_inhibited(cycle_of(world.params, s, c)) || !p.rule.empty() ||
                               p.proliferation || signals_growth))
      set_growth(world.params, s, c, factor[c.index]);
  });
}

bool is_due_to_divide(const State& s, const Cell& c) {
  const Cycle& cycle = s.cycle[c.index];
  return cycle.fate == Fate::kGrow && s.clock.time >= cycle.wait_until && has_doubled(s, c);
}
bool is_due_to_go(const State& s, const Cell& c) {
  return s.cycle[c.index].fate == Fate::kLyse && s.clock.time >= volume_of(s, c).end;
}

/// Cell that divides or is removed, by its index in [dcm lanes, then cbm cells].
struct DueCell {
  std::size_t index = 0;
  bool divides = false;
};

/// Adds the spheres of other processes: each knows the clocks of its own. Collective.
void share_due_spheres(const World& world, std::vector<DueCell>& due) {
  const auto first = std::ranges::find_if(
      due, [&](const DueCell& d) { return d.index >= world.state.dcm.n_lane(); });
  std::vector<DueCell> all;
  world.ranks.gather<DueCell>(std::span(first, due.end()), all);
  std::ranges::sort(all, {}, &DueCell::index);
  due.erase(first, due.end());
  due.insert(due.end(), all.begin(), all.end());
}

void look_at_clocks(const World& world, Plan& plan) {
  const State& s = world.state;
  std::vector<std::uint8_t> dies;
  if (!plan.empty()) dies.assign(s.cycle.size(), 0);
  for (const std::vector<Cell>* list : {&plan.remove, &plan.lyse})
    for (const Cell& c : *list) dies[c.index] = 1;
  std::vector<DueCell> due;
  for_each_cell(s, [&](const Cell& c) {
    if (!dies.empty() && dies[c.index] != 0)
      return;  // a rule took it just now: it does not divide any more
    if (!c.deformable && s.near_set != 0 && s.cell_holder[c.index] != world.ranks.rank()) return;
    if (const bool divides = is_due_to_divide(s, c); divides || is_due_to_go(s, c))
      due.push_back({c.index, divides});
  });
  if (s.near_set != 0 && s.cbm.n_cell() > 0) share_due_spheres(world, due);
  for (const DueCell& d : due) {
    const bool deformable = d.index < s.dcm.n_lane();
    (d.divides ? plan.divide : plan.remove)
        .push_back({deformable, deformable ? d.index : d.index - s.dcm.n_lane(), d.index});
  }
}

}  // namespace

bool has_life(const Params& p) {
  return !p.life.rule.empty() || has_rule(p.rules, Behaviour::kDeath) ||
         std::ranges::any_of(p.life.type, [](const CycleParams& c) { return c.time > 0; });
}

bool has_doubled_shell(const State& s) {
  bool any = false;
  for_each_cell(s, [&](const Cell& c) {
    any = any || (c.deformable && s.cycle[c.index].duration > 0 && has_doubled(s, c));
  });
  return any;
}

void set_growth(const Params& p, State& s, const Cell& c, double factor) {
  Cycle& cycle = s.cycle[c.index];
  Ramp& volume = volume_of(s, c);
  if (cycle.fate == Fate::kQuiescent) {
    volume = Ramp::constant(volume.at(s.clock.time));
    return;
  }
  if (applies_any(p.life, false, s, c)) factor = 0;
  cycle.fate = factor > 0 ? Fate::kGrow : Fate::kRest;
  volume = growth_from(cycle, volume.at(s.clock.time), s.clock.time, factor);
}

void begin_life(World& world) {
  if (!has_life(world.params)) return;
  State& s = world.state;
  const LifeParams& p = world.params.life;
  s.cycle.assign(s.dcm.n_lane() + s.cbm.n_cell(), Cycle{});
  for_each_cell(s, [&](const Cell& c) {
    const std::int64_t lineage = lineage_of(s, c);
    Cycle& cycle = s.cycle[c.index];
    cycle.founder = lineage;
    cycle.birth = s.clock.time;
    const CycleParams& type = cycle_of(world.params, s, c);
    if (type.time <= 0) return;
    cycle.birth_volume =
        volume_of(s, c).at(s.clock.time) / (1 + draw_start_age(type, p.seed, lineage));
    cycle.duration = draw_cycle_time(type, p.seed, lineage);
    if (p.proliferation) cycle.fate = Fate::kQuiescent;
    set_growth(world.params, s, c, 1);
  });
}

Plan make_plan(World& world, Workspace& work) {
  Plan plan;
  look_at_rules(world, work, plan);
  look_at_clocks(world, plan);
  return plan;
}

bool reads_points(const World& world) {
  return has_updates(world.params) &&
         grid_interval(time_of(world.state), world.params.life.grid) != world.state.life_interval;
}

double time_to_life_event(const World& world) {
  const LifeParams& p = world.params.life;
  if (!has_updates(world.params)) return std::numeric_limits<double>::infinity();
  return time_to_next_interval(time_of(world.state), p.grid);
}

}  // namespace acinus::coupling
