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
  const substances::Shares& of(const Substance& substance) {
    std::optional<substances::Shares>& shares = shares_[substance.outside_cells ? 1 : 0];
    if (!shares) shares = share_cells(params_, state_, substance.outside_cells);
    return *shares;
  }

 private:
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

double area_of(const State& s, const Cell& c) {
  if (!c.deformable) {
    const double r = sphere_radius(s.cbm.volume[c.at].at(s.clock.time));
    return 4 * kPi * r * r;
  }
  std::vector<Vec3> node;
  dcm::copy_nodes(s.dcm, c.at, node);
  double sum = 0;
  for (const auto& [i, j, k] : s.dcm.group[c.at / kLanes].topology->triangle)
    sum += 0.5 * (node[j] - node[i]).cross(node[k] - node[i]).norm();
  return sum;
}

/// Exchange of a cell per volume; that of its surface is spread over its volume.
substances::Exchange exchange_of(const Substance& substance, const State& s, const Cell& c,
                                 std::span<const substances::VoxelShare> shares) {
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
  return e;
}

std::vector<substances::Exchange> exchange_of_cells(const Substance& substance, const State& s,
                                                    const std::vector<Cell>& cells,
                                                    const substances::Shares& shares) {
  std::vector<substances::Exchange> exchange(cells.size());
  for_each_index(cells.size(), cells.size() > kParallelShares, [&](std::size_t k) {
    exchange[k] = exchange_of(substance, s, cells[k], shares.of(k));
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

/// f(substance, cell, its shares) for all cells, [substance][dcm lanes, then cbm cells].
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
    std::vector<double>& of_cell = value.emplace_back(s.dcm.n_lane() + s.cbm.n_cell(), 0.0);
    for (std::size_t b = 0; b < cells.size(); ++b)
      of_cell[cells[b].index] = f(k, cells[b], shares.of(b));
  }
  return value;
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
  if (!work.sized) {
    work.solver.resize(p.grid.n);
    work.sized = true;
  }
  const std::vector<Cell> cells = list_cells(s);
  SharesOfCells all(p, s);
  const OpenSpaces spaces = find_open_spaces(world, work.obstacles);
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const Substance& substance = p.substance[k];
    SubstanceState& field = s.substance[k];
    const substances::OpenSpace* space = spaces.of(substance);
    const substances::Shares& everywhere = all.of(substance);
    const substances::Shares in_open =
        space == nullptr ? substances::Shares{} : move_to_open(everywhere, *space);
    const substances::Shares& shares = space == nullptr ? everywhere : in_open;
    const std::vector<substances::Exchange> exchange =
        exchange_of_cells(substance, s, cells, shares);
    const double middle = time_of(s) - 0.5 * step;
    substances::Advance how{step, p.longest_step, p.tolerance};
    if (!substance.course.entry.empty()) how.supply = substance.course.at(middle);
    if (space != nullptr) {
      how.space = space;
      how.held = hold_amounts(field, *space, work.held);
    }
    const substances::Budget budget = substances::advance(
        p.grid, substance.medium, {shares, exchange}, how, work.solver, field.concentration, {});
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
  return substances::total_amount(p.grid, field.concentration, field.open);
}

double next_supply_change(const SubstanceParams& p, double time) {
  double next = std::numeric_limits<double>::infinity();
  for (const Substance& s : p.substance) next = std::min(next, s.course.next(time));
  return next;
}

std::vector<std::vector<double>> cell_concentrations(const World& world) {
  return of_each_cell(world,
                      [&](std::size_t k, const Cell&, std::span<const substances::VoxelShare> of) {
                        return substances::mean_over(of, world.state.substance[k].concentration);
                      });
}

std::vector<std::vector<double>> cell_exchange_rates(const World& world) {
  const State& s = world.state;
  return of_each_cell(
      world, [&](std::size_t k, const Cell& c, std::span<const substances::VoxelShare> shares) {
        const substances::Exchange exchange =
            exchange_of(world.params.substances.substance[k], s, c, shares);
        double sum = 0;
        for (const substances::VoxelShare& share : shares)
          sum += share.volume *
                 substances::exchange_rate(exchange, s.substance[k].concentration[share.voxel]);
        return sum;
      });
}

}  // namespace acinus::coupling
