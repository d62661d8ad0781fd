#include "bench/step/rank_traffic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "bench/step/step_cost.hpp"
#include "bench/step/step_runner.hpp"
#include "core/parallel/memory.hpp"
#include "core/parallel/ranks.hpp"
#include "coupling/measure/memory_use.hpp"

namespace acinus::bench {
namespace {

/// Mean and maximum over the processes.
struct RankSpread {
  double mean = 0, most = 0;
};
RankSpread spread(const Ranks& ranks, double own) {
  std::vector<double> all;
  ranks.gather<double>(std::span(&own, 1), all);
  double sum = 0;
  for (const double v : all) sum += v;
  return {sum / static_cast<double>(all.size()), *std::ranges::max_element(all)};
}

BenchRow measure_case(const StepCase& c, const Ranks& ranks) {
  StepRunner runner(c, ranks);
  // By wall time: processes that wait use their processor all the same. All take the same sample,
  // that with the root's median.
  std::vector<StepSample> samples;
  for (int r = 0; r < c.repeats; ++r) samples.push_back(runner.measure());
  std::vector<int> order(samples.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = static_cast<int>(k);
  std::ranges::sort(order, {}, [&](int k) { return samples[k].wall; });
  ranks.broadcast(order);
  const StepSample& s = samples[order[order.size() / 2]];
  const double steps = c.steps;
  const auto per_step = [&](std::int64_t count) {
    return spread(ranks, static_cast<double>(count) / steps);
  };
  constexpr double kKilo = 1000;
  const RankSpread messages = per_step(s.traffic.messages),
                   bytes = per_step(s.traffic.message_bytes),
                   gathered = per_step(s.traffic.gathered_bytes),
                   wait = spread(ranks, s.traffic.wait_s / s.wall);
  const coupling::Workspace& work = runner.work();
  BenchRow row{c.name,
               runner.cells(),
               {{"processes", ranks.size()},
                {"wall_ms_per_step", kKilo * s.wall / steps},
                {"cg_iterations_per_step", static_cast<double>(s.cg) / steps},
                {"solves_per_step", static_cast<double>(s.solves) / steps},
                {"messages_per_step", messages.mean},
                {"messages_per_step_most", messages.most},
                {"message_KB_per_step", bytes.mean / kKilo},
                {"message_KB_per_step_most", bytes.most / kKilo},
                {"points_sent", spread(ranks, static_cast<double>(work.op.n_sent_points())).mean},
                {"bodies_sent", spread(ranks, static_cast<double>(work.bodies_sent)).mean},
                {"reductions_per_step", static_cast<double>(s.traffic.reductions) / steps},
                {"gatherings_per_step", static_cast<double>(s.traffic.gatherings) / steps},
                {"gathered_KB_per_step", gathered.mean / kKilo},
                {"wait_share", wait.mean}}};
  for (const StageTime& t : s.stages)
    row.value.emplace_back(t.name + "_ms", kKilo * t.wall / steps);
  if (ranks.is_root()) print_row(row);
  return row;
}

/// Memory by kind of the process that has most, and of its cells with all their neighbours.
BenchRow measure_memory_of(StepCase c, const Ranks& ranks) {
  constexpr double kMega = 1e6;
  const std::uint64_t before = rss_bytes();
  c.warm_up = 2;
  c.once = true;  // no copy of the state
  StepRunner runner(c, ranks);
  const std::vector<TrafficPlace> first = Ranks::traffic_by_place();
  const StepSample s = runner.measure();
  const std::vector<TrafficPlace> last = Ranks::traffic_by_place();
  const auto most = [&](std::uint64_t bytes) {
    return spread(ranks, static_cast<double>(bytes)).most / kMega;
  };
  BenchRow row{c.name, runner.cells(), {{"processes", ranks.size()}}};
  std::uint64_t sum = 0;
  for (const coupling::MemoryUse& use : runner.measure_memory()) {
    row.value.emplace_back(use.kind + "_MB", most(use.bytes));
    sum += use.bytes;
  }
  const std::uint64_t after = rss_bytes();
  row.value.emplace_back("all_kinds_MB", most(sum));
  row.value.emplace_back("resident_MB", most(after - std::min(before, after)));
  row.value.emplace_back("gathered_KB_per_step",
                         static_cast<double>(s.traffic.gathered_bytes) / 1000 / c.steps);
  if (!ranks.is_root()) return row;
  print_row(row);
  for (TrafficPlace p : last) {
    for (const TrafficPlace& f : first)
      if (f.place == p.place) {
        p.calls -= f.calls;
        p.bytes -= f.bytes;
        p.received -= f.received;
      }
    if (p.calls == 0) continue;
    const double steps = c.steps;
    fmt::print("  {:28} per step {:6.1f} calls, {:10.2f} KB handed over, {:10.2f} KB received\n",
               p.place, static_cast<double>(p.calls) / steps,
               static_cast<double>(p.bytes) / 1000 / steps,
               static_cast<double>(p.received) / 1000 / steps);
  }
  return row;
}

}  // namespace

BenchTable bench_rank_memory(const BenchOptions&) {
  const Ranks ranks = Ranks::world();
  constexpr int kSteps = 2;
  BenchTable table;
  for (const int cells : {64, 216})
    table.push_back(measure_memory_of(dcm_case(cells * ranks.size(), "3-point", kSteps), ranks));
  table.push_back(measure_memory_of(cbm_case(20000 * ranks.size(), kSteps, 1), ranks));
  return table;
}

BenchTable bench_ranks(const BenchOptions&) {
  const Ranks ranks = Ranks::world();
  constexpr int kSteps = 20;
  BenchTable table;
  for (const int cells : {64, 216})
    table.push_back(measure_case(dcm_case(cells * ranks.size(), "3-point", kSteps), ranks));
  table.push_back(measure_case(dcm_case(512, "3-point", kSteps), ranks));
  table.push_back(measure_case(cbm_case(100000, kSteps, 3), ranks));
  return table;
}

}  // namespace acinus::bench
