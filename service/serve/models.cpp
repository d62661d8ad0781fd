#include "service/serve/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units/units.hpp"
#include "runs/study/read_study.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/shipped_studies.hpp"

namespace acinus::service {
namespace {

using Json = nlohmann::json;

/// Default parameters of a study's models: the numeric keys it sweeps, else those its variants set.
std::vector<std::string> default_parameters(const runs::Study& study) {
  std::vector<std::string> keys;
  const auto add = [&](const std::string& key) {
    if (runs::unit_of_key(key) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
  };
  for (const runs::StudySweep& sweep : study.sweeps) add(sweep.key);
  if (!keys.empty()) return keys;
  for (const auto& [name, variant] : study.variants)
    for (const runs::JsonMember& member : variant.set) add(member.name);
  return keys;
}

std::vector<std::string> observables_of(const runs::StudyPlan& plan) {
  if (!plan.study.observables.empty()) return plan.study.observables;
  std::vector<std::string> names;
  for (const auto& [name, unit] : plan.units)
    if (name != "time") names.push_back(name);
  return names;
}

std::string string_in(const Json& j, const char* what) {
  check(j.is_string(), fmt::format("config: {} is a text", what));
  return j;
}

double time_in(const Json& j) {
  if (j.is_number() && j.get<double>() >= 0) return j;
  return parse_quantity(string_in(j, "\"at\": a time like \"2 days\", or a number of s,"), kTime);
}

const runs::StudyRun& run_of(const StudyModel& model, const std::string& variant) {
  const std::vector<runs::Variant>& variants = model.plan->variants;
  const auto found = std::ranges::find_if(model.plan->runs, [&](const runs::StudyRun& run) {
    return variants[run.variant].name == variant;
  });
  if (found != model.plan->runs.end()) return *found;
  throw Error("config: \"variant\": " + runs::unknown_variant(variants, variant));
}

}  // namespace

Models::Models() {
  for (const runs::ShippedScene& study : runs::shipped_studies())
    plans_.push_back(runs::read_study(study.file));
  for (const runs::StudyPlan& plan : plans_) {
    const std::vector<std::string> parameters = default_parameters(plan.study);
    if (parameters.empty()) continue;
    for (const std::string& observable : observables_of(plan)) {
      const auto unit = plan.units.find(observable);
      if (unit == plan.units.end()) continue;
      const std::string name = plan.study.name + "/" + observable;
      models_[name] = {name, observable, unit->second, &plan, parameters};
    }
  }
}

ModelConfig read_config(const StudyModel& model, const Json& j) {
  ModelConfig config;
  config.parameters = model.parameters;
  config.variant = model.plan->variants.front().name;
  if (j.is_null()) return config;
  check(j.is_object(), "config: must be an object");
  for (const auto& [key, value] : j.items()) {
    if (key == "variant") {
      config.variant = string_in(value, "\"variant\"");
    } else if (key == "seed") {
      check(value.is_number_unsigned(), "config: \"seed\" is a whole number");
      config.seed = value.dump();
    } else if (key == "at") {
      for (const Json& time : value.is_array() ? value : Json::array({value}))
        config.at_s.push_back(time_in(time));
    } else if (key == "parameters") {
      check(value.is_array() && !value.empty(), "config: \"parameters\" is a list of scene keys");
      config.parameters.clear();
      for (const Json& one : value) {
        config.parameters.push_back(string_in(one, "one of \"parameters\""));
        check(runs::unit_of_key(config.parameters.back()).has_value(),
              fmt::format("config: \"parameters\": {} is no scene key with a number. `acinus "
                          "explain` lists the keys.",
                          one.dump()));
      }
    } else if (key == "set") {
      check(value.is_object(), "config: \"set\" is an object, e.g. {\"time.end\": \"2 h\"}");
      for (const auto& [path, v] : value.items()) config.set.push_back(path + "=" + v.dump());
    } else {
      throw Error(
          fmt::format("config: {}: unknown; allowed are variant, parameters, at, seed and set",
                      Json(key).dump()));
    }
  }
  run_of(model, config.variant);
  return config;
}

const runs::Scene& model_scene(const StudyModel& model, const ModelConfig& config) {
  return run_of(model, config.variant).scene;
}

std::vector<std::string> model_changes(const ModelConfig& config,
                                       const std::vector<double>& values) {
  std::vector<std::string> set = config.set;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::string key = config.parameters[k], unit = *runs::unit_of_key(key);
    set.push_back(unit == "1" ? fmt::format("{}={}", key, values[k])
                              : fmt::format("{}=\"{} {}\"", key, values[k], unit));
  }
  if (!config.seed.empty()) set.push_back("seed=" + config.seed);
  return set;
}

std::vector<double> model_output(const StudyModel& model, const ModelConfig& config,
                                 const RunResult& result) {
  const auto curve = result.curve.find(model.observable);
  check(curve != result.curve.end() && !curve->second.time.empty(),
        fmt::format("the run has no value of {}", model.observable));
  const UnitScale from = scale_of_unit(result.unit.at(model.observable)),
                  to = scale_of_unit(model.unit);
  const double scale = from.in_base / to.in_base;
  if (config.at_s.empty()) return {scale * curve->second.value.back()};
  std::vector<double> output;
  for (const double at : config.at_s) {
    const std::optional<double> value = runs::value_at(curve->second, at);
    check(value.has_value(),
          fmt::format("the run has no value of {} at {} s; it has from {} to {} s",
                      model.observable, at, curve->second.time.front(), curve->second.time.back()));
    output.push_back(scale * *value);
  }
  return output;
}

}  // namespace acinus::service
