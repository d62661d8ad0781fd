#include "runs/experiments/sample_tissue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/sphere.hpp"
#include "coupling/life/cell_cycle.hpp"
#include "coupling/life/density.hpp"
#include "coupling/measure/contact_forces.hpp"
#include "coupling/measure/contact_sums.hpp"
#include "coupling/measure/signals.hpp"
#include "coupling/substances/fields.hpp"
#include "coupling/world/cell.hpp"
#include "runs/experiments/observables.hpp"

namespace acinus::runs {
namespace {

using coupling::CellMeasure;
using coupling::Reaction;

bool is_inhibited_by_density(const coupling::Params& p) {
  return std::ranges::any_of(p.life.type, [](const coupling::CycleParams& type) {
    return type.inhibition.by == coupling::InhibitedBy::kDensity;
  });
}

void add_reaction(const std::string& name, const Reaction& r, Measures& m) {
  m[name + "_force_nN"].push_back(r.normal);
  for (int k = 0; k < 3; ++k)
    m[name + "_net_" + std::string("xyz").substr(k, 1) + "_nN"].push_back(r.net[k]);
}

/// Reactions of walls and meshes by name, summed over those with the same name, and of vessels.
void sample_reactions(const ObservedFrame& frame, Measures& m) {
  const contact::Boundary& boundary = frame.world.params.boundary;
  const coupling::Reactions r = coupling::compute_reactions(frame.world, frame.work);
  std::map<std::string, Reaction> wall;
  contact::for_each_wall(boundary, [&](contact::Partner kind, std::size_t k, const auto& w) {
    wall[name_in_columns(w.name)] += r.of(kind)[k];
  });
  for (std::size_t k = 0; k < boundary.meshes.size(); ++k)
    wall[name_in_columns(boundary.meshes[k].name)] += r.of(contact::Partner::kMesh)[k];
  for (const auto& [name, reaction] : wall) add_reaction("wall_" + name, reaction, m);
  Reaction vessels;
  for (const Reaction& segment : r.of(contact::Partner::kVessel)) vessels += segment;
  add_reaction("vessels", vessels, m);
}

void sample_pressures(const std::vector<CellMeasure>& cells, Measures& m) {
  for (const bool deformable : {true, false}) {
    double n = 0, sum[2] = {0, 0}, most[2] = {0, 0};
    for (const CellMeasure& c : cells) {
      if (c.deformable != deformable) continue;
      const double p[2] = {1e3 * c.pressure, 1e3 * c.cytosol_pressure};
      for (int k = 0; k < 2; ++k) {
        sum[k] += p[k];
        most[k] = n > 0 ? std::max(most[k], p[k]) : p[k];
      }
      ++n;
    }
    const std::string model = deformable ? "dcm" : "cbm";
    for (int k = 0; k < 2; ++k) {
      const std::string kind = k == 0 ? "contact_pressure_" : "cytosol_pressure_";
      m[kind + "mean_" + model + "_Pa"].push_back(n > 0 ? sum[k] / n : 0);
      m[kind + "max_" + model + "_Pa"].push_back(most[k]);
    }
    m["cells_" + model].push_back(n);
  }
}

void sample_overlaps(const coupling::AuditResult& a, Measures& m) {
  m["overlap_dcm_dcm_um"].push_back(a.dcm_dcm.depth_um);
  m["overlap_dcm_cbm_um"].push_back(a.dcm_cbm.depth_um);
  m["overlap_dcm_cbm_beyond_um"].push_back(a.dcm_cbm_beyond_indentation.depth_um);
  m["overlap_cbm_cbm_um"].push_back(a.cbm_cbm.depth_um);
  m["overlap_dcm_vessels_um"].push_back(a.dcm_vessel.depth_um);
  m["overlap_cbm_vessels_um"].push_back(a.cbm_vessel.depth_um);
  m["overlap_vessels_um"].push_back(std::max(a.dcm_vessel.depth_um, a.cbm_vessel.depth_um));
  m["overlap_dcm_walls_um"].push_back(a.dcm_wall.depth_um);
  m["overlap_cbm_walls_um"].push_back(a.cbm_wall.depth_um);
}

void sample_clusters(const ObservedFrame& frame, Measures& m) {
  const std::vector<int> size = coupling::cluster_sizes(
      frame.snapshot.cells.size(), coupling::find_touching(frame.world, frame.work));
  double clusters = 0;
  for (const int n : size) clusters += 1.0 / n;
  m["detached_cells"].push_back(static_cast<double>(std::ranges::count(size, 1)));
  m["cells_in_small_clusters"].push_back(
      static_cast<double>(std::ranges::count_if(size, [](int n) { return n < 3; })));
  m["clusters"].push_back(std::round(clusters));
}

void sample_interface(const ObservedFrame& frame, Measures& m) {
  double pairs = 0, force = 0;
  for (const coupling::InterfaceForce& f : frame.snapshot.interface) {
    pairs += f.force.squaredNorm() > 0 ? 1 : 0;
    force += f.force.norm();
  }
  m["interface_pairs"].push_back(pairs);
  m["interface_force_nN"].push_back(force);
  m["interface_residual"].push_back(coupling::interface_residual(frame.world, frame.work));
}

/// Measures the slowest growth that inhibition leaves, and counts the cells that rest.
void sample_growth(const ObservedFrame& frame, Measures& m) {
  const coupling::State& s = frame.world.state;
  const coupling::Params& p = frame.world.params;
  double slowest = 1, resting = 0;
  if (!s.cycle.empty()) {
    const bool by_density = is_inhibited_by_density(p);
    std::vector<double> density(s.cycle.size());
    if (by_density) density = coupling::local_densities(frame.world);
    std::size_t k = 0;
    coupling::for_each_cell(s, [&](const coupling::Cell& c) {
      const CellMeasure& cell = frame.snapshot.cells[k++];
      if (cell.fate == coupling::Fate::kRest) ++resting;
      if (!cell.in_cycle) return;
      const coupling::Crowding now{cell.pressure, cell.volume / sphere_volume(cell.radius),
                                   density[c.index]};
      slowest =
          std::min(slowest, coupling::growth_factor(coupling::cycle_of(p, s, c).inhibition, now));
    });
  }
  m["slowest_growth"].push_back(slowest);
  m["resting_cells"].push_back(resting);
}

void sample_substances(const coupling::World& world, Measures& m) {
  const coupling::SubstanceParams& p = world.params.substances;
  const auto mean = coupling::cell_concentrations(world),
             rate = coupling::cell_exchange_rates(world);
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const std::string name = "substance_" + name_in_columns(p.substance[k].name);
    const std::vector<double>& field = world.state.substance[k].concentration;
    double sum = 0, n = 0, exchange = 0;
    double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
    coupling::for_each_cell(world.state, [&](const coupling::Cell& c) {
      sum += mean[k][c.index];
      n += 1;
      lowest = std::min(lowest, mean[k][c.index]);
      highest = std::max(highest, mean[k][c.index]);
      exchange += rate[k][c.index];
    });
    const double none = std::numeric_limits<double>::quiet_NaN();
    const coupling::SubstanceState& state = world.state.substance[k];
    const double space = state.open.empty()
                             ? static_cast<double>(field.size())
                             : std::accumulate(state.open.begin(), state.open.end(), 0.0);
    m[name + "_mean"].push_back(coupling::amount_of(p, state) / p.grid.voxel_volume() / space);
    m[name + "_mean_of_cells"].push_back(n > 0 ? sum / n : none);
    m[name + "_lowest_of_cells"].push_back(n > 0 ? lowest : none);
    m[name + "_highest_of_cells"].push_back(n > 0 ? highest : none);
    m[name + "_exchange"].push_back(exchange);
  }
}

/// True if a rule halves the behaviour of a cell, or gives it at least half of a death or a force.
bool acts_strongly(const coupling::SignalRule& r, double response) {
  constexpr double kHalf = 0.5;
  const bool adds =
      r.behaviour == coupling::Behaviour::kDeath || r.behaviour == coupling::Behaviour::kChemotaxis;
  return adds ? response > kHalf : response < kHalf;
}

void sample_rules(const ObservedFrame& frame, Measures& m) {
  const coupling::State& s = frame.world.state;
  const std::vector<coupling::SignalRule>& rules = frame.world.params.rules.rule;
  const auto signal = coupling::present_signals(frame.world, frame.work, frame.snapshot.cells);
  for (std::size_t k = 0; k < rules.size(); ++k) {
    double sum = 0, n = 0, acting = 0;
    coupling::for_each_cell(s, [&](const coupling::Cell& c) {
      if (!coupling::acts_on(rules[k], rules[k].behaviour, coupling::type_of(s, c))) return;
      const double response = coupling::signal_response(rules[k], signal[k][c.index]);
      sum += response;
      n += 1;
      acting += acts_strongly(rules[k], response) ? 1 : 0;
    });
    const std::string name = fmt::format("rule_{}", k);
    m[name + "_response"].push_back(n > 0 ? sum / n : std::numeric_limits<double>::quiet_NaN());
    m[name + "_cells"].push_back(acting);
  }
}

}  // namespace

void sample_tissue(const ObservedFrame& frame, Measures& m) {
  m["divisions"].push_back(static_cast<double>(frame.world.state.divisions));
  m["deaths"].push_back(static_cast<double>(frame.world.state.deaths));
  sample_growth(frame, m);
  sample_pressures(frame.snapshot.cells, m);
  sample_overlaps(frame.audit, m);
  sample_clusters(frame, m);
  sample_interface(frame, m);
  sample_reactions(frame, m);
  sample_substances(frame.world, m);
  if (!frame.scene.rules.empty()) sample_rules(frame, m);
}

bool samples_points(const coupling::World& world) { return is_inhibited_by_density(world.params); }

std::vector<std::string> wall_names(const contact::Boundary& boundary) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    if (std::ranges::find(names, name_in_columns(name)) == names.end())
      names.push_back(name_in_columns(name));
  };
  contact::for_each_wall(boundary, [&](auto, auto, const auto& wall) { add(wall.name); });
  for (const contact::StaticMesh& b : boundary.meshes) add(b.name);
  return names;
}

}  // namespace acinus::runs
