#include "runs/study/run_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/error.hpp"
#include "core/parallel/threads.hpp"
#include "runs/scene/json_text.hpp"
#include "runs/session/shell_quote.hpp"
#include "runs/study/expected_cost.hpp"
#include "runs/study/read_study.hpp"
#include "runs/study/run_status.hpp"
#include "runs/study/scheduler.hpp"
#include "runs/study/shipped_studies.hpp"
#include "runs/study/study_folder.hpp"
#include "runs/study/study_progress.hpp"
#include "runs/study/study_report.hpp"

namespace acinus::runs {
namespace {

namespace fs = std::filesystem;

void list_runs(const StudyPlan& plan, const StudyOptions& options) {
  const ExpectedCosts costs(plan, options.out);
  std::size_t width = 3;
  for (const StudyRun& run : plan.runs) width = std::max(width, run.name.size());
  double left = 0, longest = 0;
  int n = 0, to_do = 0, rough = 0;
  fmt::print("{:{}}  {:26}  {:>10}  {}\n", "run", width, "state", "CPU time", "expected from");
  for (const ChosenRun& c : choose_runs(plan, options.choice)) {
    const StudyRun& run = plan.runs[c.run];
    const RunStatus status = inspect_run(options.out, run);
    const bool done = status.state == RunState::kDone || status.state == RunState::kFailed;
    const double cost = done ? status.cpu_s : costs.cpu_s(run);
    const bool measured = costs.is_measured(run);
    fmt::print("{:{}}  {:26}  {:>10}  {}\n", run.name, width, name_of(status.state),
               short_duration(cost),
               done       ? "measured"
               : !c.own   ? "only if its start is needed here"
               : measured ? "runs of this variant"
                          : "cells x steps, roughly");
    if (!c.own) continue;
    ++n;
    if (done) continue;
    ++to_do;
    rough += measured ? 0 : 1;
    left += cost;
    longest = std::max(longest, cost);
  }
  const int jobs = std::max(1, options.jobs);
  fmt::print(
      "{} runs, {} left: about {} of CPU, {} with {} at once{}\n", n, to_do, short_duration(left),
      short_duration(std::max(left / jobs, longest)), jobs,
      rough > 0 ? fmt::format("; {} of them estimated within a factor of three", rough) : "");
}

void print_counts(const ReportCounts& n, const std::string& root) {
  fmt::print(
      "{} runs done, {} failed, {} missing; claims: {} hold, {} do not, {} not measured\n{}/"
      "report.md\n",
      n.done, n.failed, n.missing, n.holds, n.does_not_hold, n.not_measured, root);
}

}  // namespace

int run_study(StudyOptions options) {
  const RunChoice& choice = options.choice;
  check(choice.task <= choice.tasks,
        fmt::format("--task {}: there are {} tasks, numbered from 1", choice.task, choice.tasks));
  check(options.child.checkpoint_every_s > 0, "--checkpoint-every: must be > 0");
  const StudyPlan plan = read_study(find_study(options.file));
  if (options.out.empty()) options.out = plan.study.name + ".study";
  options.out = fs::absolute(options.out).lexically_normal().string();
  if (options.jobs <= 0) options.jobs = std::max(1, processor_count() / options.child.threads);
  for (const std::string& name : {options.out, options.file})
    check(is_utf8(name), fmt::format("{}: the name is not UTF-8, but studies write it into scene "
                                     "files. Rename it, or choose another --out.",
                                     as_utf8(name)));
  const std::vector<ChosenRun> chosen = choose_runs(plan, choice);
  check_study_folder(options.out, plan);
  if (options.dry_run) {
    list_runs(plan, options);
    return 0;
  }
  make_study_folder(options.out, plan);
  ScheduleResult result;
  if (!options.report_only)
    result = run_all(plan, chosen,
                     {options.out, options.jobs, options.child, options.overwrite, options.quiet});
  if (choice.tasks == 1 || options.report_only) {
    const ReportCounts n = write_study_report(plan, options.out);
    if (!options.quiet) print_counts(n, options.out);
  } else if (!options.quiet) {
    fmt::print(
        "task {} of {}: {} done, {} failed, {} left; when all tasks are done: acinus study "
        "{} --out {} --report\n",
        choice.task, choice.tasks, result.done, result.failed, result.left,
        quote_for_shell(options.file), quote_for_shell(options.out));
  }
  if (result.stopped) return static_cast<int>(Exit::kStopped);
  return static_cast<int>(result.failed > 0 ? Exit::kCannotContinue : Exit::kDone);
}

}  // namespace acinus::runs
