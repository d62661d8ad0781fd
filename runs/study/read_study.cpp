#include "runs/study/read_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "runs/assemble/build_boundary.hpp"
#include "runs/assemble/start_state.hpp"
#include "runs/experiments/observables.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/scene/differences.hpp"
#include "runs/scene/key_reader.hpp"
#include "runs/scene/shipped_scenes.hpp"
#include "runs/scene/writer.hpp"
#include "runs/study/check_study.hpp"
#include "runs/study/expand_claims.hpp"
#include "runs/study/study_registry.hpp"

namespace acinus::runs {
namespace {
namespace fs = std::filesystem;

/// Collection of distinct error messages.
class Faults {
 public:
  void add(const Error& error) {
    std::istringstream lines(error.what());
    for (std::string line; std::getline(lines, line);)
      if (std::ranges::find(lines_, line) == lines_.end()) lines_.push_back(line);
  }
  /// Throws all messages as one Error, those of the file `label` first and by position.
  void finish(const std::string& label) {
    std::ranges::stable_sort(lines_, {}, [&](const std::string& l) { return place(l, label); });
    std::string text;
    for (const std::string& line : lines_) text += (text.empty() ? "" : "\n") + line;
    if (!text.empty()) throw Error(text);
  }

 private:
  /// Line and column of a message about the file `label`; the largest line for other files.
  static std::pair<int, int> place(const std::string& text, const std::string& label) {
    int line = 0, column = 0;
    if (!text.starts_with(label + ":") ||
        std::sscanf(text.c_str() + label.size(), ":%d:%d", &line, &column) != 2)
      return {std::numeric_limits<int>::max(), 0};
    return {line, column};
  }

  std::vector<std::string> lines_;
};

/// Path of the scene file of a study: a file beside it, or a shipped scene.
std::string find_scene(const Study& study, const Document& document, Report& report) {
  const Node* node = report.find("/scene");
  if (node == nullptr || report.is_bad("/scene")) return {};
  const Source& source = document.sources.at(node->origin.source);
  const std::string path = (fs::path(source.folder) / study.scene).lexically_normal().string();
  std::error_code code;
  if (study.scene.find('\0') == std::string::npos && fs::is_regular_file(path, code)) return path;
  std::vector<std::string> names;
  for (const ShippedScene& scene : shipped_scenes()) {
    if (scene.name == study.scene) return scene.file;
    names.push_back(scene.name);
  }
  report.add_value(*node, "/scene",
                   "no such file, and no shipped scene of that name. " +
                       did_you_mean(nearest_name(study.scene, names), "`acinus list` names them"));
  return {};
}

void shift_sources(Node& node, int by) {
  node.origin.source += by;
  for (Node& item : node.items) shift_sources(item, by);
  for (JsonMember& member : node.members) {
    member.origin.source += by;
    shift_sources(member.value, by);
  }
}

/// Resolved scene of a variant for its first seed.
/// @throws Error listing all its faults
Scene make_scene(const Document& base, const Document& study, const Variant& variant,
                 const std::string& label) {
  Document document = base;
  const int offset = static_cast<int>(document.sources.size());
  document.sources.insert(document.sources.end(), study.sources.begin(), study.sources.end());
  Faults faults;
  for (const Setting& setting : variant.set) {
    JsonMember value = setting.value;
    value.origin.source += offset;
    shift_sources(value.value, offset);
    const Source& source = document.sources.at(value.origin.source);
    try {
      put_value(document, value.name, value,
                fmt::format("{}:{}:{} {}", source.label, value.origin.line, value.origin.column,
                            setting.pointer));
    } catch (const Error& error) {
      faults.add(error);
    }
  }
  faults.finish(label);
  Node seed;
  seed.kind = Node::Kind::kInteger;
  seed.magnitude = static_cast<std::uint64_t>(variant.seeds.front());
  put_value(document, "seed", {"seed", base.root.origin, seed}, "seed");
  return read_scene(document, label);
}

class Planner {
 public:
  Planner(Document document, const std::string& label)
      : document_(std::move(document)), label_(label), report_(document_) {}

  StudyPlan make() {
    Study& study = plan_.study;
    read_keys(
        document_, report_, [&study](Visitor& visitor) { describe(visitor, study); }, "study.");
    study.file = label_;
    if (study.name.empty()) study.name = default_name(label_);
    const std::string file = find_scene(study, document_, report_);
    plan_.variants = make_variants(study, report_);
    if (!file.empty()) add_runs(file);
    if (!plan_.runs.empty()) check_study(plan_, report_);
    expand_claims(study, plan_.variants, report_);
    Faults all;
    try {
      report_.finish();
    } catch (const Error& error) {
      all.add(error);
    }
    for (const Error& fault : scene_faults_) all.add(fault);
    all.finish(label_);
    return std::move(plan_);
  }

