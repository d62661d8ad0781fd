#pragma once
/// Study ready to run: its variants and its runs with resolved scenes.

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runs/scene/scene.hpp"
#include "runs/study/study.hpp"
#include "runs/study/variants.hpp"

namespace acinus::runs {

/// One simulation of a study.
struct StudyRun {
  std::size_t variant = 0;  ///< index into the plan's variants
  std::uint64_t seed = 0;
  std::string name;    ///< "III/seed_2"
  std::string folder;  ///< relative to the study's folder: "runs/III/seed_2"
  Scene scene;         ///< without start_up.from
  int source = -1;     ///< index of the run whose state at t = 0 it takes; -1 = none
  /// Hash of everything the run depends on: its scene and those it starts from.
  std::string identity;
  /// Folder (relative to the study's) and resolved scene of the runs it starts from, nearest first.
  std::vector<std::pair<std::string, std::string>> sources;
};

/// Study with its variants and runs.
struct StudyPlan {
  Study study;
  std::vector<Variant> variants;
  std::vector<StudyRun> runs;                ///< by variant, then by seed
  std::map<std::string, std::string> units;  ///< unit of every observable of the runs, by name
  const Variant& variant_of(const StudyRun& run) const { return variants[run.variant]; }
};

}  // namespace acinus::runs
