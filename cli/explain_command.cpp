/// Commands `acinus explain` and `acinus schema`: keys of scenes, studies and inferences,
/// observables.

#include <algorithm>
#include <memory>

#include "acinus_version.hpp"
#include "cli/command.hpp"
#include "cli/man_page.hpp"
#include "runs/experiments/explain_observables.hpp"
#include "runs/infer/inference_registry.hpp"
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
  const std::string block = key.substr(0, key.find('.'));
  const std::vector<runs::Entry>& entries = block == "study"       ? runs::study_entries()
                                            : block == "inference" ? runs::inference_entries()
                                                                   : runs::all_entries();
  if (const std::string measured = runs::explain_observable(key); !measured.empty()) {
    fmt::print("{}", measured);
    if (std::ranges::find(entries, key, &runs::Entry::short_path) == entries.end()) return 0;
    fmt::print("\n");
  }
  const bool all = key.empty() || key == "study" || key == "inference";
  fmt::print("{}", all ? runs::explain_all(entries) : runs::explain_key(key, entries));
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
      "path or last name of a key, study.KEY or inference.KEY of such files, or the name of an "
      "observable");
  command->add_flag("--observables", *observables, "list what runs measure in place of keys")
      ->excludes(option);
  CLI::Option* page = command->add_flag("--markdown", *markdown, "all of them as a Markdown page")
                          ->excludes(option);
  const auto man = std::make_shared<bool>(false);
  command->add_flag("--man", *man, "print the manual page of the program: all commands, as roff")
      ->excludes(option)
      ->excludes(page);
  return {command, [key, markdown, observables, man, &app] {
            if (*man) {
              fmt::print("{}", man_page(app, ACINUS_VERSION));
              return 0;
            }
            return *observables ? explain_measured(*markdown) : explain(*key, *markdown);
          }};
}

Command add_schema(CLI::App& app) {
  CLI::App* command = add_command(app, "schema", "print the JSON Schema of scenes",
                                  "acinus schema > scene.schema.json");
  const auto study = std::make_shared<bool>(false);
  const auto inference = std::make_shared<bool>(false);
  CLI::Option* of_study = command->add_flag("--study", *study, "of studies instead");
  command->add_flag("--inference", *inference, "of inferences instead")->excludes(of_study);
  return {command, [study, inference] {
            fmt::print("{}", *study       ? runs::study_schema()
                             : *inference ? runs::inference_schema()
                                          : runs::scene_schema());
            return 0;
          }};
}

}  // namespace acinus::cli
