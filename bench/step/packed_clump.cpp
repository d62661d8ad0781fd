#include "bench/step/packed_clump.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "coupling/step/controller.hpp"
#include "coupling/step/step.hpp"
#include "coupling/step/workspace_size.hpp"
#include "runs/assemble/build_world.hpp"
#include "runs/experiments/read_scene.hpp"

namespace acinus::bench {

std::string packed_clump_text(const PackedClump& clump) {
  const std::string steps =
      clump.step ? fmt::format(R"(, "step": "{} s", "adaptive": false, "max_move": 0)", *clump.step)
                 : "";
  const std::string skin = clump.skin ? fmt::format(R"(, "skin": "{} um")", *clump.skin) : "";
  const std::string solver =
      clump.tolerance ? fmt::format(R"("solver": {{"tolerance": {}}}, )", *clump.tolerance) : "";
  return fmt::format(
      R"({{"name": "clump", "time": {{"end": "12 h"{}}}, {}
  "cell_types": {{"cell": {{"dcm": {{"nodes": {}, "local_area_modulus": "{} N/m", "nucleus": {}}}}}}},
  "cells": {{"source": "clump", "model": "dcm", "count": {}, "spacing": 0.98, "jitter": 0.01}},
  "motility": {{"random": false}}, "contact": {{"quadrature": "{}"{}}}}})",
      steps, solver, clump.nodes, clump.local_area_modulus, clump.nucleus, clump.count,
      clump.quadrature, skin);
}

void grow(coupling::World& world) {
  for (Ramp& v : world.state.dcm.volume) v = {v.from, 2 * v.from, 0, 86400};
}

AssembledClump::AssembledClump(const PackedClump& clump) {
  ACINUS_ASSERT(clump.step);
  world = runs::build_world(runs::parse_scene(packed_clump_text(clump), "clump"), Ranks::serial())
              .world;
  coupling::size_workspace(world, work);
  for (int k = 0; k < 5; ++k) coupling::take_step(world, work, 1e9);
  coupling::assemble(world, *clump.step, work);
}

}  // namespace acinus::bench
