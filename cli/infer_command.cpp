/// Command `acinus infer`.

#include <memory>

#include "cli/command.hpp"
#include "cli/schedule_flags.hpp"
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
  add_schedule_flags(*command, o.jobs, o.child, o.overwrite);
  command->add_flag("--quiet", o.quiet, "warnings and errors only");
  return {command, [options] { return runs::run_inference(*options); }};
}

}  // namespace acinus::cli
