#include "coupling/substances/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "core/sphere.hpp"
#include "coupling/substances/growing_box.hpp"
#include "coupling/substances/insides.hpp"
#include "coupling/substances/responses.hpp"
#include "coupling/world/cell.hpp"
#include "substances/diffusion.hpp"

namespace acinus::coupling {
namespace {

/// Number of cells below which threads cost more than they save.
constexpr std::size_t kParallelShares = 50;

std::vector<substances::VoxelShare> share_cell(const substances::VoxelGrid& grid, const State& s,
                                               const Cell& c, bool by_area) {
  if (!c.deformable) {
    const auto share = by_area ? substances::share_sphere_by_area : substances::share_sphere;
    return share(grid, cbm::center_of(s.cbm, c.at),
                 sphere_radius(s.cbm.volume[c.at].at(s.clock.time)));
  }
  std::vector<Vec3> node;
  dcm::copy_nodes(s.dcm, c.at, node);
  const auto share = by_area ? substances::share_surface_by_area : substances::share_surface;
  return share(grid, node, s.dcm.group[c.at / kLanes].topology->triangle);
}

/// Shares of all cells of both kinds, each found when a substance needs it.
class SharesOfCells {
 public:
  SharesOfCells(const SubstanceParams& p, const State& s) : params_(p), state_(s) {}
  const substances::Shares& of(const Substance& substance) { return of(substance.outside_cells); }
  const substances::Shares& by_area() { return of(true); }

 private:
  const substances::Shares& of(bool by_area) {
    std::optional<substances::Shares>& shares = shares_[by_area ? 1 : 0];
    if (!shares) shares = share_cells(params_, state_, by_area);
    return *shares;
  }

