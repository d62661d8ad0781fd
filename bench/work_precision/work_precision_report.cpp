#include "bench/work_precision/work_precision_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "coupling/step/step.hpp"

namespace acinus::bench {
namespace {

const double kUsualTolerance = PrecisionSetting{}.cg_tolerance;

bool measures_strain(const WorkScene& scene) { return scene.axis != Vec3::Zero(); }

std::string name_space(const Discretisation& d) {
  return fmt::format("{} nodes, {}", d.nodes, d.quadrature);
}

double cg_per_step(const PrecisionOutcome& e) {
  return static_cast<double>(e.cg_iterations) /
         static_cast<double>(std::max<std::int64_t>(e.steps, 1));
}

/// Name of a step setting: "60 s", "up to 60 s for 0.01 um".
std::string name_step(const PrecisionSetting& s) {
  return s.adaptive ? fmt::format("up to {:g} s for {:g} um", s.step, s.tolerance)
                    : fmt::format("{:g} s", s.step);
}

/// Short name of an integrator for the legend of a plot.
const char* short_name(coupling::Integrator integrator) {
  switch (integrator) {
    case coupling::Integrator::kExplicitEuler:
      return "explicit";
    case coupling::Integrator::kNewton:
      return "Newton";
    case coupling::Integrator::kLinearlyImplicit:
      break;
  }
  return "implicit";
}

/// Name of the plot line that an outcome belongs to.
std::string series_of(const PrecisionOutcome& e, bool deformable, bool spatial,
                      double usual_window) {
  const PrecisionSetting& s = e.setting;
  const std::string quadrature = deformable ? s.space.quadrature : "";
  if (spatial) return quadrature;
  std::string name = short_name(s.integrator);
  if (s.adaptive)
    name = "adaptive" + (s.integrator == PrecisionSetting{}.integrator ? "" : ", " + name);
  if (s.extrapolate) name += ", extrapolated";
  if (deformable && s.space.quadrature != Discretisation{}.quadrature) name += ", " + quadrature;
  if (s.cg_tolerance != kUsualTolerance) name += ", other CG";
  if (e.window != usual_window) name += fmt::format(", {:g} min", e.window / 60);
  return name;
}

}  // namespace

std::string describe(const PrecisionSetting& s, bool deformable) {
  return fmt::format("{}{}{}, {}dt {}, CG {:g}", coupling::name_of(s.integrator),
                     s.extrapolate ? " (extrapolated)" : "", s.adaptive ? " (adaptive)" : "",
                     deformable ? name_space(s.space) + ", " : "", name_step(s), s.cg_tolerance);
}

std::string table_head(const WorkScene& scene, const PrecisionStudy& study) {
  const std::string moments =
      study.samples > 1 ? fmt::format("at {} equally spaced moments", study.samples) : "at its end";
  std::string out = fmt::format(
      "\n### {}: {}\n\nReference: {}. Window: {:g} s after {:g} s of warm-up, compared {}.\n\n"
      "| integrator | {}step | CG | CPU s | steps | CG/step | ",
      scene.title, study.title, describe(study.reference, scene.deformable), study.window,
      scene.warm_up, moments, scene.deformable ? "nodes | quadrature | " : "");
  std::string rule =
      scene.deformable ? "|---|---|---|---|---|---|---|---|" : "|---|---|---|---|---|---|";
  if (measures_strain(scene)) {
    out += "strain % | pressure % | volume % |\n";
    return out + rule + "---|---|---|\n";
  }
  out += scene.deformable ? "pressure % | volume % | contact force % | centres max um | rms um |\n"
                          : "pressure % | contact force % | centres max um | rms um |\n";
  return out + rule + (scene.deformable ? "---|---|---|---|---|\n" : "---|---|---|---|\n");
}

std::string table_line(const WorkScene& scene, const PrecisionOutcome& e) {
  const PrecisionSetting& s = e.setting;
  std::string out = fmt::format(
      "| {}{}{} | {}{} | {:g} | {:.3g} | {} | {:.1f} |", coupling::name_of(s.integrator),
      s.extrapolate ? ", extrapolated" : "", s.adaptive ? ", adaptive" : "",
      scene.deformable ? fmt::format("{} | {} | ", s.space.nodes, s.space.quadrature) : "",
      name_step(s), s.cg_tolerance, e.cpu, e.steps, cg_per_step(e));
  if (!e.failure.empty()) return out + fmt::format(" failed: {} |\n", e.failure);
  if (measures_strain(scene))
    return out + fmt::format(" {:.3g} | {:.3g} | {:.2g} |\n", 100 * e.error.strain,
                             100 * e.error.pressure, 100 * e.error.volume);
  out += fmt::format(" {:.3g} |", 100 * e.error.pressure);
  if (scene.deformable) out += fmt::format(" {:.2g} |", 100 * e.error.volume);
  return out + fmt::format(" {:.3g} | {:.3g} | {:.3g} |\n", 100 * e.error.contact_force,
                           e.error.center_max, e.error.center_rms);
}

std::string cheapest_text(const WorkScene& scene, const std::vector<PrecisionOutcome>& outcomes) {
  std::set<Discretisation> spaces;
  for (const PrecisionOutcome& e : outcomes) spaces.insert(e.setting.space);
  const char* what = measures_strain(scene) ? "strain" : "pressure";
  std::string out;
  for (const Discretisation& d : spaces) {
    std::vector<PrecisionOutcome> own;
    std::ranges::copy_if(outcomes, std::back_inserter(own),
                         [&](const PrecisionOutcome& e) { return e.setting.space == d; });
    for (const double limit : {0.05, 0.02, 0.01}) {
      const PrecisionOutcome* best = find_cheapest(own, limit);
      out += fmt::format("- {} within {:g} %{}: ", what, 100 * limit,
                         scene.deformable ? " on " + name_space(d) : "");
      out += best ? fmt::format("{}: {:.3g} s CPU, {:.2g} %\n", describe(best->setting, false),
                                best->cpu, 100 * best->main_error)
                  : std::string("none of the settings\n");
    }
  }
  return out;
}

io::Plot make_plot(const WorkScene& scene, const std::string& title,
                   const std::vector<PrecisionOutcome>& outcomes, const std::string& y_label,
                   double (*error)(const PrecisionOutcome&)) {
  const bool spatial = std::ranges::any_of(outcomes, [&](const PrecisionOutcome& e) {
    return e.setting.space.nodes != outcomes.front().setting.space.nodes;
  });
  io::Plot plot{title, "CPU s per simulated hour", y_label, true, true, {}};
  for (const PrecisionOutcome& e : outcomes) {
    if (!e.failure.empty()) continue;
    const std::string name = series_of(e, scene.deformable, spatial, outcomes.front().window);
    auto line = std::ranges::find(plot.line, name, &io::PlotLine::name);
    if (line == plot.line.end())
      line = plot.line.insert(line, {name, {}, true, e.setting.cg_tolerance == kUsualTolerance});
    line->point.emplace_back(e.cpu / e.window * 3600, error(e));
  }
  return plot;
}

BenchRow bench_row(const WorkScene& scene, const std::string& study, const PrecisionOutcome& e) {
  const Errors& r = e.error;
  BenchRow row{fmt::format("{}: {}: {}", scene.title, study, describe(e.setting, scene.deformable)),
               e.cells,
               {{"cpu_s", e.cpu},
                {"window_s", e.window},
                {"failed", e.failure.empty() ? 0.0 : 1.0},
                {"steps", static_cast<double>(e.steps)},
                {"rejected", static_cast<double>(e.rejected)},
                {"cg_iterations", static_cast<double>(e.cg_iterations)},
                {"cg_iterations_per_step", cg_per_step(e)}}};
  if (!e.failure.empty()) return row;
  row.value.insert(row.value.end(), {{"pressure_error", r.pressure},
                                     {"volume_error", r.volume},
                                     {"contact_force_error", r.contact_force},
                                     {"center_max_um", r.center_max},
                                     {"center_rms_um", r.center_rms}});
  if (measures_strain(scene)) row.value.emplace_back("strain_error", r.strain);
  return row;
}

}  // namespace acinus::bench
