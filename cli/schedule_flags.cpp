#include "cli/schedule_flags.hpp"

#include "cli/wall_time.hpp"

namespace acinus::cli {

ScheduleFlags add_schedule_flags(CLI::App& command, int& jobs, runs::ChildRunOptions& child,
                                 bool& overwrite) {
  ScheduleFlags flags{};
  flags.jobs = command.add_option("--jobs", jobs, "runs at once (default: cores over threads)")
                   ->type_name("N")
                   ->check(CLI::Range(1, 4096));
  flags.threads =
      command.add_option("--threads", child.threads, "threads of each run (default: 1)")
          ->type_name("N")
          ->check(CLI::Range(1, 4096));
  flags.checkpoint = command
                         .add_option_function<std::string>(
                             "--checkpoint-every",
                             [&child](const std::string& text) {
                               child.checkpoint_every_s = parse_wall_time(text);
                             },
                             "wall time between checkpoints of a run (default: 2min)")
                         ->type_name("WALL");
  flags.overwrite = command.add_flag(
      "--overwrite", overwrite, "run again what failed, or was made from another scene or version");
  return flags;
}

}  // namespace acinus::cli
