#include "runs/assemble/build_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/units/units.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {
namespace {

using coupling::Behaviour, coupling::Signal;

int number_of_substance(const Scene& scene, const std::string& substance) {
  const auto found = std::ranges::find(scene.substances, substance, &SubstanceBlock::name);
  return static_cast<int>(found - scene.substances.begin());
}

/// Number of a cell type; -1: all.
int number_of_type(const Scene& scene, const std::string& name) {
  return name.empty() ? -1
                      : static_cast<int>(
                            std::distance(scene.cell_types.begin(), scene.cell_types.find(name)));
}

coupling::SignalRule make_rule(const Scene& scene, const coupling::LifeParams& life,
                               const SignalRuleEntry& entry) {
  coupling::SignalRule rule = entry;
  if (rule.signal == Signal::kConcentration)
    rule.substance = number_of_substance(scene, entry.name);
  if (!entry.exchanged.empty())
    rule.of = number_of_substance(scene, entry.exchanged);
  else if (rule.behaviour == Behaviour::kChemotaxis)
    rule.of = rule.substance;
  rule.type = number_of_type(scene, entry.cell_type);
  if (rule.type >= 0) rule.lysing_type = life.type[rule.type].death.type;
  rule.partner = number_of_type(scene, entry.other);
  return rule;
}

std::string behaviour_in_words(const SignalRuleEntry& r) {
  const std::string name = name_of_choice(r.behaviour);
  switch (r.behaviour) {
    case Behaviour::kSecretion:
    case Behaviour::kUptake:
      return fmt::format("{} of {}", name, r.exchanged);
    case Behaviour::kChemotaxis:
      return fmt::format("{} {} {}", name, r.force < 0 ? "down" : "up",
                         r.exchanged.empty() ? r.name : r.exchanged);
    case Behaviour::kDeath:
      return fmt::format("death at up to {}", format_quantity(r.rate, kRate, "1/h"));
    default:
      return name;
  }
}

std::string signal_in_words(const SignalRuleEntry& r) {
  const std::string others = r.other.empty() ? "neighbours" : r.other + " neighbours";
  if (r.signal == Signal::kNeighbours) return "the number of " + others;
  if (r.signal == Signal::kContactArea) return "the area in contact with " + others;
  return r.name;
}

std::string half_in_words(const Scene& scene, const SignalRuleEntry& r) {
  switch (r.signal) {
    case Signal::kPressure:
      return format_quantity(r.half_max, kStress, "Pa");
    case Signal::kVolume:
      return fmt::format("{:.6g} um^3", r.half_max);
    case Signal::kContactArea:
      return fmt::format("{:.6g} um^2", r.half_max);
    case Signal::kAge:
      return format_quantity(r.half_max, kTime, "h");
    case Signal::kConcentration: {
      const auto substance = std::ranges::find(scene.substances, r.name, &SubstanceBlock::name);
      if (substance != scene.substances.end() && substance->unit != "1")
        return fmt::format("{:.6g} {}", r.half_max, substance->unit);
      [[fallthrough]];
    }
    default:
      return fmt::format("{:.6g}", r.half_max);
  }
}

}  // namespace

std::string describe_rule(const Scene& scene, const SignalRuleEntry& r) {
  return fmt::format("{} of {} {} with {}: half at {}, power {:.6g}", behaviour_in_words(r),
                     r.cell_type.empty() ? "all cells" : r.cell_type + " cells",
                     r.decreases ? "falls" : "rises", signal_in_words(r), half_in_words(scene, r),
                     r.power);
}

coupling::RuleParams build_rules(const Scene& scene, const coupling::LifeParams& life,
                                 Notes& notes) {
  coupling::RuleParams p;
  p.axis_point = scene.axis_point;
  for (std::size_t k = 0; k < scene.rules.size(); ++k) {
    p.rule.push_back(make_rule(scene, life, scene.rules[k]));
    notes.info.push_back(fmt::format("rules.{}: {}", k, describe_rule(scene, scene.rules[k])));
  }
  return p;
}

}  // namespace acinus::runs
