#include "runs/study/expand_claims.hpp"

#include <fmt/format.h>

#include <functional>
#include <string>
#include <utility>

namespace acinus::runs {
namespace {

/// Suffixes such as "/W=1e-5 J/m^2" of the variants that sweeps with this label derive from `base`.
std::vector<std::string> swept_endings(const Study& study, const std::vector<Variant>& variants,
                                       const std::string& base, const std::string& label) {
  std::vector<std::string> endings;
  for (const StudySweep& sweep : study.sweeps)
    for (const Node& value : sweep.values) {
      const std::string part = name_of_value(sweep, value), ending = "/" + part;
      if (part.starts_with(label + "=") && !find_variants(variants, base + ending).empty())
        endings.push_back(ending);
    }
  return endings;
}

/// Calls call(name) for every name of a variant in a claim.
void for_each_variant(StudyExpectation& e, const std::function<void(std::string&)>& call) {
  for (StudyMeasure* m : {&e.measure, e.minus ? &*e.minus : nullptr, e.over ? &*e.over : nullptr})
    if (m != nullptr)
      for (std::string* name : {&m->variant, &m->other, &m->another})
        if (!name->empty()) call(*name);
}

}  // namespace

void expand_claims(Study& study, const std::vector<Variant>& variants, Report& report) {
  std::vector<StudyExpectation> all;
  for (std::size_t k = 0; k < study.expectations.size(); ++k) {
    const StudyExpectation& original = study.expectations[k];
    all.push_back(original);
    if (original.each.empty()) continue;
    const auto complain = [&](const std::string& message) {
      const std::string pointer = fmt::format("/expectations/{}/each", k);
      if (const Node* node = report.find(pointer)) report.add_value(*node, pointer, message);
    };
    const std::vector<std::string> endings =
        swept_endings(study, variants, original.measure.variant, original.each);
    if (endings.empty())
      complain(fmt::format("no sweep with this label is made of {}", original.measure.variant));
    for (const std::string& ending : endings) {
      StudyExpectation& copy = all.emplace_back(original);
      copy.each.clear();
      copy.id += ending;
      copy.claim += ", " + ending.substr(1);
      for_each_variant(copy, [&](std::string& name) {
        name += ending;
        if (find_variants(variants, name).empty())
          complain(fmt::format("there is no variant {}: sweep all that the claim names", name));
      });
    }
  }
  study.expectations = std::move(all);
}

}  // namespace acinus::runs
