#include "runs/session/attempts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

const std::string kAttempts = "attempts/";  ///< prefix of the names in the checkpoint

void add_lines(const std::vector<StageTime>& stages, std::vector<std::string>& lines) {
  for (const StageTime& stage : stages)
    lines.push_back(fmt::format("{:20s} {:9.3f} s wall {:9.3f} s CPU {:8d} calls", stage.name,
                                stage.wall, stage.cpu, stage.calls));
}

}  // namespace

Attempts add_attempt(Attempts before, const Timings& timings) {
  ++before.count;
  for (const StageTime& now : timings.stages()) {
    auto found = std::ranges::find(before.stages, now.name, &StageTime::name);
    if (found == before.stages.end()) found = before.stages.insert(found, {now.name, 0.0, 0.0, 0});
    found->wall += now.wall;
    found->cpu += now.cpu;
    found->calls += now.calls;
  }
  return before;
}

std::vector<std::string> describe_stages(const Timings& last, const Attempts& all) {
  std::vector<std::string> lines;
  if (all.count > 1) lines.emplace_back("this attempt:");
  add_lines(last.stages(), lines);
  if (all.count > 1) {
    lines.push_back(fmt::format("all {} attempts:", all.count));
    add_lines(all.stages, lines);
  }
  return lines;
}

void put_attempts(const Attempts& attempts, io::CheckpointData& data) {
  std::string names;  // with blanks, so they cannot be names of arrays
  std::vector<double> wall, cpu;
  std::vector<std::uint64_t> calls;
  for (const StageTime& stage : attempts.stages) {
    names += stage.name + "\n";
    wall.push_back(stage.wall);
    cpu.push_back(stage.cpu);
    calls.push_back(stage.calls);
  }
  data.put_count(kAttempts + "count", attempts.count);
  data.put(kAttempts + "stages", names);
  data.put(kAttempts + "wall_s", wall);
  data.put(kAttempts + "cpu_s", cpu);
  data.put(kAttempts + "calls", calls);
}

Attempts get_attempts(const io::CheckpointData& data) {
  Attempts attempts;
  if (!data.contains(kAttempts + "count")) return attempts;
  attempts.count = data.count(kAttempts + "count");
  const std::vector<double>&wall = data.numbers(kAttempts + "wall_s"),
        &cpu = data.numbers(kAttempts + "cpu_s");
  const std::vector<std::uint64_t>& calls = data.bits(kAttempts + "calls");
  std::istringstream names(data.text(kAttempts + "stages"));
  for (std::string name; std::getline(names, name);) {
    const std::size_t k = attempts.stages.size();
    check(k < wall.size() && k < cpu.size() && k < calls.size(),
          data.source() + ": the times of the run's stages are damaged.", Exit::kFileError);
    attempts.stages.push_back({name, wall[k], cpu[k], calls[k]});
  }
  return attempts;
}

}  // namespace acinus::runs
