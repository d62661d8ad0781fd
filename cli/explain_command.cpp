/// Commands `acinus explain` and `acinus schema`: keys of scenes and studies, observables.

#include <memory>

#include "cli/command.hpp"
#include "runs/experiments/explain_observables.hpp"
#include "runs/scene/entries.hpp"
#include "runs/scene/explain.hpp"
#include "runs/scene/schema.hpp"
#include "runs/study/study_registry.hpp"

namespace acinus::cli {
namespace {

int explain_measured(bool markdown) {
  fmt::print("{}", markdown ? runs::explain_observables_markdown() : runs::explain_observables());
  return 0;
}

int explain(const std::string& key, bool markdown) {
  if (markdown) {
    fmt::print("{}", runs::explain_markdown());
    return 0;
  }
  if (const std::string measured = runs::explain_observable(key); !measured.empty()) {
    fmt::print("{}", measured);
    return 0;
  }
  const bool study = key == "study" || key.starts_with("study.");
  const std::vector<runs::Entry>& entries = study ? runs::study_entries() : runs::all_entries();
  fmt::print("{}", key.empty() || key == "study" ? runs::explain_all(entries)
                                                 : runs::explain_key(key, entries));
  return 0;
}

}  // namespace

Command add_explain(CLI::App& app) {
  CLI::App* command = add_command(
      app, "explain", "say what a scene key or an observable means; without KEY, list all keys",
      "acinus explain cell.radius\n         acinus explain --observables");
  const auto key = std::make_shared<std::string>();
  const auto markdown = std::make_shared<bool>(false), observables = std::make_shared<bool>(false);
  CLI::Option* option = command->add_option(
      "KEY", *key,
      "path or last name of a key, study.KEY of studies, or the name of an observable");
  command->add_flag("--observables", *observables, "list what runs measure in place of keys")
      ->excludes(option);
  command->add_flag("--markdown", *markdown, "all of them as a Markdown page")->excludes(option);
  return {command, [key, markdown, observables] {
            return *observables ? explain_measured(*markdown) : explain(*key, *markdown);
          }};
}

Command add_schema(CLI::App& app) {
  CLI::App* command = add_command(app, "schema", "print the JSON Schema of scenes",
                                  "acinus schema > scene.schema.json");
  const auto study = std::make_shared<bool>(false);
  command->add_flag("--study", *study, "of studies instead");
  return {command, [study] {
            fmt::print("{}", *study ? runs::study_schema() : runs::scene_schema());
            return 0;
          }};
}

}  // namespace acinus::cli
