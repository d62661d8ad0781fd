#include "runs/session/start_frame.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "coupling/simulation.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/assemble/shipped_laws.hpp"
#include "runs/experiments/snapshot.hpp"
#include "runs/session/make_frame.hpp"

namespace acinus::runs {
namespace {

/// Gives all cells the volume that they grow to in the start-up.
void grow_at_once(coupling::State& s) {
  for (std::size_t lane = 0; lane < s.dcm.n_lane(); ++lane) {
    if (!s.dcm.active(lane)) continue;
    const double from = s.dcm.volume[lane].from, to = s.dcm.volume[lane].to;
    dcm::scale_cell(std::cbrt(to / from), lane, s.dcm);
    s.dcm.volume[lane].from = to;
  }
  for (auto& volume : s.cbm.volume) volume.from = volume.to;
}

/// Removes the columns that say nothing before the first step.
void keep_sizes(io::Table& cells) {
  constexpr std::array<std::string_view, 3> kSizes{"center", "radius", "volume"};
  std::erase_if(cells.columns,
                [&](const io::Column& c) { return std::ranges::count(kSizes, c.name) == 0; });
}

}  // namespace

StartFrame make_start_frame(const Scene& asked) {
  Scene scene = asked;
  use_shipped_laws(scene);
  leave_out_calibrations(scene);
  BuiltWorld built = build_world(scene, Ranks::serial());
  StartFrame start;
  start.notes = std::move(built.notes);
  start.vessel_length = built.vessel_length;
  if (scene.start_up.enabled && scene.start_up.from.empty()) grow_at_once(built.world.state);
  const coupling::State& state = built.world.state;
  start.deformable = dcm::count_cells(state.dcm);
  start.spheres = static_cast<int>(state.cbm.n_cell());
  coupling::Simulation simulation(std::move(built.world));
  const coupling::World& world = simulation.world();
  const Snapshot snapshot = take_snapshot(world, simulation.work());
  start.frame =
      make_frame(world, simulation.work(), snapshot, draw_boundary(world.params.boundary));
  start.frame.time_s = 0;
  keep_sizes(start.frame.cells);
  start.frame.interface = start.frame.contacts = {};
  return start;
}

}  // namespace acinus::runs
