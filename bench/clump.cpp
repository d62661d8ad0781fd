#include "bench/clump.hpp"

#include <fmt/format.h>

#include <map>

#include "coupling/step.hpp"
#include "runs/build_world.hpp"
#include "runs/scene/reader.hpp"

namespace acinus::bench {
namespace {

constexpr double kStep = 120;  // s

void make_clump(int n_cell, Clump& clump) {
  const runs::Scene scene = runs::parse_scene(
      fmt::format(
          R"({{"name": "clump", "time": {{"end": "1 h", "step": "{} s", "adaptive": false, "max_move": 0}},
  "cell_types": {{"cell": {{}}}},
  "cells": {{"source": "clump", "model": "dcm", "count": {}, "spacing": 0.98, "jitter": 0.01}},
  "motility": {{"random": false}}, "contact": {{"quadrature": "3-point"}}}})",
          kStep, n_cell),
      "clump");
  clump.world = runs::build_world(scene, Ranks::serial()).world;
  coupling::size_workspace(clump.world, clump.work);
  for (int k = 0; k < 5; ++k) coupling::advance(clump.world, clump.work, 1e9);
  coupling::find_all_contacts(clump.world, kStep, clump.work);
  coupling::assemble(clump.world, kStep, clump.work);
}

}  // namespace

const Clump& packed_clump(int n_cell) {
  static std::map<int, Clump> made;  // making one takes longer than measuring it
  const auto [at, is_new] = made.try_emplace(n_cell);
  if (is_new) make_clump(n_cell, at->second);
  return at->second;
}

}  // namespace acinus::bench
