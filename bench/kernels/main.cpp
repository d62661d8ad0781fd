/// Entry point of the kernel benchmarks: Google Benchmark on one thread.

#include <benchmark/benchmark.h>

#include "acinus_version.hpp"
#include "core/parallel/machine.hpp"
#include "core/parallel/threads.hpp"

int main(int argc, char** argv) {
  // A kernel is what one thread does; the CPU time reported is that of the calling thread alone.
  acinus::set_threads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const acinus::Machine machine = acinus::describe_machine();
  benchmark::AddCustomContext("commit", ACINUS_GIT);
  benchmark::AddCustomContext("processor", machine.cpu_model);
  benchmark::AddCustomContext("instruction set", machine.instruction_set);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
