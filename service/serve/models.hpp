#pragma once
/// Observables of studies as UM-Bridge models with inputs and one output, such as the lesion area
/// after two days over the leader force.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "runs/scene/scene.hpp"
#include "runs/study/plan.hpp"
#include "service/serve/results.hpp"

namespace acinus::service {

/// Model of one observable of a study.
struct StudyModel {
  std::string name;  ///< "closing_force/lesion_area_relative"
  std::string observable, unit;
  const runs::StudyPlan* plan = nullptr;
  std::vector<std::string> parameters;  ///< scene keys, by default those the study sweeps
};

/// Configuration of a model; every member has a default.
struct ModelConfig {
  std::string variant;                  ///< of the study
  std::vector<std::string> parameters;  ///< scene keys, in the order of the inputs
  std::vector<double> at_s;             ///< times of the output; empty = the end
  std::vector<std::string> set;         ///< changes of the scene, PATH=VALUE
  std::string seed;                     ///< "" = that of the study
  std::size_t n_output() const { return at_s.empty() ? 1 : at_s.size(); }
};

/// Models of all shipped studies.
class Models {
 public:
  Models();
  const std::map<std::string, StudyModel>& all() const { return models_; }

 private:
  std::vector<runs::StudyPlan> plans_;
  std::map<std::string, StudyModel> models_;
};

/// Parses a model configuration.
/// @throws Error naming an unknown or malformed member
ModelConfig read_config(const StudyModel& model, const nlohmann::json& config);

/// Resolved scene of the configured variant, before the changes of an evaluation.
const runs::Scene& model_scene(const StudyModel& model, const ModelConfig& config);

/// Changes of that scene for an evaluation, PATH=VALUE.
/// @param values  one per parameter, in the units of the keys
std::vector<std::string> model_changes(const ModelConfig& config,
                                       const std::vector<double>& values);

/// Output of an evaluation, in the model's unit, one value per time.
/// @throws Error if the run has no value at a time
std::vector<double> model_output(const StudyModel& model, const ModelConfig& config,
                                 const RunResult& result);

}  // namespace acinus::service
