#include "coupling/measure/signals.hpp"

#include <algorithm>
#include <utility>

#include "core/numbers/time_grid.hpp"
#include "coupling/measure/contact_list.hpp"
#include "coupling/migration/lesion_layers.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/substances/responses.hpp"
#include "coupling/world/cell.hpp"

namespace acinus::coupling {
namespace {

bool is_of_contacts(const SignalRule& r) {
  return r.signal == Signal::kContactArea || r.signal == Signal::kNeighbours;
}

/// Values of a rule in the order of measure_cells.
template <class F>
std::vector<double> of_each(const std::vector<CellMeasure>& cells, const F& f) {
  std::vector<double> value(cells.size());
  std::ranges::transform(cells, value.begin(), f);
  return value;
}

/// Contacts with living cells of the rule's partner type.
std::vector<double> values_of_contacts(const SignalRule& r, const std::vector<CellMeasure>& cells,
                                       const std::vector<CellContact>& contacts) {
  std::vector<double> value(cells.size(), 0.0);
  const auto add = [&](std::size_t cell, std::size_t other, double area, bool touching) {
    const CellMeasure& o = cells[other];
    if (o.fate == Fate::kLyse || (r.partner >= 0 && o.type != r.partner)) return;
    value[cell] += r.signal == Signal::kContactArea ? area : touching ? 1 : 0;
  };
  for (const CellContact& c : contacts) {
    if (c.b == kNoCell) continue;
    add(c.a, c.b, c.area_a, c.touching);
    add(c.b, c.a, c.area_b, c.touching);
  }
  return value;
}

std::vector<double> layers_of(const std::vector<CellMeasure>& cells, const Vec3& axis_point) {
  std::vector<LayerCell> all;
  for (const CellMeasure& m : cells) all.push_back({m.center, m.radius});
  const std::vector<int> layer = compute_layers(all, axis_point);
  return {layer.begin(), layer.end()};
}

}  // namespace

std::vector<std::vector<double>> measure_signals(const World& world, const Workspace& w,
                                                 const std::vector<CellMeasure>& cells) {
  const RuleParams& p = world.params.rules;
  const State& s = world.state;
  std::vector<CellContact> contacts;
  if (std::ranges::any_of(p.rule, is_of_contacts)) contacts = list_contacts(world, w, cells);
  const auto measure = [&](const SignalRule& r) -> std::vector<double> {
    switch (r.signal) {
      case Signal::kPressure:
        return of_each(cells, &CellMeasure::pressure);
      case Signal::kVolume:
        return of_each(cells, &CellMeasure::volume);
      case Signal::kContactArea:
      case Signal::kNeighbours:
        return values_of_contacts(r, cells, contacts);
      case Signal::kLayer:
        return layers_of(cells, p.axis_point);
      case Signal::kConcentration:
      case Signal::kAge:
        break;
    }
    return {};
  };
  std::vector<std::vector<double>> value(p.rule.size());
  for (std::size_t k = 0; k < p.rule.size(); ++k) {
    if (!is_measured(p.rule[k].signal)) continue;
    const std::vector<double> of_cells = measure(p.rule[k]);
    value[k].assign(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
    std::size_t n = 0;
    for_each_cell(s, [&](const Cell& c) { value[k][c.index] = of_cells[n++]; });
  }
  return value;
}

std::vector<std::vector<double>> present_signals(const World& world, const Workspace& w,
                                                 const std::vector<CellMeasure>& cells) {
  std::vector<std::vector<double>> value = measure_signals(world, w, cells);
  std::vector<Behaviour> all;
  for (const SignalRule& r : world.params.rules.rule) all.push_back(r.behaviour);
  RuleSignals others = rule_signals(world, all);
  for (std::size_t k = 0; k < value.size(); ++k)
    if (!is_measured(world.params.rules.rule[k].signal)) value[k] = std::move(others[k]);
  return value;
}

void refresh_signals(World& world, Workspace& w) {
  State& s = world.state;
  if (s.clock.phase != Phase::kRun || !has_measured_signal(world.params.rules)) return;
  const std::int64_t now = grid_interval(time_of(s), world.params.life.grid);
  if (now == s.signal.interval && !s.signal.value.empty()) return;
  const auto scope = w.timings.scope("signals");
  observe(world, w);
  s.signal = {measure_signals(world, w, measure_cells(world, w)), now};
}

}  // namespace acinus::coupling
