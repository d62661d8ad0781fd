#include "core/parallel/machine.hpp"

#include "core/parallel/system_entry.hpp"
#include "core/parallel/threads.hpp"

namespace acinus {

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
  machine.cpu_model = read_system_entry("/proc/cpuinfo", "model name");
  if (machine.cpu_model.empty()) machine.cpu_model = "unknown";
  machine.cores = processor_count();
  machine.instruction_set = best_instruction_set();
  return machine;
}

}  // namespace acinus
