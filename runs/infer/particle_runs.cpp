#include "runs/infer/particle_runs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "runs/study/read_study.hpp"
#include "runs/study/study_data.hpp"
#include "runs/study/study_folder.hpp"

namespace acinus::runs {
namespace {

/// Random numbers of a simulation, apart from those of its proposal.
UniformStream stream_of(std::uint64_t seed, const Proposal& p) {
  constexpr int kIndexBits = 40;
  constexpr std::uint64_t kSimulation = std::uint64_t{1} << 63;
  return {seed, Purpose::kInference,
          kSimulation | static_cast<std::uint64_t>(p.population) << kIndexBits |
              static_cast<std::uint64_t>(p.index)};
}

std::string variant_name(const Proposal& p) {
  return fmt::format("p{}_{:05}", p.population, p.index);
}

nlohmann::json scene_value(double value, const std::string& unit) {
  const std::string text = value_text(value, unit);
  return unit == "1" ? nlohmann::json::parse(text) : nlohmann::json(text);
}

/// Proposal in the middle of the priors: any run shows whether keys and target fit the scene.
Proposal middle_of(const InferencePlan& plan) {
  Proposal p;
  for (const Prior& prior : plan.prior) p.x.push_back(prior.step(0, 1));
  return p;
}

}  // namespace

std::string value_text(double value, const std::string& unit) {
  const std::string number = fmt::format("{:.9g}", value);
  return unit == "1" ? number : number + " " + unit;
}

ParticleRuns::ParticleRuns(const InferencePlan& plan, ScheduleOptions options)
    : plan_(plan), options_(std::move(options)) {
  const Proposal middle = middle_of(plan);
  const StudyPlan study = study_of(std::span(&middle, 1));
  units_ = study.units;
  target_ = read_target(plan.inference.target, units_, study.runs.front().scene.time.end);
  check_study_folder(options_.root, study);
  make_study_folder(options_.root, study);
}

StudyPlan ParticleRuns::study_of(std::span<const Proposal> proposals) const {
  const Inference& inference = plan_.inference;
  nlohmann::ordered_json study{{"name", inference.name}, {"scene", inference.scene}};
  for (const JsonMember& m : inference.set)
    study["set"][m.name] = nlohmann::ordered_json::parse(json_of(m.value));
  for (const Proposal& p : proposals) {
    constexpr std::uint64_t kSeeds = 1'000'000'000;
    UniformStream random = stream_of(inference.abc.seed, p);
    nlohmann::ordered_json& variant = study["variants"][variant_name(p)];
    variant["seeds"] = {random.index(kSeeds)};
    for (std::size_t k = 0; k < p.x.size(); ++k)
      variant["set"][inference.parameters[k].key] =
          scene_value(plan_.prior[k].value(p.x[k]), plan_.unit[k]);
  }
  return parse_study(study.dump(1), inference.file + ", as a study", plan_.folder);
}

std::optional<std::vector<double>> ParticleRuns::simulate(std::span<const Proposal> proposals) {
  const StudyPlan study = study_of(proposals);
  const ScheduleResult result = run_all(study, choose_runs(study, {}), options_);
  if (result.stopped) return std::nullopt;
  const StudyData data = read_study_data(study, options_.root);
  std::map<std::string, std::size_t> at;
  for (std::size_t k = 0; k < study.runs.size(); ++k) at[study.variant_of(study.runs[k]).name] = k;
  std::vector<double> distance;
  for (const Proposal& p : proposals) {
    const std::size_t k = at.at(variant_name(p));
    const RunStatus& status = data[k].status;
    const bool is_final = status.state == RunState::kDone || status.state == RunState::kFailed ||
                          status.state == RunState::kRefused;
    check(is_final,
          fmt::format("{}: {} ({}). The same command goes on.", study.runs[k].name,
                      name_of(status.state), status.cause),
          Exit::kCannotContinue);
    SimulatedRun run{p, study.runs[k].name, {}, 0, status.cause};
    if (status.state == RunState::kDone) run.value = values_at(target_, data[k].curve);
    if (run.value.empty() && run.cause.empty()) run.cause = "a value of the target is missing";
    std::vector<double> compared = run.value;
    if (plan_.inference.method == InferenceMethod::kAbc) {
      UniformStream random = stream_of(plan_.inference.abc.seed, p);
      random.bits();  // the seed of the run
      for (std::size_t j = 0; j < compared.size(); ++j)
        compared[j] += target_[j].sd * random.normal();
    }
    distance.push_back(run.distance = distance_to(target_, compared));
    runs_.insert_or_assign({p.population, p.index}, std::move(run));
  }
  return distance;
}

}  // namespace acinus::runs