 private:
  void add_runs(const std::string& file) {
    constexpr std::size_t kMostRuns = 20000;
    std::size_t runs = 0;
    for (const Variant& variant : plan_.variants) runs += variant.seeds.size();
    if (runs > kMostRuns) {
      scene_faults_.emplace_back(
          fmt::format("{}: variants and seeds make {} runs; a study has at most {}. Take fewer "
                      "seeds or values, "
                      "or make several studies.",
                      label_, runs, kMostRuns));
      return;
    }
    Document base;
    try {
      base = read_document(file);
    } catch (const Error& error) {
      scene_faults_.push_back(error);
      return;
    }
    for (std::size_t v = 0; v < plan_.variants.size(); ++v) {
      const Variant& variant = plan_.variants[v];
      if (variant.seeds.empty()) continue;
      try {
        Scene scene = make_scene(base, document_, variant, file);
        add_units(scene);
        for (const std::int64_t seed : variant.seeds) {
          scene.seed = static_cast<std::uint64_t>(seed);
          set_canonical(scene);
          plan_.runs.push_back({v,
                                scene.seed,
                                fmt::format("{}/seed_{}", variant.name, seed),
                                fmt::format("runs/{}/seed_{}", variant.folder, seed),
                                scene,
                                -1,
                                scene.hash,
                                {}});
        }
      } catch (const Error& error) {
        scene_faults_.push_back(error);
      }
    }
    link_starts();
  }

  void add_units(const Scene& scene) {
    const auto add = [&](const std::vector<Observable>& list) {
      for (const Observable& o : list) plan_.units.insert({o.name, o.unit});
    };
    add(known_observables(scene.experiment));
    for (const std::string& name : boundary_names(scene)) add(wall_observables(name));
    for (const SubstanceBlock& s : scene.substances) add(substance_observables(s.name, s.unit));
    for (std::size_t k = 0; k < scene.rules.size(); ++k) add(rule_observables(k));
  }

  /// Links every run to the run it starts from, and checks that their scenes allow it.
  void link_starts() {
    for (StudyRun& run : plan_.runs) {
      const Variant& variant = plan_.variant_of(run);
      if (variant.start.empty()) continue;
      for (std::size_t k = 0; k < plan_.runs.size(); ++k)
        if (plan_.runs[k].seed == run.seed && plan_.variant_of(plan_.runs[k]).name == variant.start)
          run.source = static_cast<int>(k);
      if (run.source >= 0 && run.seed == static_cast<std::uint64_t>(variant.seeds.front()))
        check_start(run, plan_.runs[run.source]);
    }
    for (StudyRun& run : plan_.runs) {
      std::size_t steps = 0;  // a circle is reported elsewhere
      for (int s = run.source; s >= 0 && ++steps <= plan_.runs.size();) {
        const StudyRun& source = plan_.runs[s];
        run.identity += "<" + source.scene.hash;
        run.sources.emplace_back(source.folder, source.scene.resolved_json);
        s = source.source;
      }
    }
  }

  void check_start(const StudyRun& run, const StudyRun& source) {
    const Variant& variant = plan_.variant_of(run);
    const std::string declared = variant.name.substr(0, variant.name.find('/'));
    const std::string pointer = "/variants/" + declared + "/start";
    const Node* node = report_.find(pointer);
    if (node == nullptr) return;
    if (!source.scene.start_up.enabled) {
      report_.add_value(*node, pointer,
                        "that variant has no start_up: there is nothing to share, and every run "
                        "places its own cells at once");
      return;
    }
    std::string differences;
    for (const std::string& line : list_scene_differences(
             source.scene.resolved_json, run.scene.resolved_json,
             [&](const std::string& p) { return may_differ_at_start(run.scene, p); }))
      differences += (differences.empty() ? "" : "; ") + line;
    if (!differences.empty())
      report_.add_value(*node, pointer,
                        fmt::format("{} starts otherwise: {}. What shapes the start must be the "
                                    "same",
                                    variant.name, differences));
  }

  Document document_;
  std::string label_;
  Report report_;
  std::vector<Error> scene_faults_;
  StudyPlan plan_;
};

}  // namespace

StudyPlan read_study(const std::string& path) { return Planner(read_document(path), path).make(); }

StudyPlan parse_study(const std::string& text, const std::string& label,
                      const std::string& folder) {
  return Planner(parse_document(text, label, folder), label).make();
}

}  // namespace acinus::runs
