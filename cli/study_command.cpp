/// Command `acinus study`.

#include <memory>

#include "cli/command.hpp"
#include "cli/schedule_flags.hpp"
#include "runs/study/run_study.hpp"

namespace acinus::cli {

Command add_study(CLI::App& app) {
  CLI::App* command = add_command(
      app, "study", "run the variants and seeds of a study side by side, and check its claims",
      "acinus study example --jobs 2");
  const auto options = std::make_shared<runs::StudyOptions>();
  runs::StudyOptions& o = *options;
  command->add_option("FILE", o.file, "study file, or the name of a shipped study")->required();
  command->add_option("--out", o.out, "folder (default: <study name>.study in this folder)")
      ->type_name("DIR");
  const ScheduleFlags schedule = add_schedule_flags(*command, o.jobs, o.child, o.overwrite);
  CLI::Option* tasks =
      command->add_option("--tasks", o.choice.tasks, "for job arrays: split the runs in N parts")
          ->type_name("N")
          ->check(CLI::Range(1, 100000));
  CLI::Option* task = command->add_option("--task", o.choice.task, "which part, from 1")
                          ->type_name("I")
                          ->check(CLI::Range(1, 100000))
                          ->needs(tasks);
  tasks->needs(task);
  CLI::Option* only =
      command
          ->add_option("--only", o.choice.only,
                       "only this variant, NAME/* for what sweeps made of it; may be repeated")
          ->type_name("VARIANT")
          ->allow_extra_args(false);
  CLI::Option* dry = command->add_flag("--dry-run", o.dry_run,
                                       "list runs, their state and expected cost; run nothing");
  CLI::Option* quiet = command->add_flag("--quiet", o.quiet, "warnings and errors only");
  CLI::Option* report =
      command->add_flag("--report", o.report_only, "report from what is there; run nothing");
  for (CLI::Option* idle : {dry, schedule.jobs, schedule.threads, tasks, task, only,
                            schedule.checkpoint, schedule.overwrite})
    report->excludes(idle);
  for (CLI::Option* idle : {schedule.checkpoint, schedule.overwrite, quiet}) dry->excludes(idle);
  return {command, [options] { return runs::run_study(*options); }};
}

}  // namespace acinus::cli
