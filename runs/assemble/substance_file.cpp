#include "runs/assemble/substance_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runs/assemble/state_numbers.hpp"

namespace acinus::runs {
namespace {

coupling::InsideState get_insides(const io::CheckpointData& d, const std::string& name) {
  coupling::InsideState inside;
  if (!d.contains(name + "cell")) return inside;
  inside.cell = d.integers(name + "cell");
  inside.voxel = d.integers(name + "voxel");
  inside.volume = d.numbers(name + "volume");
  inside.concentration = d.numbers(name + "concentration");
  for (const std::size_t n :
       {inside.voxel.size(), inside.volume.size(), inside.concentration.size()})
    check_same(d, name + "cell", inside.cell.size(), n);
  return inside;
}

substances::Layers get_layers(const io::CheckpointData& d, const std::string& name) {
  substances::Layers layers{};
  if (!d.contains(name)) return layers;
  const std::vector<std::int64_t>& value = d.integers(name);
  check_same(d, name, value.size(), layers.size());
  constexpr std::int64_t kMost = 1'000'000;
  for (std::size_t face = 0; face < layers.size(); ++face)
    layers[face] = static_cast<int>(std::clamp<std::int64_t>(value[face], 0, kMost));
  return layers;
}

/// True if all parts can be those of a grid, and there are none without membranes.
bool is_sound(const coupling::InsideState& inside, bool has_membranes, std::size_t n_voxel) {
  for (std::size_t p = 0; p < inside.cell.size(); ++p)
    if (inside.voxel[p] < 0 || static_cast<std::size_t>(inside.voxel[p]) >= n_voxel ||
        !std::isfinite(inside.concentration[p]) || !std::isfinite(inside.volume[p]) ||
        !(inside.volume[p] > 0))
      return false;
  return has_membranes || inside.cell.empty();
}

/// Mean concentration of each voxel, around and inside cells.
std::vector<float> mean_of_voxels(const substances::VoxelGrid& grid,
                                  const coupling::SubstanceState& field) {
  std::vector<double> amount(field.concentration.size()), fraction = field.open;
  for (std::size_t v = 0; v < amount.size(); ++v)
    amount[v] = field.open[v] * field.concentration[v];
  const coupling::InsideState& inside = field.inside;
  for (std::size_t p = 0; p < inside.cell.size(); ++p) {
    const auto v = static_cast<std::size_t>(inside.voxel[p]);
    const double share = inside.volume[p] / grid.voxel_volume();
    amount[v] += share * inside.concentration[p];
    fraction[v] += share;
  }
  std::vector<float> mean(amount.size());
  for (std::size_t v = 0; v < mean.size(); ++v)
    mean[v] =
        static_cast<float>(fraction[v] > 0 ? amount[v] / fraction[v] : field.concentration[v]);
  return mean;
}

/// Writes the motion and adhesion of cells that rules change, and measured signals. Names are those
/// of files that had them for substances only.
void put_signals(const coupling::State& s, io::CheckpointData& d) {
  if (s.substance.empty() && s.guidance.empty() && s.adhesion.empty() && s.signal.value.empty())
    return;
  std::vector<Vec3> force, heading;
  std::vector<double> motility;
  for (const coupling::Guidance& g : s.guidance) {
    motility.push_back(g.motility);
    force.push_back(g.force);
    heading.push_back(g.heading);
  }
  d.put("substances/guidance_motility", motility);
  d.put("substances/guidance_force", flatten(force));
  d.put("substances/guidance_heading", flatten(heading));
  d.put("rules/adhesion", s.adhesion);
  d.put_count("rules/count", std::ssize(s.signal.value));
  d.put_count("rules/interval", s.signal.interval);
  for (std::size_t k = 0; k < s.signal.value.size(); ++k)
    d.put(fmt::format("rules/{}", k), s.signal.value[k]);
}

void get_signals(const io::CheckpointData& d, coupling::State& s) {
  s.guidance.clear();
  s.adhesion.clear();
  s.signal = {};
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  const auto check_none_or_all = [&](const std::string& name, std::size_t found) {
    check_same(d, name, found == 0 ? n_cell : found, n_cell);
  };
  if (d.contains("substances/guidance_force")) {
    const std::vector<Vec3> force = unflatten_points(d.numbers("substances/guidance_force")),
                            heading = unflatten_points(d.numbers("substances/guidance_heading"));
    const std::vector<double>& motility = d.numbers("substances/guidance_motility");
    check_none_or_all("substances/guidance_force", force.size());
    check_same(d, "substances/guidance_motility", motility.size(), force.size());
    check_same(d, "substances/guidance_heading", heading.size(), force.size());
    for (std::size_t k = 0; k < force.size(); ++k)
      s.guidance.push_back({motility[k], force[k], heading[k]});
  }
  if (!d.contains("rules/count")) return;  // files of 0.1.0 have none
  s.adhesion = d.numbers("rules/adhesion");
  check_none_or_all("rules/adhesion", s.adhesion.size());
  s.signal.interval = d.count("rules/interval");
  for (std::int64_t k = 0; k < d.count("rules/count"); ++k) {
    const std::string name = fmt::format("rules/{}", k);
    s.signal.value.push_back(d.numbers(name));
    check_none_or_all(name, s.signal.value.back().size());
  }
}

}  // namespace

void put_substances(const coupling::State& s, io::CheckpointData& d) {
  put_signals(s, d);
  if (s.substance.empty()) return;
  d.put_count("substances/count", std::ssize(s.substance));
  for (std::size_t k = 0; k < s.substance.size(); ++k) {
    const coupling::SubstanceState& field = s.substance[k];
    const std::string name = fmt::format("substances/{}/", k);
    d.put(name + "concentration", field.concentration);
    if (!field.open.empty()) d.put(name + "open", field.open);
    if (!field.inside.cell.empty()) {
      d.put(name + "inside_cell", field.inside.cell);
      d.put(name + "inside_voxel", field.inside.voxel);
      d.put(name + "inside_volume", field.inside.volume);
      d.put(name + "inside_concentration", field.inside.concentration);
    }
    d.put(name + "amounts",
          std::vector{field.secreted, field.entered, field.supplied, field.decayed});
    if (field.layers != substances::Layers{})
      d.put(name + "layers", std::vector<std::int64_t>(field.layers.begin(), field.layers.end()));
  }
}

void get_substances(const io::CheckpointData& d, coupling::State& s) {
  s.substance.clear();
  get_signals(d, s);
  if (!d.contains("substances/count")) return;
  const std::int64_t n = d.count("substances/count");
  for (std::int64_t k = 0; k < n; ++k) {
    const std::string name = fmt::format("substances/{}/", k);
    const std::vector<double>& amounts = d.numbers(name + "amounts");
    check_same(d, name + "amounts", amounts.size(), 4);
    s.substance.push_back(
        {d.numbers(name + "concentration"),
         d.contains(name + "open") ? d.numbers(name + "open") : std::vector<double>{},
         get_insides(d, name + "inside_"), amounts[0], amounts[1], amounts[2], amounts[3],
         get_layers(d, name + "layers")});
  }
}

void check_substances(const coupling::Params& params, const coupling::State& s,
                      const std::string& source) {
  const coupling::SubstanceParams& p = params.substances;
  const auto need = [&](bool fine) {
    check(fine,
          fmt::format("{}: the fields of substances or the signals of rules cannot be. The file is "
                      "damaged or belongs to "
                      "another scene; resume from the previous checkpoint or start anew.",
                      source),
          Exit::kFileError);
  };
  need(s.substance.size() == p.substance.size());
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const coupling::SubstanceState& field = s.substance[k];
    need(field.open.size() == (p.substance[k].is_kept_out() ? p.grid.n_voxel() : 0) &&
         std::ranges::all_of(field.open, [](double open) { return open >= 0 && open <= 1; }));
    need(field.layers == s.substance.front().layers &&
         (p.grows || field.layers == substances::Layers{}));
    need(is_sound(field.inside, p.substance[k].has_membranes(), p.grid.n_voxel()));
    need(field.concentration.size() == p.grid.n_voxel() &&
         std::ranges::all_of(field.concentration, [](double c) { return std::isfinite(c); }));
    for (const double amount : {field.secreted, field.entered, field.supplied, field.decayed})
      need(std::isfinite(amount));
  }
  for (const coupling::Guidance& g : s.guidance)
    need(std::isfinite(g.motility) && g.force.allFinite() && g.heading.allFinite());
  need(std::ranges::all_of(s.adhesion, [](double f) { return f >= 0 && f <= 1; }));
  const std::vector<coupling::SignalRule>& rules = params.rules.rule;
  const std::size_t n_cell = s.dcm.n_lane() + s.cbm.n_cell();
  need(s.signal.value.empty() || s.signal.value.size() == rules.size());
  for (std::size_t k = 0; k < s.signal.value.size(); ++k)
    need(s.signal.value[k].size() == (coupling::is_measured(rules[k].signal) ? n_cell : 0) &&
         std::ranges::all_of(s.signal.value[k], [](double v) { return std::isfinite(v); }));
}

io::FieldFrame make_field_frame(const coupling::World& world, double time) {
  const coupling::SubstanceParams& p = world.params.substances;
  io::FieldFrame frame{time, p.grid.low, p.grid.spacing, p.grid.n, {}};
  for (std::size_t k = 0; k < p.substance.size(); ++k) {
    const std::vector<double>& c = world.state.substance[k].concentration;
    frame.field.push_back({p.substance[k].name, p.substance[k].unit, {c.begin(), c.end()}});
    const std::vector<double>& open = world.state.substance[k].open;
    if (!open.empty())
      frame.field.push_back({p.substance[k].name + "_open", "1", {open.begin(), open.end()}});
    if (p.substance[k].has_membranes())
      frame.field.push_back({p.substance[k].name + "_mean", p.substance[k].unit,
                             mean_of_voxels(p.grid, world.state.substance[k])});
  }
  return frame;
}

}  // namespace acinus::runs
