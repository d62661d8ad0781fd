/// Two deformable cells and a sphere that touch: an hour, then the pressures. Base units: um, s,
/// nN.

#include <cstdio>

#include "coupling/measure/measure.hpp"
#include "coupling/simulation.hpp"
#include "geometry/topology.hpp"

using namespace acinus;

int main() {
  coupling::World world;

  world.params.dcm = {dcm::Params{}};  // the constants that scenes have by default
  world.params.cbm = {cbm::Params{}};
  world.params.motility.random = false;

  const geometry::Topology* mesh = &geometry::shared_icosphere(162);
  world.state.dcm =
      dcm::make_state({{.lineage = 0, .topology = mesh, .center = {0, 0, 0}, .radius = 12},
                       {.lineage = 1, .topology = mesh, .center = {23, 0, 0}, .radius = 12}});
  world.state.cbm =
      cbm::make_state({{.lineage = 2, .center = {11, 20, 0}, .radius = 12, .young = 0.45}});

  coupling::Simulation simulation(std::move(world));
  const coupling::LoopResult result = simulation.run_until(3600);
  if (!result.ok) {
    std::printf("stopped: %s\n", result.last.cause.c_str());
    return 1;
  }
  coupling::observe(simulation.world(), simulation.work());
  for (const auto& cell : coupling::measure_cells(simulation.world(), simulation.work()))
    std::printf("cell %ld at x = %6.2f um: %7.2f Pa from contacts, %d neighbours\n",
                static_cast<long>(cell.id), cell.center.x(), 1e3 * cell.pressure, cell.contacts);
}
