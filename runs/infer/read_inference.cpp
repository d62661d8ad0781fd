#include "runs/infer/read_inference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "core/error.hpp"
#include "runs/infer/inference_registry.hpp"
#include "runs/scene/key_reader.hpp"
#include "runs/study/scene_value.hpp"
#include "runs/study/study_value.hpp"

namespace acinus::runs {
namespace {

class PriorReader {
 public:
  PriorReader(const Document& document, const std::string& label)
      : document_(document), report_(document) {
    Inference& inference = plan_.inference;
    read_keys(
        document_, report_, [&](Visitor& visitor) { describe(visitor, inference); }, "inference.");
    inference.file = label;
    if (inference.name.empty()) inference.name = default_name(label);
  }

  InferencePlan make(const std::string& folder) {
    plan_.folder = folder;
    const Inference& inference = plan_.inference;
    if (inference.parameters.empty())
      report_.add_relation({"/parameters"}, "[]", "at least one parameter is needed");
    std::set<std::string> names;
    for (std::size_t k = 0; k < inference.parameters.size(); ++k) {
      const std::string pointer = fmt::format("/parameters/{}", k);
      const InferredKey& p = inference.parameters[k];
      if (!names.insert(p.key).second)
        report_.add_relation({pointer + "/key"}, "", "another parameter has this key");
      add_parameter(p, pointer);
    }
    check_grid();
    name_shortly();
    report_.finish();
    return std::move(plan_);
  }

 private:
  void add_parameter(const InferredKey& p, const std::string& pointer) {
    const std::optional<std::string> unit = unit_of_key(p.key);
    plan_.unit.push_back(unit.value_or("1"));
    plan_.prior.emplace_back();
    if (p.key.empty() || report_.is_bad(pointer)) return;
    if (!unit) {
      report_.add_relation({pointer + "/key"}, "",
                           "is no key of a scene with one number as value. `acinus explain` lists "
                           "all");
      return;
    }
    Prior& prior = plan_.prior.back();
    prior.log = p.prior == PriorKind::kLogUniform;
    prior.normal = p.prior == PriorKind::kNormal;
    const auto take = [&](const char* name, const std::optional<Node>& node, double& value) {
      if (!node) {
        if (!prior.normal)
          report_.add_relation({pointer + "/" + name, pointer}, "",
                               fmt::format("{} is missing: the prior has two bounds", name));
        return;
      }
      try {
        value = number_in(*node, *unit);
      } catch (const Error& error) {
        report_.add_relation({pointer + "/" + name}, "", error.what());
      }
    };
    double low = prior.low, high = prior.high;
    take("low", p.low, low);
    take("high", p.high, high);
    if (prior.normal) {
      take("mean", p.mean, prior.mean);
      take("sd", p.sd, prior.sd);
    }
    check_prior(prior, low, high, pointer);
    if (prior.log && low > 0 && high > 0) {
      low = std::log(low);
      high = std::log(high);
    }
    prior.low = low;
    prior.high = high;
  }

  void check_prior(const Prior& prior, double low, double high, const std::string& pointer) {
    if (report_.is_bad(pointer)) return;
    if (!(low < high)) report_.add_relation({pointer + "/low"}, "", "must be below high");
    if (prior.log && !(low > 0))
      report_.add_relation({pointer + "/low"}, "", "must be above 0 with prior = log_uniform");
    if (prior.normal && !(prior.sd > 0))
      report_.add_relation({pointer + "/sd"}, "", "must be above 0");
    constexpr double kReach = 5;
    if (prior.normal &&
        (low > prior.mean + kReach * prior.sd || high < prior.mean - kReach * prior.sd))
      report_.add_relation({pointer + "/mean"}, "",
                           "lies more than five standard deviations outside the bounds");
  }

  void check_grid() {
    constexpr double kMost = 20000;
    const Inference& i = plan_.inference;
    if (i.method != InferenceMethod::kScan) return;
    const double all = std::pow(i.steps, static_cast<double>(i.parameters.size()));
    if (all > kMost)
      report_.add_relation({"/steps", "/method"}, "",
                           fmt::format("makes {:.3g} points with {} parameters; at most {} are "
                                       "allowed. Lower it, or choose abc",
                                       all, i.parameters.size(), kMost));
  }

  /// Labels: last parts of the keys, or whole keys where two have the same.
  void name_shortly() {
    std::map<std::string, int> count;
    const auto last = [](const std::string& key) { return key.substr(key.rfind('.') + 1); };
    for (const InferredKey& p : plan_.inference.parameters) ++count[last(p.key)];
    for (const InferredKey& p : plan_.inference.parameters)
      plan_.label.push_back(count[last(p.key)] > 1 ? p.key : last(p.key));
  }

  const Document& document_;
  Report report_;
  InferencePlan plan_;
};

}  // namespace

InferencePlan read_inference(const std::string& path) {
  const Document document = read_document(path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return PriorReader(document, path).make(folder.empty() ? "." : folder);
}

InferencePlan parse_inference(const std::string& text, const std::string& label,
                              const std::string& folder) {
  const Document document = parse_document(text, label, folder);
  return PriorReader(document, label).make(folder);
}

}  // namespace acinus::runs
