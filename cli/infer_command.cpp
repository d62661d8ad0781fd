/// Command `acinus infer`.

#include <memory>

#include "cli/command.hpp"
#include "cli/wall_time.hpp"
#include "runs/infer/run_inference.hpp"

namespace acinus::cli {

Command add_infer(CLI::App& app) {
  CLI::App* command = add_command(
      app, "infer", "infer scene keys from measured values: priors, simulations, posterior",
      "acinus infer friction.json --jobs 2");
  const auto options = std::make_shared<runs::InferenceOptions>();
  runs::InferenceOptions& o = *options;
  command->add_option("FILE", o.file, "inference file: scene, parameters, target")->required();
  command->add_option("--out", o.out, "folder (default: <name>.infer in this folder)")
      ->type_name("DIR");
  command->add_option("--jobs", o.jobs, "runs at once (default: cores over threads)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_option("--threads", o.child.threads, "threads of each run (default: 1)")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command
      ->add_option_function<std::string>(
          "--checkpoint-every",
          [&o](const std::string& text) { o.child.checkpoint_every_s = parse_wall_time(text); },
          "wall time between checkpoints of a run (default: 2min)")
      ->type_name("WALL");
  command->add_flag("--overwrite", o.overwrite,
                    "run again what failed, or was made from another scene or version");
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  return {command, [options] { return runs::run_inference(*options); }};
}

}  // namespace acinus::cli
