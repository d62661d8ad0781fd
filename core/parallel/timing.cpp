#include "core/parallel/timing.hpp"

#include <sys/resource.h>

#include <fstream>

#include "core/parallel/clock.hpp"
#include "core/parallel/threads.hpp"

namespace acinus {

namespace {

// First value of "key : value" in a text file of the system, or an empty string.
std::string read_entry(const char* path, std::string_view key) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t colon = line.find(':');
    const std::size_t begin = line.find_first_not_of(" \t", colon + 1);
    if (colon != std::string::npos && begin != std::string::npos) return line.substr(begin);
  }
  return {};
}

}  // namespace

std::uint64_t rss_bytes() {
  const std::string entry = read_entry("/proc/self/status", "VmRSS");
  return entry.empty() ? 0 : 1024 * std::stoull(entry);
}

std::uint64_t peak_rss_bytes() {
  // getrusage comes second: its peak survives exec, so it may be that of the starting shell.
  const std::string entry = read_entry("/proc/self/status", "VmHWM");
  if (!entry.empty()) return 1024 * std::stoull(entry);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::uint64_t>(usage.ru_maxrss);
}

Timings::Scope::Scope(Timings& timings, std::string_view stage)
    : timings_(timings),
      stage_(timings.find_or_add(stage)),
      wall_(wall_seconds()),
      cpu_(cpu_seconds()),
      thread_cpu_(thread_cpu_seconds()) {}

Timings::Scope::~Scope() {
  if (stage_ >= timings_.stages_.size()) return;  // cleared while this scope was open
  StageTime& stage = timings_.stages_[stage_];
  stage.thread_cpu += thread_cpu_seconds() - thread_cpu_;
  stage.cpu += cpu_seconds() - cpu_;
  stage.wall += wall_seconds() - wall_;
  ++stage.calls;
}

StageTime Timings::stage(std::string_view name) const {
  for (const StageTime& stage : stages_) {
    if (stage.name == name) return stage;
  }
  return {std::string(name), 0.0, 0.0, 0.0, 0};
}

std::size_t Timings::find_or_add(std::string_view name) {
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (stages_[i].name == name) return i;
  }
  stages_.push_back({std::string(name), 0.0, 0.0, 0.0, 0});
  return stages_.size() - 1;
}

std::string_view best_instruction_set() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f")) return "avx512f";
  if (__builtin_cpu_supports("avx2")) return "avx2";
  return "sse2";
#else
  return "generic";
#endif
}

Machine describe_machine() {
  Machine machine;
  machine.cpu_model = read_entry("/proc/cpuinfo", "model name");
  if (machine.cpu_model.empty()) machine.cpu_model = "unknown";
  machine.cores = processor_count();
  machine.instruction_set = best_instruction_set();
  return machine;
}

}  // namespace acinus
