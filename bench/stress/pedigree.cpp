#include "bench/stress/pedigree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/sphere.hpp"
#include "coupling/life/cell_cycle.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::bench {
namespace {

/// Largest deviation of cycle times, in standard deviations.
constexpr double kMostCycleDeviations = 3;
/// Relative tolerance of times and volumes, which are sums over some thousand steps.
constexpr double kRelativeTolerance = 1e-6;

const std::vector<std::int64_t>& ids_of(const io::Frame& f, const char* name) {
  return std::ranges::find(f.cells.ids, name, &io::IdColumn::name)->value;
}
/// Lineages of the cells drawn in a frame, with true for surfaces.
std::map<std::int64_t, bool> drawn_cells(const io::Frame& f) {
  std::map<std::int64_t, bool> drawn;
  for (std::size_t k = 0; k < f.cell_id.size(); ++k)
    if (f.cell_id[k] >= 0) drawn[f.cell_id[k]] = k < f.triangle.size();
  return drawn;
}

}  // namespace

std::map<std::int64_t, double> rest_volumes(const io::Frame& f) {
  const std::vector<std::int64_t>& id = ids_of(f, "id");
  const auto radius = std::ranges::find(f.cells.columns, "radius", &io::Column::name);
  std::map<std::int64_t, double> volume;
  for (std::size_t k = 0; k < id.size(); ++k) volume[id[k]] = sphere_volume(radius->value[k]);
  return volume;
}

Pedigree::Pedigree(const coupling::World& start) : params_(start.params) {
  const coupling::State& s = start.state;
  const bool grown = s.clock.phase == coupling::Phase::kRun;  // else by t = 0
  coupling::for_each_cell(s, [&](const coupling::Cell& c) {
    const Ramp& volume = coupling::volume_of(s, c);
    const std::int64_t id = coupling::lineage_of(s, c);
    Relative r;
    r.founder = id;
    r.type = coupling::type_of(s, c);
    r.first_volume = grown ? volume.at(s.clock.time) : volume.to;
    r.deformable = c.deformable;
    const coupling::CycleParams& life = life_of(r);
    r.unit = r.first_volume;
    if (life.time > 0) r.unit /= 1 + coupling::draw_start_age(life, params_.life.seed, id);
    all_[id] = r;
  });
}

bool Pedigree::is_there(std::int64_t id) const {
  const auto it = all_.find(id);
  return it != all_.end() && !std::isfinite(it->second.end);
}

double Pedigree::shortest_cycle(const Relative& r) const {
  return life_of(r).time * (1 - kMostCycleDeviations * life_of(r).spread);
}

Interval Pedigree::rest_volume(const Relative& r, double time) const {
  const coupling::CycleParams& life = life_of(r);
  const double grows = std::max(0.0, std::min(time, r.dissolves) - r.birth);
  Interval range{r.first_volume, r.first_volume};
  if (life.time > 0)
    range.high = std::min(2 * r.unit, r.first_volume + r.unit * grows / shortest_cycle(r));
  if (time > r.dissolves) {
    const double part = std::min(1.0, (time - r.dissolves) / life.death.duration);
    const double share = 1 + part * (life.death.final_volume - 1);
    range = {share * range.low, share * range.high};
  }
  return range;
}

bool Pedigree::may_die(std::int64_t id, const Relative& r, double time) const {
  for (const coupling::SignalRule& rule : params_.rules.rule)
    if (rule.behaviour == coupling::Behaviour::kDeath &&
        (rule.type < 0 || rule.type == static_cast<int>(r.type)))
      return true;
  return std::ranges::any_of(params_.life.rule, [&](const coupling::LifeRule& rule) {
    const double slack = kRelativeTolerance * (1 + time);
    if (!rule.die || time < rule.from - slack || time > rule.until + slack) return false;
    const std::int64_t named = rule.descendants ? r.founder : id;
    return rule.cells.empty() || std::ranges::binary_search(rule.cells, named);
  });
}

std::string Pedigree::add_daughters(const io::Event& e) {
  if (e.cell_id.size() != 3) return "a division without two daughters";
  const std::int64_t id = e.cell_id[0];
  if (!is_there(id)) return fmt::format("cell {} divides, which is not there", id);
  Relative& mother = all_.at(id);
  mother.end = e.time_s;
  std::string wrong;
  const double needs = (2 * mother.unit - mother.first_volume) / mother.unit *
                       shortest_cycle(mother) * (1 - kRelativeTolerance);
  if (life_of(mother).time <= 0 || std::isfinite(mother.dissolves))
    wrong = fmt::format("cell {} divides, which does not grow", id);
  else if (e.time_s - mother.birth < needs - kRelativeTolerance * (1 + e.time_s))
    wrong = fmt::format("cell {} divides {:.4g} s old; it cannot before {:.4g} s", id,
                        e.time_s - mother.birth, needs);
  for (const std::int64_t daughter : {e.cell_id[1], e.cell_id[2]}) {
    if (all_.contains(daughter)) return fmt::format("cell {} is born twice", daughter);
    Relative r;
    r.parent = id;
    r.founder = mother.founder;
    r.type = mother.type;
    r.deformable = mother.deformable;
    r.birth = e.time_s;
    r.first_volume = r.unit = mother.unit;
    all_[daughter] = r;
  }
  return wrong;
}

