#include "runs/session/together.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <vector>

#include "core/parallel/threads.hpp"

namespace acinus::runs {
namespace {

/// Host, permitted processors and threads of a process.
struct ProcessPlace {
  std::array<char, 64> host{};
  cpu_set_t processors{};
  int threads = 0;
};

ProcessPlace query_place() {
  ProcessPlace p;
  gethostname(p.host.data(), p.host.size() - 1);
  if (sched_getaffinity(0, sizeof p.processors, &p.processors) != 0)
    for (int k = 0; k < processor_count(); ++k) CPU_SET(k, &p.processors);
  return p;
}

bool shares_all(const ProcessPlace& a, const ProcessPlace& b) {
  return a.host == b.host && CPU_EQUAL(&a.processors, &b.processors) != 0;
}

/// Lists the machines with more threads than processors; empty if there are none.
std::string list_oversubscribed(const std::vector<ProcessPlace>& places) {
  struct NodeLoad {
    cpu_set_t processors{};
    int threads = 0;
  };
  std::map<std::string, NodeLoad> machines;
  for (const ProcessPlace& p : places) {
    NodeLoad& m = machines[p.host.data()];
    CPU_OR(&m.processors, &m.processors, &p.processors);
    m.threads += p.threads;
  }
  std::vector<std::string> crowded;
  for (const auto& [host, m] : machines)
    if (const int n = CPU_COUNT(&m.processors); m.threads > n)
      crowded.push_back(fmt::format("{} threads on {} processors of {}", m.threads, n, host));
  if (crowded.empty()) return {};
  return fmt::format(
      "processors are taken more than once: {}. The run will be slow; start fewer processes, or "
      "give each fewer --threads",
      fmt::join(crowded, ", "));
}

}  // namespace

void check_alike(const Ranks& ranks, const std::string& text, const std::string& what) {
  if (ranks.is_alone()) return;
  std::vector<char> of_root(text.begin(), text.end());
  ranks.broadcast(of_root);
  const bool differs = !std::ranges::equal(of_root, text);
  const auto first = static_cast<int>(ranks.min(differs ? ranks.rank() : ranks.size()));
  check(
      first == ranks.size(),
      fmt::format("process {} of {} has another {} than process 0: start the same program with "
                  "the same arguments everywhere, and keep its files where all machines see them.",
                  first, ranks.size(), what));
}

std::string first_text(const Ranks& ranks, const std::string& text) {
  if (ranks.is_alone() || !ranks.any(!text.empty())) return text;
  std::vector<char> all;
  std::vector<std::size_t> start;
  ranks.gather<char>(std::span(text), all, &start);
  for (std::size_t r = 0; r + 1 < start.size(); ++r)
    if (start[r] < start[r + 1]) return {all.data() + start[r], all.data() + start[r + 1]};
  return {};
}

ThreadShare share_processors(const Ranks& ranks, int wanted) {
  if (ranks.is_alone()) return {wanted > 0 ? wanted : processor_count(), 1, {}};
  ProcessPlace own = query_place();
  std::vector<ProcessPlace> places;
  ranks.gather<ProcessPlace>(std::span(&own, 1), places);
  const auto sharing = static_cast<int>(
      std::ranges::count_if(places, [&](const ProcessPlace& p) { return shares_all(p, own); }));
  own.threads = wanted > 0 ? wanted : std::max(1, CPU_COUNT(&own.processors) / sharing);
  ranks.gather<ProcessPlace>(std::span(&own, 1), places);
  const auto processes = static_cast<int>(
      std::ranges::count_if(places, [&](const ProcessPlace& p) { return p.host == own.host; }));
  return {own.threads, processes, list_oversubscribed(places)};
}

}  // namespace acinus::runs