  const SubstanceParams& params_;
  const State& state_;
  std::array<std::optional<substances::Shares>, 2> shares_;
};

/// The same shares in open voxels.
substances::Shares move_to_open(substances::Shares shares, const substances::OpenSpace& space) {
  for (substances::VoxelShare& s : shares.share) s.voxel = space.nearest[s.voxel];
  return shares;
}

bool is_dissolving(const State& s, const Cell& c) {
  return c.index < s.cycle.size() && s.cycle[c.index].fate == Fate::kLyse;
}

/// Exchange of a cell per volume; that of its surface is spread over its volume.
/// @param signal  of rule_signals; may be empty without rules of secretion and uptake
substances::Exchange exchange_of(const Params& p, std::size_t k, const State& s, const Cell& c,
                                 std::span<const substances::VoxelShare> shares,
                                 const RuleSignals& signal) {
  const Substance& substance = p.substances.substance[k];
  const auto type = static_cast<std::size_t>(type_of(s, c));
  if (type >= substance.exchange.size() || is_dissolving(s, c)) return {};
  const CellExchange& of_type = substance.exchange[type];
  substances::Exchange e = of_type;
  if (of_type.secretion_per_area > 0 || of_type.uptake_per_area > 0) {
    double volume = 0;
    for (const substances::VoxelShare& share : shares) volume += share.volume;
    const double area = area_of(s, c);
    e.secretion += of_type.secretion_per_area * area / volume;
    e.uptake += of_type.uptake_per_area * area / volume;
  }
  const ExchangeFactors f =
      exchange_factors(p.rules, static_cast<int>(k), static_cast<int>(type), c.index, signal);
  e.secretion *= f.secretion;
  e.uptake *= f.uptake;
  e.uptake_max *= f.uptake;
  return e;
}

std::vector<substances::Exchange> exchange_of_cells(const Params& p, std::size_t k, const State& s,
                                                    const std::vector<Cell>& cells,
                                                    const substances::Shares& shares,
                                                    const RuleSignals& signal) {
  std::vector<substances::Exchange> exchange(cells.size());
  for_each_index(cells.size(), cells.size() > kParallelShares, [&](std::size_t c) {
    exchange[c] = exchange_of(p, k, s, cells[c], shares.of(c), signal);
  });
  return exchange;
}

/// Amounts of a field per volume of a voxel, none of them in closed voxels.
std::span<const double> hold_amounts(const SubstanceState& field,
                                     const substances::OpenSpace& space,
                                     std::vector<double>& held) {
  held.resize(field.concentration.size());
  std::ranges::transform(field.open, field.concentration, held.begin(), std::multiplies<>{});
  substances::carry_amounts(space, held);
  return held;
}

/// Amounts around and inside cells. Concentrations inside, a first guess, follow those of voxels.
std::span<const double> join_insides(const World& world, const substances::Parts& parts,
                                     const substances::OpenSpace& space, SubstanceState& field,
                                     std::vector<double>& held) {
  const substances::VoxelGrid& grid = world.params.substances.grid;
  held.resize(grid.n_voxel() + parts.n(), 0.0);
  carry_insides(world, field.inside, parts, space, held);
  for (std::size_t p = 0; p < parts.n(); ++p)
    field.concentration.push_back(held[grid.n_voxel() + p] * grid.voxel_volume() / parts.volume[p]);
  return held;
}

/// f(substance, cell, its shares, the concentrations they are shares of) for all cells,
/// [substance][dcm lanes, then cbm cells].
template <class F>
std::vector<std::vector<double>> of_each_cell(const World& world, const F& f) {
  const SubstanceParams& p = world.params.substances;
  const State& s = world.state;
  if (!p.exists()) return {};
  const std::vector<Cell> cells = list_cells(s);
  SharesOfCells all(p, s);
  std::vector<std::vector<double>> value;
  for (std::size_t k = 0; k < s.substance.size(); ++k) {
    const substances::Shares& shares = all.of(p.substance[k]);
    const InsideState& inside = s.substance[k].inside;
    const InsidesOfCells insides(s, inside);
    std::vector<double>& of_cell = value.emplace_back(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
    for (std::size_t b = 0; b < cells.size(); ++b) {
      const auto within = insides.of(cells[b]);
      of_cell[cells[b].index] = within.empty()
                                    ? f(k, cells[b], shares.of(b), s.substance[k].concentration)
                                    : f(k, cells[b], within, inside.concentration);
    }
  }
  return value;
}

constexpr Behaviour kExchange[] = {Behaviour::kSecretion, Behaviour::kUptake};

/// Factors of all substances on what the outside supplies, s since t = 0.
std::vector<double> supplies_at(const SubstanceParams& p, double time) {
  std::vector<double> supply;
  for (const Substance& s : p.substance)
    supply.push_back(s.course.entry.empty() ? 1 : s.course.at(time));
  return supply;
}

}  // namespace

void begin_substances(const SubstanceParams& p, State& s) {
  s.substance.clear();
  for (const Substance& substance : p.substance) {
    SubstanceState field;
    field.concentration.assign(p.grid.n_voxel(), substance.initial);
    s.substance.push_back(std::move(field));
  }
}

void begin_open_spaces(World& world) {
  const SubstanceParams& p = world.params.substances;
  State& s = world.state;
  if (std::ranges::none_of(p.substance, &Substance::is_kept_out)) return;
  ObstacleCover obstacles;
  const OpenSpaces spaces = find_open_spaces(world, obstacles);
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const Substance& substance = p.substance[k];
    if (!substance.is_kept_out()) continue;
    s.substance[k].open = spaces.of(substance)->volume;
    if (!substance.has_membranes()) continue;
    const substances::Parts parts = make_parts(world, spaces.cells, share_cells(p, s, true));
    s.substance[k].inside =
        keep_insides(s, parts, std::vector<double>(parts.n(), substance.initial));
  }
}

substances::Shares share_cells(const SubstanceParams& p, const State& s, bool by_area) {
  const std::vector<Cell> cells = list_cells(s);
  std::vector<std::vector<substances::VoxelShare>> share(cells.size());
  for_each_index(cells.size(), cells.size() > kParallelShares,
                 [&](std::size_t k) { share[k] = share_cell(p.grid, s, cells[k], by_area); });
  substances::Shares shares;
  for (const auto& of_cell : share) shares.add(of_cell);
  return shares;
}

void advance_substances(World& world, double step, SubstanceWorkspace& work, Timings& timings) {
  const SubstanceParams& p = world.params.substances;
  State& s = world.state;
  if (!p.exists() || s.clock.phase != Phase::kRun) return;
  const auto scope = timings.scope("substances");
  const std::vector<double> supply = supplies_at(p, time_of(s) - 0.5 * step);
  grow_fields(world, supply);
  if (work.n != p.grid.n) {
    work.solver.resize(p.grid.n);
    work.n = p.grid.n;
  }
  const std::vector<Cell> cells = list_cells(s);
  const RuleSignals signal = rule_signals(world, kExchange);
  SharesOfCells all(p, s);
  const OpenSpaces spaces = find_open_spaces(world, work.obstacles);
  substances::Parts parts;
  if (std::ranges::any_of(p.substance, &Substance::has_membranes))
    parts = make_parts(world, spaces.cells, all.by_area());
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const Substance& substance = p.substance[k];
    SubstanceState& field = s.substance[k];
    const substances::OpenSpace* space = spaces.of(substance);
    const substances::Shares& everywhere = all.of(substance);
    const substances::Shares in_open = space == nullptr ? substances::Shares{}
                                       : substance.has_membranes()
                                           ? share_parts(parts, p.grid.n_voxel())
                                           : move_to_open(everywhere, *space);
    const substances::Shares& shares = space == nullptr ? everywhere : in_open;
    const std::vector<substances::Exchange> exchange =
        exchange_of_cells(world.params, k, s, cells, shares, signal);
    substances::Advance how{step, p.longest_step, p.tolerance, supply[k]};
    if (space != nullptr) {
      how.space = space;
      how.held = hold_amounts(field, *space, work.held);
    }
    if (substance.has_membranes()) {
      how.held = join_insides(world, parts, *space, field, work.held);
      how.parts = &parts;
      how.permeability = substance.permeability;
    }
    const substances::Budget budget = substances::advance(
        p.grid, substance.medium, {shares, exchange}, how, work.solver, field.concentration, {});
    if (substance.has_membranes()) {
      const std::span<const double> inside =
          std::span(field.concentration).subspan(p.grid.n_voxel());
      field.inside = keep_insides(s, parts, inside);
      field.concentration.resize(p.grid.n_voxel());
    }
    if (space != nullptr) {
      substances::fill_closed(p.grid, *space, field.concentration);
      field.open = space->volume;
    }
    check(budget.converged,
          fmt::format("the field of {} does not converge at t = {:.4g} h. Take a shorter "
                      "substance_grid.step or a larger substance_grid.tolerance.",
                      substance.name, time_since_start(world) / 3600),
          Exit::kCannotContinue);
    field.secreted += budget.secreted;
    field.entered += budget.entered;
    field.supplied += budget.supplied;
    field.decayed += budget.decayed;
  }
}

