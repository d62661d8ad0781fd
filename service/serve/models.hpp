#pragma once
/// The observables of studies as models with inputs and an output, as UM-Bridge calls them: "the
/// area of the lesion after two days, by the force of the leaders".

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "runs/study/plan.hpp"
#include "service/serve/results.hpp"

namespace acinus::runs {

/// One model: an observable of a study.
struct StudyModel {
  std::string name;  ///< "closing_force/lesion_area_relative"
  std::string observable, unit;
  const StudyPlan* plan = nullptr;
  std::vector<std::string> parameters;  ///< scene keys, by default; what the study sweeps
};

/// What a caller may say about a model; everything has a default.
struct ModelConfig {
  std::string variant;                  ///< of the study
  std::vector<std::string> parameters;  ///< scene keys, in the order of the inputs
  std::vector<double> at_s;             ///< when the observable is read; empty = at the end
  std::vector<std::string> set;         ///< PATH=VALUE
  std::string seed;                     ///< "" = that of the study
  std::size_t n_output() const { return at_s.empty() ? 1 : at_s.size(); }
};

/// Reads the shipped studies.
class Models {
 public:
  Models();
  const std::map<std::string, StudyModel>& all() const { return models_; }

 private:
  std::vector<StudyPlan> plans_;
  std::map<std::string, StudyModel> models_;
};

/// @throws Error: what is unknown in it, or has the wrong form
ModelConfig read_config(const StudyModel& model, const nlohmann::json& config);

/// The scene of the variant that is evaluated, before its changes.
const Scene& model_scene(const StudyModel& model, const ModelConfig& config);

/// Changes of that scene for an evaluation, PATH=VALUE.
/// @param values  one per parameter, in the units of the keys
std::vector<std::string> model_changes(const ModelConfig& config,
                                       const std::vector<double>& values);

/// The output, in the model's unit.   @throws Error where the run has no value at such a time
std::vector<double> model_output(const StudyModel& model, const ModelConfig& config,
                                 const RunResult& result);

}  // namespace acinus::runs
