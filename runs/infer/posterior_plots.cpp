#include "runs/infer/posterior_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/plot.hpp"

namespace acinus::runs {
namespace {

std::string label_of(const InferencePlan& plan, std::size_t k) {
  return plan.unit[k] == "1" ? plan.label[k] : fmt::format("{}, {}", plan.label[k], plan.unit[k]);
}

/// Density of the coordinate by bins, as a line with steps, and the prior. Both have area 1.
io::Plot draw_density(const InferencePlan& plan, const Population& population, std::size_t k) {
  constexpr int kBins = 16;
  const Prior& prior = plan.prior[k];
  const double from = prior.step(0, 2), width = (prior.step(1, 2) - from) / kBins;
  std::vector<double> share(kBins, 0), before(kBins, 0);
  double sum = 0;
  for (const Particle& p : population.particle) {
    const int bin = static_cast<int>(std::floor((p.x[k] - from) / width));
    share[static_cast<std::size_t>(std::clamp(bin, 0, kBins - 1))] += p.weight;
  }
  for (std::size_t b = 0; b < before.size(); ++b)
    sum += before[b] = prior.density(from + (static_cast<double>(b) + 0.5) * width);
  io::Plot plot;
  plot.x_label = label_of(plan, k);
  plot.y_label = prior.log ? "density of the logarithm" : "density";
  plot.log_x = prior.log;
  plot.legend = false;
  io::PlotLine posterior{"posterior", {}, false}, line{"prior", {}, false};
  for (std::size_t b = 0; b < share.size(); ++b)
    for (const std::size_t end : {b, b + 1}) {
      const double x = prior.value(from + static_cast<double>(end) * width);
      posterior.point.emplace_back(x, share[b] / width);
      line.point.emplace_back(x, before[b] / (sum * width));
    }
  plot.line = {posterior, line};
  return plot;
}

/// Pairs of two parameters: as many marks as particles, each as often as its weight says.
io::Plot draw_pairs(const InferencePlan& plan, const Population& population, std::size_t i,
                    std::size_t j) {
  io::Plot plot;
  plot.x_label = label_of(plan, j);
  plot.y_label = label_of(plan, i);
  plot.log_x = plan.prior[j].log;
  plot.log_y = plan.prior[i].log;
  plot.legend = false;
  io::PlotLine marks{"particles", {}, true, false};
  const auto n = static_cast<double>(population.particle.size());
  double sum = 0, next = 0.5 / n;
  for (const Particle& p : population.particle)
    for (sum += p.weight; next < sum; next += 1 / n)
      marks.point.emplace_back(plan.prior[j].value(p.x[j]), plan.prior[i].value(p.x[i]));
  plot.line = {marks};
  return plot;
}

}  // namespace

std::vector<double> parameter_values(const InferencePlan& plan, const Population& population,
                                     std::size_t parameter) {
  std::vector<double> all;
  for (const Particle& p : population.particle)
    all.push_back(plan.prior[parameter].value(p.x[parameter]));
  return all;
}

std::vector<double> predicted_values(const ParticleRuns& runs, const Sampled& sampled,
                                     std::size_t point) {
  std::vector<double> all;
  const int last = static_cast<int>(sampled.population.size()) - 1;
  for (const Particle& p : sampled.population.back().particle)
    all.push_back(runs.runs().at({last, p.index}).value[point]);
  return all;
}

std::string draw_corner(const InferencePlan& plan, const Population& population) {
  const std::size_t n = plan.prior.size();
  std::vector<io::Plot> plots;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      plots.push_back(i == j ? draw_density(plan, population, i)
                             : draw_pairs(plan, population, i, j));
  return io::draw_grid(plots, n);
}

std::vector<std::pair<std::string, std::string>> draw_predictions(const ParticleRuns& runs,
                                                                  const Sampled& sampled) {
  std::map<std::string, std::vector<std::size_t>> points;
  for (std::size_t k = 0; k < runs.target().size(); ++k)
    if (runs.target()[k].time) points[runs.target()[k].observable].push_back(k);
  std::vector<std::pair<std::string, std::string>> all;
  for (auto& [observable, at] : points) {
    if (at.size() < 2) continue;
    const auto time = [&](std::size_t k) { return *runs.target()[k].time; };
    std::ranges::stable_sort(at, {}, time);
    constexpr double kHour = 3600, kMinute = 60;
    const double unit = time(at.back()) > 2 * kHour     ? kHour
                        : time(at.back()) > 2 * kMinute ? kMinute
                                                        : 1;
    io::Plot plot;
    plot.title = observable;
    plot.x_label = fmt::format("time, {}", unit == kHour ? "h" : unit == kMinute ? "min" : "s");
    plot.y_label = fmt::format("{}, {}", observable, runs.units().at(observable));
    io::PlotLine measured{"measured", {}, true, false},
        predicted{"median and 5 to 95 %", {}, false};
    for (const std::size_t k : at) {
      const TargetPoint& p = runs.target()[k];
      const Summarised s =
          summarise(sampled.population.back().particle, predicted_values(runs, sampled, k));
      measured.point.emplace_back(time(k) / unit, p.value);
      measured.band.emplace_back(p.value - p.sd, p.value + p.sd);
      predicted.point.emplace_back(time(k) / unit, s.median);
      predicted.band.emplace_back(s.low, s.high);
    }
    plot.line = {predicted, measured};
    all.emplace_back(fmt::format("prediction_{}.svg", observable), io::draw_plot(plot));
  }
  return all;
}

}  // namespace acinus::runs
