#include "bench/step/step_runner.hpp"

#include <malloc.h>

#include <algorithm>

#include "bench/step/packed_clump.hpp"
#include "core/error.hpp"
#include "core/parallel/clock.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/workspace_size.hpp"
#include "coupling/world/state_parts.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::bench {
namespace {

/// Allocated heap, bytes. Unlike the resident size it is independent of memory that earlier cases
/// of the process left for reuse.
std::uint64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

Traffic difference(const Traffic& a, const Traffic& b) {
  return {a.messages - b.messages,     a.message_bytes - b.message_bytes,
          a.reductions - b.reductions, a.reduction_bytes - b.reduction_bytes,
          a.gatherings - b.gatherings, a.gathered_bytes - b.gathered_bytes,
          a.wait_s - b.wait_s};
}

}  // namespace

StepRunner::StepRunner(const StepCase& c, const Ranks& ranks) : case_(c) {
  const std::uint64_t before = heap_bytes();
  world_ = runs::build_world(runs::parse_scene(c.scene, c.name), ranks).world;
  if (c.grows) grow(world_);
  coupling::size_workspace(world_, work_);
  advance(c.warm_up);
  const std::uint64_t after = heap_bytes();
  bytes_ = after - std::min(before, after);
  if (!case_.once) saved_ = world_.state;
  first_ = world_.state.clock;
}

StepSample StepRunner::measure() {
  if (!case_.once) world_.state = saved_;
  work_.timings.clear();
  const Traffic traffic = Ranks::traffic();
  const double cpu = cpu_seconds(), wall = wall_seconds();
  advance(case_.steps);
  return {cpu_seconds() - cpu,
          wall_seconds() - wall,
          difference(Ranks::traffic(), traffic),
          work_.timings.stages(),
          world_.state.clock.cg_iterations - first_.cg_iterations,
          world_.state.clock.solves - first_.solves,
          coupling::hash_state(world_.ranks, world_.state)};
}

StepSample StepRunner::measure_median() {
  std::vector<StepSample> samples;
  for (int r = 0; r < case_.repeats; ++r) samples.push_back(measure());
  std::ranges::sort(samples, {}, &StepSample::cpu);
  return samples[samples.size() / 2];
}

int StepRunner::cells() const { return coupling::count_cells(world_.state); }

double StepRunner::contacts_per_cell() const {
  return static_cast<double>(work_.system.links.size() + work_.system.point_links.size()) / cells();
}

double StepRunner::bytes_per_cell() const { return static_cast<double>(bytes_) / cells(); }

void StepRunner::advance(int steps) {
  for (int k = 0; k < steps; ++k) {
    if (case_.always_coarse) world_.state.clock.coarse = true;
    const coupling::StepResult r = coupling::take_step(world_, work_, 1e9);
    check(r.accepted, case_.name + ": a step failed: " + r.cause, Exit::kCannotContinue);
  }
}

}  // namespace acinus::bench
