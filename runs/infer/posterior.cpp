#include "runs/infer/posterior.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/disk.hpp"
#include "runs/infer/posterior_plots.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

std::string head_of(const InferencePlan& plan) {
  std::string head;
  for (std::size_t k = 0; k < plan.prior.size(); ++k)
    head += fmt::format(",{}{}", plan.inference.parameters[k].key,
                        plan.unit[k] == "1" ? "" : " (" + plan.unit[k] + ")");
  return head;
}

std::string values_of(const InferencePlan& plan, const std::vector<double>& x) {
  std::string text;
  for (std::size_t k = 0; k < x.size(); ++k)
    text += fmt::format(",{:.9g}", plan.prior[k].value(x[k]));
  return text;
}

std::string posterior_table(const InferencePlan& plan, const Population& last) {
  std::string text = "index,weight,distance" + head_of(plan) + "\n";
  for (const Particle& p : last.particle)
    text +=
        fmt::format("{},{:.9g},{:.9g}{}\n", p.index, p.weight, p.distance, values_of(plan, p.x));
  return text;
}

std::string population_table(const Sampled& sampled) {
  std::string text = "population,tolerance,simulations,accepted,effective_size\n";
  for (std::size_t t = 0; t < sampled.population.size(); ++t) {
    const Population& p = sampled.population[t];
    text += fmt::format("{},{:.6g},{},{},{:.4g}\n", t, p.tolerance, p.tried, p.particle.size(),
                        effective_size(p));
  }
  return text;
}

std::string simulation_table(const InferencePlan& plan, const ParticleRuns& runs) {
  std::string text = "population,index,run,distance" + head_of(plan) + ",cause\n";
  for (const auto& [key, run] : runs.runs()) {
    std::string cause = run.cause.substr(0, run.cause.find('\n'));
    std::ranges::replace(cause, '"', '\'');
    text += fmt::format("{},{},{},{:.9g}{},\"{}\"\n", key.first, key.second, run.name, run.distance,
                        values_of(plan, run.proposal.x), run.value.empty() ? cause : "");
  }
  return text;
}

std::string parameter_lines(const InferencePlan& plan, const Population& last) {
  std::string text =
      "| parameter | median | 5 % | 95 % | mean | standard deviation "
      "|\n|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < plan.prior.size(); ++k) {
    const Summarised s = summarise(last.particle, parameter_values(plan, last, k));
    const auto shown = [&](double v) { return show_value(v, plan.unit[k]); };
    text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", plan.inference.parameters[k].key,
                        shown(s.median), shown(s.low), shown(s.high), shown(s.mean), shown(s.sd));
  }
  return text;
}

std::string prediction_lines(const ParticleRuns& runs, const Sampled& sampled) {
  std::string text =
      "| observable | time | measured | sd | predicted: median | 5 % | 95 % |\n"
      "|---|---|---|---|---|---|---|\n";
  for (std::size_t k = 0; k < runs.target().size(); ++k) {
    const TargetPoint& p = runs.target()[k];
    const Summarised s =
        summarise(sampled.population.back().particle, predicted_values(runs, sampled, k));
    const std::string& unit = runs.units().at(p.observable);
    const auto shown = [&](double v) { return show_value(v, unit); };
    text += fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", p.observable,
                        p.time ? show_value(*p.time, "s") : "end", shown(p.value), shown(p.sd),
                        shown(s.median), shown(s.low), shown(s.high));
  }
  return text;
}

}  // namespace

std::string write_posterior(const InferencePlan& plan, const ParticleRuns& runs,
                            const Sampled& sampled, const std::string& root) {
  const Population& last = sampled.population.back();
  io::write_text_file(root + "/posterior.csv", posterior_table(plan, last));
  io::write_text_file(root + "/populations.csv", population_table(sampled));
  io::write_text_file(root + "/simulations.csv", simulation_table(plan, runs));
  io::write_text_file(root + "/corner.svg", draw_corner(plan, last));
  std::string pictures = "![posterior](corner.svg)\n";
  for (const auto& [name, svg] : draw_predictions(runs, sampled)) {
    io::write_text_file(root + "/" + name, svg);
    pictures += fmt::format("\n![prediction]({})\n", name);
  }
  std::size_t failed = 0;
  for (const auto& [key, run] : runs.runs()) failed += run.value.empty() ? 1 : 0;
  double nearest = last.particle.front().distance;
  for (const Particle& p : last.particle) nearest = std::min(nearest, p.distance);
  const std::string within = std::isfinite(last.tolerance)
                                 ? fmt::format("up to {:.4g}", last.tolerance)
                                 : std::string("of any size");
  constexpr double kFew = 5;
  const double independent = effective_size(last);
  const std::string advice =
      independent >= kFew ? ""
      : plan.inference.method == InferenceMethod::kScan
          ? " Few points of the grid carry the weight: narrow the bounds or raise steps."
          : " Few particles carry the weight: raise particles.";
  const std::string summary = fmt::format(
      "{}\n{} of {} simulations failed. End: {}. The nearest has a distance of {:.3g} standard "
      "errors; {} particles at distances {}, as good as {:.0f} independent ones.{}\n",
      parameter_lines(plan, last), failed, runs.runs().size(), sampled.end, nearest,
      last.particle.size(), within, independent, advice);
  io::write_text_file(root + "/report.md",
                      fmt::format("# {}\n\n{}\n{}\n{}", plan.inference.name, summary,
                                  prediction_lines(runs, sampled), pictures));
  return summary;
}

}  // namespace acinus::runs
