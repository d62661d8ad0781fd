#include "bench/work_precision/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "bench/tissue/patch.hpp"
#include "bench/work_precision/work_precision_report.hpp"
#include "bench/work_precision/work_precision_scenes.hpp"
#include "core/error.hpp"
#include "io/disk.hpp"

namespace acinus::bench {
namespace {

/// Results of a case.
struct CaseReport {
  std::string text;  ///< Markdown
  BenchTable rows;
  std::vector<PrecisionOutcome> time, space;
  std::vector<std::vector<PrecisionOutcome>> study;  ///< time-stepping studies, one by one
};

/// Appends to the text and prints it.
void say(CaseReport& report, const std::string& text) {
  report.text += text;
  fmt::print("{}", text);
  std::fflush(stdout);
}

CaseReport run_case(const WorkCase& c, WarmScene& scene) {
  CaseReport report;
  auto run = [&](const PrecisionStudy& study, std::vector<PrecisionOutcome>& all) {
    say(report, table_head(c.scene, study));
    std::vector<PrecisionOutcome> outcomes =
        run_study(scene, study, [&](const PrecisionOutcome& e) {
          say(report, table_line(c.scene, e));
          report.rows.push_back(bench_row(c.scene, study.title, e));
        });
    all.insert(all.end(), outcomes.begin(), outcomes.end());
    return outcomes;
  };
  for (const PrecisionStudy& s : c.time) report.study.push_back(run(s, report.time));
  for (const PrecisionStudy& s : c.space) run(s, report.space);
  return report;
}

void write_case(const WorkCase& c, const CaseReport& report, const std::string& folder) {
  if (folder.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  check(!failed,
        fmt::format("{}: cannot be made: {}. Choose another folder.", folder, failed.message()),
        Exit::kFileError);
  const std::string stem = (std::filesystem::path(folder) / c.scene.name).string();
  io::write_text_file(stem + ".md", report.text);
  const bool strain = c.scene.axis != Vec3::Zero();
  auto plot = [&](const std::vector<PrecisionOutcome>& outcomes, const char* kind,
                  const std::string& file) {
    if (outcomes.empty()) return;
    const std::string title = fmt::format("{}: {}", c.scene.title, kind);
    io::write_plot(
        stem + file + (strain ? "_strain.svg" : "_pressure.svg"),
        make_plot(c.scene, title, outcomes, strain ? "strain error, %" : "pressure error, %",
                  [](const PrecisionOutcome& e) { return 100 * e.main_error; }));
    if (!strain)
      io::write_plot(
          stem + file + "_force.svg",
          make_plot(c.scene, title, outcomes, "contact force error, %",
                    [](const PrecisionOutcome& e) { return 100 * e.error.contact_force; }));
  };
  plot(report.time, "time stepping", "");
  plot(report.space, "mesh and quadrature", "_mesh");
}

BenchTable bench_case(const WorkCase& c, const BenchOptions& options) {
  WarmScene scene(c.scene);
  CaseReport report = run_case(c, scene);
  say(report, "\n" + cheapest_text(c.scene, report.time));
  write_case(c, report, options.folder);
  return report.rows;
}

/// Outcomes of one integrator with fixed steps.
std::vector<PrecisionOutcome> of_method(const std::vector<PrecisionOutcome>& outcomes,
                                        coupling::Integrator method) {
  std::vector<PrecisionOutcome> own;
  std::ranges::copy_if(outcomes, std::back_inserter(own), [&](const PrecisionOutcome& e) {
    return e.setting.integrator == method && !e.setting.adaptive;
  });
  return own;
}

/// Successful outcome with the longest step up to `most` (s), since a short window excludes longer
/// ones; null if there is none.
const PrecisionOutcome* find_longest_step(const std::vector<PrecisionOutcome>& outcomes,
                                          double most) {
  const PrecisionOutcome* longest = nullptr;
  for (const PrecisionOutcome& e : outcomes)
    if (e.failure.empty() && e.setting.step <= most &&
        (!longest || e.setting.step > longest->setting.step))
      longest = &e;
  return longest;
}

constexpr int kTurns = 3;

/// Sorted ratios of the CPU rate of explicit Euler to that of the linearly implicit integrator,
/// with a step of equal error and with its usual step, timed in turns.
std::pair<std::vector<double>, std::vector<double>> time_in_turns(WarmScene& scene,
                                                                  const PrecisionOutcome& slow,
                                                                  const PrecisionOutcome& fast,
                                                                  const PrecisionOutcome& usual) {
  const auto rate = [&](const PrecisionOutcome& e) {
    return scene.run(e.setting, e.window, 1).cpu / e.window;
  };
  std::vector<double> ratio, usual_ratio;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double explicit_rate = rate(slow);
    ratio.push_back(explicit_rate / rate(fast));
    usual_ratio.push_back(explicit_rate / rate(usual));
  }
  std::ranges::sort(ratio);
  std::ranges::sort(usual_ratio);
  return {ratio, usual_ratio};
}

/// Speed-up of the linearly implicit integrator over explicit Euler at equal error. Explicit Euler
/// is too slow for the long window, so CPU times per simulated time are compared, each with its
/// cheapest setting over the window it was measured on.
BenchTable compare_with_explicit(const WorkCase& c, WarmScene& scene,
                                 const std::vector<PrecisionOutcome>& long_window,
                                 const std::vector<PrecisionOutcome>& short_window,
                                 CaseReport& report) {
  constexpr double kComparedError = 0.02;
  const auto explicits = of_method(short_window, coupling::Integrator::kExplicitEuler);
  const auto implicits = of_method(long_window, coupling::Integrator::kLinearlyImplicit);
  const auto brief = of_method(short_window, coupling::Integrator::kLinearlyImplicit);
  const PrecisionOutcome *slow = find_cheapest(explicits, kComparedError),
                         *fast = find_cheapest(implicits, kComparedError);
  if (!slow || !fast) {
    say(report, fmt::format("\nNo ratio to explicit Euler: no setting within {:g} %.\n",
                            100 * kComparedError));
    return {};
  }
  // The usual step is more careful than the error asks for; its ratio is what users see.
  const PrecisionOutcome& usual = *std::ranges::find_if(implicits, [](const PrecisionOutcome& e) {
    return e.setting.step == PrecisionSetting{}.step &&
           e.setting.cg_tolerance == PrecisionSetting{}.cg_tolerance;
  });
  const auto [ratio, usual_ratio] = time_in_turns(scene, *slow, *fast, usual);
  const double middle = ratio[kTurns / 2], usual_middle = usual_ratio[kTurns / 2];
  say(report,
      fmt::format("\nCPU time per simulated time, explicit Euler over linearly implicit, pressure "
                  "within {:g} %: **{:.0f}** (from {:.0f} to {:.0f} in {} turns).\nExplicit Euler: "
                  "dt {:g} s, {:.2g} % over {:g} s, the cheapest of its settings within the limit. "
                  "Linearly implicit: dt {:g} s, {:.2g} % over {:g} s",
                  100 * kComparedError, middle, ratio.front(), ratio.back(), kTurns,
                  slow->setting.step, 100 * slow->main_error, slow->window, fast->setting.step,
                  100 * fast->main_error, fast->window));
  BenchRow row{c.scene.title + ": explicit Euler over linearly implicit",
               slow->cells,
               {{"cpu_ratio", middle},
                {"cpu_ratio_least", ratio.front()},
                {"cpu_ratio_most", ratio.back()},
                {"cpu_ratio_usual_step", usual_middle},
                {"explicit_step_s", slow->setting.step},
                {"implicit_step_s", fast->setting.step},
                {"explicit_error", slow->main_error},
                {"implicit_error", fast->main_error}}};
  if (const PrecisionOutcome* nearest = find_longest_step(brief, fast->setting.step)) {
    say(report, fmt::format("; dt {:g} s, {:.2g} % over {:g} s", nearest->setting.step,
                            100 * nearest->main_error, nearest->window));
    row.value.emplace_back("implicit_step_short_s", nearest->setting.step);
    row.value.emplace_back("implicit_error_short", nearest->main_error);
  }
  say(report, fmt::format(".\nWith the usual step of {:g} s, {:.2g} % over {:g} s: {:.0f}.\n",
                          usual.setting.step, 100 * usual.main_error, usual.window, usual_middle));
  return {row};
}

}  // namespace

BenchTable bench_stretch(const BenchOptions& options) {
  return bench_case(stretch_case(), options);
}
BenchTable bench_capsule(const BenchOptions& options) {
  return bench_case(capsule_case(), options);
}
BenchTable bench_growth(const BenchOptions& options) {
  BenchTable table;
  for (const int cells : {8, 24, 64}) {
    const BenchTable rows = bench_case(growth_case(cells), options);
    table.insert(table.end(), rows.begin(), rows.end());
  }
  return table;
}
BenchTable bench_cbm(const BenchOptions& options) { return bench_case(cbm_case(), options); }

BenchTable bench_clump(const BenchOptions& options) {
  const WorkCase c = clump_case();
  WarmScene scene(c.scene);
  CaseReport report = run_case(c, scene);
  const std::vector<PrecisionOutcome> brief = report.study.back();
  report.time.resize(report.time.size() - brief.size());  // ten minutes are no six hours
  say(report, "\n" + cheapest_text(c.scene, report.time));
  const BenchTable ratio = compare_with_explicit(c, scene, report.study.front(), brief, report);
  std::ranges::copy_if(brief, std::back_inserter(report.time), [](const PrecisionOutcome& e) {
    return e.setting.integrator == coupling::Integrator::kExplicitEuler;
  });
  report.rows.insert(report.rows.end(), ratio.begin(), ratio.end());
  write_case(c, report, options.folder);
  const BenchTable packed = bench_case(packed_case(), options);
  report.rows.insert(report.rows.end(), packed.begin(), packed.end());
  return report.rows;
}

BenchTable bench_work_precision(const BenchOptions& options) {
  BenchTable table;
  for (const auto bench :
       {bench_stretch, bench_clump, bench_capsule, bench_growth, bench_cbm, bench_patch}) {
    const BenchTable rows = bench(options);
    table.insert(table.end(), rows.begin(), rows.end());
  }
  return table;
}

}  // namespace acinus::bench