double amount_of(const SubstanceParams& p, const SubstanceState& field) {
  double inside = 0;
  for (std::size_t part = 0; part < field.inside.cell.size(); ++part)
    inside += field.inside.volume[part] * field.inside.concentration[part];
  return substances::total_amount(p.grid, field.concentration, field.open) + inside;
}

double next_supply_change(const SubstanceParams& p, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Substance& s : p.substance) next = std::min(next, s.course.next(time));
  return next;
}

std::vector<std::vector<double>> cell_concentrations(const World& world) {
  return of_each_cell(
      world, [](std::size_t, const Cell&, std::span<const substances::VoxelShare> shares,
                const std::vector<double>& c) { return substances::mean_over(shares, c); });
}

RuleSignals rule_signals(const World& world, std::span<const Behaviour> behaviours) {
  const std::vector<SignalRule>& rules = world.params.rules.rule;
  const State& s = world.state;
  RuleSignals signal(rules.size());
  std::vector<std::vector<double>> concentration;
  for (std::size_t k = 0; k < rules.size(); ++k) {
    if (std::ranges::find(behaviours, rules[k].behaviour) == behaviours.end()) continue;
    if (rules[k].signal == Signal::kConcentration) {
      if (concentration.empty()) concentration = cell_concentrations(world);
      signal[k] = concentration[rules[k].substance];
      continue;
    }
    signal[k].assign(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
    for_each_cell(
        s, [&](const Cell& c) { signal[k][c.index] = own_signal(world.params.rules, k, s, c); });
  }
  return signal;
}

std::vector<std::vector<double>> cell_exchange_rates(const World& world) {
  const State& s = world.state;
  const RuleSignals signal = rule_signals(world, kExchange);
  return of_each_cell(
      world, [&](std::size_t k, const Cell& c, std::span<const substances::VoxelShare> shares,
                 const std::vector<double>& concentration) {
        const substances::Exchange exchange = exchange_of(world.params, k, s, c, shares, signal);
        double sum = 0;
        for (const substances::VoxelShare& share : shares)
          sum += share.volume * substances::exchange_rate(exchange, concentration[share.voxel]);
        return sum;
      });
}

}  // namespace acinus::coupling
