#include "runs/infer/run_inference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "runs/infer/particle_runs.hpp"
#include "runs/infer/posterior.hpp"

namespace acinus::runs {

int run_inference(InferenceOptions options) {
  check(options.child.checkpoint_every_s > 0, "--checkpoint-every: must be > 0");
  const InferencePlan plan = read_inference(options.file);
  const Inference& inference = plan.inference;
  if (options.out.empty()) options.out = inference.name + ".infer";
  options.out = std::filesystem::absolute(options.out).lexically_normal().string();
  check(is_utf8(options.out),
        fmt::format("{}: the name is not UTF-8. Choose another --out.", as_utf8(options.out)));
  if (options.jobs <= 0) options.jobs = std::max(1, processor_count() / options.child.threads);
  ParticleRuns runs(plan,
                    {options.out, options.jobs, options.child, options.overwrite, options.quiet});
  const Simulate simulate = [&](std::span<const Proposal> proposals) {
    if (!options.quiet)
      fmt::print("population {}: {} simulations from number {} on\n", proposals.front().population,
                 proposals.size(), proposals.front().index);
    return runs.simulate(proposals);
  };
  const Sampled sampled = inference.method == InferenceMethod::kAbc
                              ? sample_abc(plan.prior, inference.abc, simulate)
                              : scan_grid(plan.prior, inference.steps,
                                          static_cast<int>(runs.target().size()), simulate);
  if (sampled.stopped) {
    if (!options.quiet) fmt::print("stopped; the same command goes on\n");
    return static_cast<int>(Exit::kStopped);
  }
  const std::string summary = write_posterior(plan, runs, sampled, options.out);
  if (!options.quiet) fmt::print("{}{}/report.md\n", summary, options.out);
  return static_cast<int>(Exit::kDone);
}

}  // namespace acinus::runs