std::string Pedigree::end_life(const io::Event& e) {
  const std::int64_t id = e.cell_id.empty() ? -1 : e.cell_id[0];
  if (!is_there(id)) return fmt::format("{} of cell {}, which is not there", e.code, id);
  Relative& r = all_.at(id);
  const coupling::DeathParams& death = life_of(r).death;
  const double slack = kRelativeTolerance * (1 + e.time_s);
  if (e.code == "death") r.end = e.time_s;
  if (e.code == "death" && death.lysis) {
    if (e.time_s >= r.dissolves + death.duration - slack) return {};
    if (r.early && std::isfinite(r.dissolves)) return {};
    return fmt::format("cell {} is gone before it has dissolved", id);
  }
  if (e.code == "lysis") {
    if (!death.lysis || std::isfinite(r.dissolves))
      return fmt::format("cell {} dissolves, which it must not", id);
    r.dissolves = e.time_s;
  }
  return may_die(id, r, e.time_s) ? "" : fmt::format("cell {} dies, which no rule wants", id);
}

std::string Pedigree::change_model(const io::Event& e) {
  const std::int64_t id = e.cell_id.empty() ? -1 : e.cell_id[0];
  const bool deformable = e.code == "promotion";
  if (!is_there(id)) return fmt::format("{} of cell {}, which is not there", e.code, id);
  Relative& r = all_.at(id);
  const bool same = r.deformable == deformable;
  r.deformable = deformable;
  return same ? fmt::format("{} of cell {}, which has that model already", e.code, id) : "";
}

std::vector<Finding> Pedigree::add(const io::Event& e) {
  std::string wrong;
  if (e.code == "division") wrong = add_daughters(e);
  if (e.code == "death_early" && !e.cell_id.empty() && is_there(e.cell_id[0]))
    all_.at(e.cell_id[0]).early = true;
  if (e.code == "death" || e.code == "lysis") wrong = end_life(e);
  if (e.code == "promotion" || e.code == "demotion") wrong = change_model(e);
  if (e.code == "division_waits" && !e.cell_id.empty() && is_there(e.cell_id[0]))
    all_.at(e.cell_id[0]).waits = true;
  if (wrong.empty()) return {};
  return {{Defect::kUntimely, e.time_s, wrong}};
}

std::vector<Finding> Pedigree::find_overdue(double time) const {
  std::vector<Finding> late;
  // Signals that slow growth leave no latest time of division.
  const bool may_rest =
      std::ranges::any_of(params_.life.rule,
                          [](const coupling::LifeRule& rule) { return !rule.die; }) ||
      std::ranges::any_of(params_.rules.rule, [](const coupling::SignalRule& rule) {
        return rule.behaviour == coupling::Behaviour::kGrowth;
      });
  for (const auto& [id, r] : all_) {
    if (std::isfinite(r.end)) continue;
    const coupling::CycleParams& life = life_of(r);
    // Both happen at the end of the step in which they are due.
    const double slack = params_.numerics.max_step + kRelativeTolerance * (1 + time);
    if (time > r.dissolves + life.death.duration + slack)
      late.push_back({Defect::kUntimely, time, fmt::format("cell {} is dissolved and there", id)});
    if (life.time <= 0 || may_rest || r.waits || std::isfinite(r.dissolves) ||
        life.inhibition.by != coupling::InhibitedBy::kNothing)
      continue;
    const double longest = life.time * (1 + kMostCycleDeviations * life.spread);
    if (time > r.birth + (2 * r.unit - r.first_volume) / r.unit * longest + slack)
      late.push_back({Defect::kUntimely, time, fmt::format("cell {} does not divide", id)});
  }
  return late;
}

std::vector<Finding> Pedigree::compare(const io::Frame& f) const {
  std::vector<Finding> wrong;
  const auto add = [&](Defect d, const std::string& what) { wrong.push_back({d, f.time_s, what}); };
  const std::vector<std::int64_t>&id = ids_of(f, "id"), &parent = ids_of(f, "parent");
  const std::map<std::int64_t, double> rest = rest_volumes(f);
  const std::map<std::int64_t, bool> drawn = drawn_cells(f);
  for (const auto& [i, deformable] : drawn) {
    if (!rest.contains(i)) add(Defect::kUnborn, fmt::format("cell {} is in no table", i));
    if (is_there(i) && all_.at(i).deformable != deformable)
      add(Defect::kUntimely, fmt::format("cell {} has changed its model without an event", i));
  }
  for (std::size_t k = 0; k < id.size(); ++k) {
    if (!is_there(id[k])) {
      add(Defect::kUnborn, fmt::format("cell {} has no mother, or is dead", id[k]));
      continue;
    }
    const Relative& r = all_.at(id[k]);
    if (parent[k] != r.parent)
      add(Defect::kUnborn,
          fmt::format("cell {} is the daughter of {}, not of {}", id[k], r.parent, parent[k]));
    if (f.time_s < 0) continue;  // cells of a start-up are still small
    const Interval range = rest_volume(r, f.time_s);
    const double v = rest.at(id[k]);
    if (v < (1 - kRelativeTolerance) * range.low || v > (1 + kRelativeTolerance) * range.high)
      add(Defect::kVolume, fmt::format("cell {} has a rest volume of {:.6g} um^3, not {:.6g} to "
                                       "{:.6g}",
                                       id[k], v, range.low, range.high));
  }
  for (const auto& [i, r] : all_)
    if (is_there(i) && (!drawn.contains(i) || !rest.contains(i)))
      add(Defect::kVanished, fmt::format("cell {} is gone without an event", i));
  return wrong;
}

}  // namespace acinus::bench
