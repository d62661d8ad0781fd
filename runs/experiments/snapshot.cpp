#include "runs/experiments/snapshot.hpp"

#include "coupling/measure/pair_contacts.hpp"

namespace acinus::runs {

Snapshot take_snapshot(const coupling::World& world, coupling::Workspace& work) {
  coupling::observe(world, work);
  return {coupling::time_since_start(world), coupling::measure_cells(world, work),
          coupling::interface_forces(world, work)};
}

}  // namespace acinus::runs
