#include "runs/experiments/explain_observables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <vector>

#include "runs/experiments/experiment.hpp"
#include "runs/experiments/observables.hpp"
#include "runs/scene/choices.hpp"

namespace acinus::runs {
namespace {

/// Observables of one kind of scene.
struct ObservableSection {
  std::string experiment;  ///< value of the scene key; empty: every scene
  std::string meaning;
  std::vector<Observable> observables;
};

/// Name with a placeholder for the number of a shell or layer, "shell_<k>_cells".
std::string without_number(const std::string& name) {
  static const std::regex number("_[0-9]+(?=_|$)");
  return std::regex_replace(name, number, "_<k>");
}

/// Numbered shells and layers by a placeholder, "shell_<k>_cells", each once.
std::vector<Observable> without_numbers(const std::vector<Observable>& list) {
  static const std::regex in_text("\\b[0-9]+\\b");
  std::vector<Observable> out;
  for (Observable o : list) {
    const std::string name = without_number(o.name);
    if (name != o.name) o.meaning = std::regex_replace(o.meaning, in_text, "k");
    o.name = name;
    if (std::ranges::find(out, name, &Observable::name) == out.end()) out.push_back(o);
  }
  return out;
}

std::vector<ObservableSection> make_sections() {
  std::vector<Observable> common = known_observables(Experiment::kFree);
  const auto n_common = static_cast<std::ptrdiff_t>(common.size());
  common.insert(common.begin(), {"time", "s", "time after t = 0"});
  std::vector<ObservableSection> sections{
      {"", "every scene", common},
      {"", "each wall, capsule and static mesh, by its name", wall_observables("NAME")},
      {"", "each substance, by its name", substance_observables("NAME", "its own")},
      {"", "each rule, by its number in the scene", without_numbers(rule_observables(0))}};
  const std::vector<std::string> names = split_choices(kChoices<Experiment>);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto experiment = static_cast<Experiment>(k);
    const std::vector<Observable> all = known_observables(experiment);
    sections.push_back({names[k], experiment_row(experiment).meaning,
                        without_numbers({std::next(all.begin(), n_common), all.end()})});
  }
  std::erase_if(sections, [](const ObservableSection& s) { return s.observables.empty(); });
  return sections;
}

std::string heading_of(const ObservableSection& section) {
  return section.experiment.empty()
             ? section.meaning
             : fmt::format("experiment = {}: {}", section.experiment, section.meaning);
}

}  // namespace

std::string explain_observable(const std::string& name) {
  const std::string common = without_number(name);
  std::string text;
  for (const ObservableSection& section : make_sections())
    for (const Observable& o : section.observables)
      if (o.name == name || o.name == common)
        text += fmt::format("{}\n  {}\n  unit     {}\n  measured in {}\n", o.name, o.meaning,
                            o.unit, heading_of(section));
  return text;
}

std::string explain_observables() {
  std::string text;
  for (const ObservableSection& section : make_sections()) {
    text += heading_of(section) + "\n";
    for (const Observable& o : section.observables)
      text += fmt::format("  {:38}  {:6}  {}\n", o.name, o.unit, o.meaning);
  }
  return text;
}

std::string explain_observables_markdown() {
  std::string text =
      "# Observables\n\n"
      "Printed by `acinus explain --observables --markdown`; a test compares this page with the "
      "program.\n\n"
      "A run writes one value of each observable per frame: into the table `/observables` of the "
      "[run file](run_file.md), and into `measures` of `summary.json`. "
      "[Studies](../howto/study.md) "
      "plot them and test claims on them. The scene key `experiment` decides which a run has. Unit "
      "1: no unit. A mean over no cells is 0 in the table and null in `summary.json`. `<k>` stands "
      "for a number, NAME for the name of a body or a substance in the scene.\n";
  for (const ObservableSection& section : make_sections()) {
    text += section.experiment.empty() ? fmt::format("\n## Of {}\n\n", section.meaning)
                                       : fmt::format("\n## Experiment {}\n\nMeasures the {}.\n\n",
                                                     section.experiment, section.meaning);
    text += "| name | unit | definition |\n|---|---|---|\n";
    for (const Observable& o : section.observables)
      text += fmt::format("| `{}` | {} | {} |\n", o.name, o.unit, o.meaning);
  }
  return text;
}

}  // namespace acinus::runs
