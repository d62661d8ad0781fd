#pragma once
/// Flags of commands that run many scenes side by side.

#include "cli/command.hpp"
#include "runs/study/active_run.hpp"

namespace acinus::cli {

/// Flags as options, for rules between them and others.
struct ScheduleFlags {
  CLI::Option *jobs, *threads, *checkpoint, *overwrite;
};

/// Adds --jobs, --threads, --checkpoint-every and --overwrite. What they set must outlive the
/// command.
ScheduleFlags add_schedule_flags(CLI::App& command, int& jobs, runs::ChildRunOptions& child,
                                 bool& overwrite);

}  // namespace acinus::cli
