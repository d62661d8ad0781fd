#include "runs/study/choose_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "core/error.hpp"
#include "runs/study/cost.hpp"

namespace acinus::runs {
namespace {

std::set<std::size_t> wanted(const StudyPlan& plan, const std::vector<std::string>& only) {
  std::set<std::size_t> variants;
  for (const std::string& name : only) {
    const std::vector<std::size_t> found = find_variants(plan.variants, name);
    check(!found.empty(), "--only " + name + ": " + unknown_variant(plan.variants, name));
    variants.insert(found.begin(), found.end());
  }
  std::set<std::size_t> runs;
  for (std::size_t k = 0; k < plan.runs.size(); ++k)
    if (only.empty() || variants.contains(plan.runs[k].variant)) runs.insert(k);
  return runs;
}

/// Number of runs in the chain of starts before run k.
int depth(const StudyPlan& plan, std::size_t k) {
  int n = 0;
  for (int s = plan.runs[k].source; s >= 0; s = plan.runs[s].source) ++n;
  return n;
}

/// Runs of one task. Each run, most expensive first, goes to the task with the least cost so far.
std::set<std::size_t> part_of(const std::set<std::size_t>& runs, const std::vector<double>& cost,
                              int task, int tasks) {
  std::vector<std::size_t> order(runs.begin(), runs.end());
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return cost[a] > cost[b]; });
  std::vector<double> load(tasks, 0);
  std::set<std::size_t> mine;
  for (std::size_t k : order) {
    const auto least = std::ranges::min_element(load);
    *least += cost[k];
    if (least - load.begin() == task - 1) mine.insert(k);
  }
  return mine;
}

}  // namespace

std::vector<ChosenRun> choose_runs(const StudyPlan& plan, const RunChoice& choice) {
  std::vector<double> cost;
  for (const StudyRun& run : plan.runs) cost.push_back(estimate_cost(run.scene, run.source >= 0));
  const std::set<std::size_t> own =
      part_of(wanted(plan, choice.only), cost, choice.task, choice.tasks);
  std::set<std::size_t> all = own;
  for (std::size_t k : own)
    for (int s = plan.runs[k].source; s >= 0; s = plan.runs[s].source) all.insert(s);
  std::vector<ChosenRun> chosen;
  for (std::size_t k : all) chosen.push_back({k, own.contains(k)});
  const auto rank_of_seed = [&](const StudyRun& run) {
    const std::vector<std::int64_t>& seeds = plan.variant_of(run).seeds;
    return std::ranges::find(seeds, static_cast<std::int64_t>(run.seed)) - seeds.begin();
  };
  std::ranges::stable_sort(chosen, [&](const ChosenRun& a, const ChosenRun& b) {
    const auto key = [&](const ChosenRun& c) {
      return std::tuple(rank_of_seed(plan.runs[c.run]), depth(plan, c.run), -cost[c.run]);
    };
    return key(a) < key(b);
  });
  return chosen;
}

}  // namespace acinus::runs
