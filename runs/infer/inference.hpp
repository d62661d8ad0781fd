#pragma once
/// Keys of an inference as plain data. Defaults are the initialisers here; inference_registry.hpp
/// adds unit, range and meaning.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runs/infer/sampler.hpp"
#include "runs/scene/choices.hpp"
#include "runs/scene/json_text.hpp"

namespace acinus::runs {

enum class PriorKind { kUniform, kLogUniform, kNormal };
template <>
inline constexpr const char* kChoices<PriorKind> = "uniform|log_uniform|normal";

enum class InferenceMethod { kAbc, kScan };
template <>
inline constexpr const char* kChoices<InferenceMethod> = "abc|scan";

/// Scene key that is inferred, with its prior.
struct InferredKey {
  std::string key;
  PriorKind prior = PriorKind::kUniform;
  std::optional<Node> low, high;  ///< bounds; of a normal prior only where given
  std::optional<Node> mean, sd;   ///< of a normal prior
};

/// All keys of an inference file.
struct Inference {
  std::string file;  ///< path it was read from
  std::string name, scene;
  std::vector<JsonMember> set;
  std::vector<InferredKey> parameters;
  std::string target;
  InferenceMethod method = InferenceMethod::kAbc;
  AbcSettings abc;
  int steps = 9;  ///< of a scan, along each parameter
};

}  // namespace acinus::runs
