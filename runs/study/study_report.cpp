#include "runs/study/study_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "acinus_version.hpp"
#include "io/disk.hpp"
#include "io/file_lock.hpp"
#include "runs/study/study_data.hpp"
#include "runs/study/study_maps.hpp"
#include "runs/study/study_plots.hpp"
#include "runs/study/study_progress.hpp"
#include "runs/study/study_value.hpp"
#include "runs/study/verdicts.hpp"

namespace acinus::runs {
namespace {

/// Escapes a text for a cell of a Markdown table.
std::string cell(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
    text.insert(at, 1, '\\');
  return text;
}

std::string show_range(const Measured& m) {
  if (!m.value) return "-";
  const std::string value = show_value(*m.value, m.unit);
  if (!m.low || m.by_seed.size() < 2) return value;
  return fmt::format("{} [{}, {}]", value, show_value(*m.low, m.unit), show_value(*m.high, m.unit));
}

std::string verdict_table(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return {};
  std::string text =
      "## Claims\n\nMeasured: mean over the seeds [smallest, largest].\n\n"
      "| | claim | expected | measured | verdict |\n|---|---|---|---|---|\n";
  for (const Verdict& v : verdicts) {
    std::string verdict = name_of(v.status);
    if (v.status == ClaimStatus::kDoesNotHold) verdict = "**" + verdict + "**";
    if (!v.measured.note.empty()) verdict += ": " + v.measured.note;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", v.id, cell(v.claim), cell(v.expected),
                        cell(show_range(v.measured)), cell(verdict));
  }
  text += "\nHow each is measured:\n\n";
  for (const Verdict& v : verdicts) text += fmt::format("- {}: {}\n", v.id, v.how);
  return text + "\n";
}

std::string setting_list(const Variant& v) {
  std::string text;
  for (auto s = v.set.begin(); s != v.set.end(); ++s) {
    const auto same_key = [&](const Setting& later) { return later.value.name == s->value.name; };
    if (std::any_of(s + 1, v.set.end(), same_key)) continue;
    text +=
        fmt::format("{}{} = {}", text.empty() ? "" : ", ", s->value.name, shown(s->value.value));
  }
  return text.empty() ? "as the scene" : text;
}

std::string variant_table(const StudyPlan& plan, const StudyData& data) {
  std::string text =
      "## Variants\n\n| variant | changes to the scene | start | seeds | done | CPU of a run |\n"
      "|---|---|---|---|---|---|\n";
  for (std::size_t v = 0; v < plan.variants.size(); ++v) {
    const Variant& variant = plan.variants[v];
    int done = 0;
    double cpu = 0;
    for (std::size_t k = 0; k < plan.runs.size(); ++k)
      if (plan.runs[k].variant == v && data[k].status.state == RunState::kDone) {
        ++done;
        cpu += data[k].status.cpu_s;
      }
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} |\n", cell(variant.name), cell(setting_list(variant)),
        variant.start.empty() ? "its own" : cell("that of " + variant.start),
        fmt::join(variant.seeds, ", "), done, done > 0 ? short_duration(cpu / done) : "-");
  }
  return text + "\n";
}

std::string unfinished(const StudyPlan& plan, const StudyData& data) {
  std::string text;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const RunStatus& s = data[k].status;
    if (s.state == RunState::kDone) continue;
    text += fmt::format("| {} | {} | {} | {} |\n", cell(plan.runs[k].name), name_of(s.state),
                        data[k].until > 0 ? show_value(data[k].until, "s") : "-", cell(s.cause));
  }
  if (text.empty()) return {};
  return "## Runs that are not done\n\n| run | state | recorded until | cause "
         "|\n|---|---|---|---|\n" +
         text +
         "\nA failed run is tried again with `--overwrite`, or once its folder is removed; one "
         "that was "
         "refused or killed whenever the study is started.\n\n";
}

/// Markdown list of the runs that take their start from another run.
std::string start_list(const StudyPlan& plan, const StudyData& data) {
  std::string lines;
  for (std::size_t k = 0; k < plan.runs.size(); ++k) {
    const StudyRun& run = plan.runs[k];
    if (run.source < 0) continue;
    const std::string& hash = data[k].status.start_hash;
    lines += fmt::format("- {}: cells at t = 0 of {}{}\n", run.name, plan.runs[run.source].name,
                         hash.empty() ? "" : " (state " + hash + ")");
  }
  if (lines.empty()) return {};
  return "## Shared starts\n\nThese runs did not place and settle cells of their own.\n\n" + lines +
         "\n";
}

std::string head(const StudyPlan& plan, const StudyData& data, const ReportCounts& n) {
  std::set<std::string> versions;
  double cpu = 0;
  for (const RunData& d : data) {
    if (!d.status.version.empty())
      versions.insert(fmt::format("{} ({})", d.status.version, d.status.git));
    cpu += d.status.cpu_s;
  }
  const Study& s = plan.study;
  std::string text = fmt::format("# {}\n\n", s.name);
  if (!s.description.empty()) text += s.description + ".\n\n";
  text += fmt::format(
      "Scene {}. {} runs: {} done, {} failed, {} missing; {} of CPU. Made by acinus {}; report by "
      "{} ({}).\n\n",
      s.scene, plan.runs.size(), n.done, n.failed, n.missing, short_duration(cpu),
      versions.empty() ? "-" : fmt::format("{}", fmt::join(versions, ", ")), ACINUS_VERSION,
      ACINUS_GIT);
  return text;
}

std::string plot_list(const std::vector<std::string>& files) {
  std::string text =
      "## Plots\n\nLine: mean over the seeds; band: smallest to largest. Maps: share of the seeds "
      "that "
      "bear the claim out, with their mean (the median if some never do).\n\n";
  for (const std::string& file : files) text += fmt::format("![{0}](plots/{0})\n\n", file);
  return files.empty() ? "" : text;
}

}  // namespace

ReportCounts write_study_report(const StudyPlan& plan, const std::string& root) {
  const io::FileLock writing = io::FileLock::take(root + "/report.lock");
  const StudyData data = read_study_data(plan, root);
  const std::vector<Verdict> verdicts = check_claims(plan, data);
  ReportCounts n;
  for (const Verdict& v : verdicts)
    ++(v.status == ClaimStatus::kHolds         ? n.holds
       : v.status == ClaimStatus::kDoesNotHold ? n.does_not_hold
                                               : n.not_measured);
  for (const RunData& d : data)
    ++(d.status.state == RunState::kDone ? n.done
       : has_failed(d.status.state)      ? n.failed
                                         : n.missing);
  write_table(plan, data, root);
  write_runs(plan, data, root);
  write_verdicts(verdicts, root);
  std::vector<std::string> plots = write_plots(plan, data, root);
  std::ranges::copy(write_maps(plan, data, root), std::back_inserter(plots));
  io::write_text_file(root + "/report.md", head(plan, data, n) + verdict_table(verdicts) +
                                               unfinished(plan, data) + plot_list(plots) +
                                               variant_table(plan, data) + start_list(plan, data));
  return n;
}

}  // namespace acinus::runs
