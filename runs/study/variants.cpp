#include "runs/study/variants.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "core/spelling.hpp"

namespace acinus::runs {
namespace {

constexpr std::size_t kMostVariants = 10000;   ///< in one study
constexpr std::size_t kMostExtendsChain = 64;  ///< in one chain of extends

/// Advice for scene keys that a study sets in another way; null for other keys.
const char* instead_of(const std::string& key) {
  if (key == "seed") return "Seeds are listed in the key seeds";
  if (key == "start_up.from" || key == "start_up/from") return "Name a variant in the key start";
  return nullptr;
}

void add_settings(const std::vector<JsonMember>& members, const std::string& pointer,
                  Report& report, std::vector<Setting>& out) {
  for (const JsonMember& member : members) {
    const std::string place = pointer + "/" + pointer_part(member.name);
    if (const char* instead = instead_of(member.name)) {
      report.add(member.origin, place, fmt::format("cannot be set here. {}", instead));
    } else {
      out.push_back({member, place});
    }
  }
}

/// Position of a key of a variant in the file, or of the variant.
TextPlace place_of(const Report& report, const std::string& pointer, const char* key) {
  const Node* node = report.find(pointer + "/" + key);
  if (node == nullptr) node = report.find(pointer);
  return node != nullptr ? node->origin : TextPlace{};
}

std::string no_variant(const std::string& name, const std::vector<std::string>& names) {
  return fmt::format(
      "no variant \"{}\". {}", name,
      did_you_mean(nearest_name(name, names), fmt::format("Known: {}", fmt::join(names, ", "))));
}

/// Collects the settings of a variant and of those it extends, oldest first.
/// @param chain  variants visited so far, to detect cycles
void collect(const Study& study, const std::string& name, std::vector<std::string> chain,
             Report& report, std::vector<Setting>& out) {
  const StudyVariant& variant = study.variants.at(name);
  const std::string pointer = "/variants/" + name;
  if (!variant.extends.empty()) {
    const TextPlace origin = place_of(report, pointer, "extends");
    chain.push_back(name);
    if (!study.variants.contains(variant.extends)) {
      std::vector<std::string> names;
      for (const auto& [other, unused] : study.variants) names.push_back(other);
      report.add(origin, pointer + "/extends", no_variant(variant.extends, names));
    } else if (chain.size() > kMostExtendsChain) {
      report.add(origin, pointer + "/extends",
                 fmt::format("more than {} variants extend one another", kMostExtendsChain));
    } else if (std::ranges::find(chain, variant.extends) != chain.end()) {
      report.add(origin, pointer + "/extends",
                 fmt::format("variants extend each other in a circle: {}, {}",
                             fmt::join(chain, ", "), variant.extends));
    } else {
      collect(study, variant.extends, chain, report, out);
    }
  }
  add_settings(variant.set, pointer + "/set", report, out);
}

/// Name as a safe path component: replaces unsafe characters and limits the length.
std::string safe_component(const std::string& name) {
  constexpr std::size_t kMostCharacters = 120;
  constexpr const char* kSafeCharacters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+.=";
  std::string safe = name.substr(0, kMostCharacters);
  for (char& c : safe)
    if (std::string_view(kSafeCharacters).find(c) == std::string_view::npos) c = '_';
  if (safe.empty() || safe.front() == '.') safe.insert(safe.begin(), '_');
  return safe;
}

/// Value as part of a name: texts without quotes.
std::string plain(const Node& value) {
  return value.kind == Node::Kind::kText ? value.text : shown(value);
}

std::string label_of(const StudySweep& sweep) {
  return sweep.label.empty() ? sweep.key.substr(sweep.key.find_last_of("./") + 1) : sweep.label;
}

void check_seeds(const std::vector<std::int64_t>& seeds, const std::string& pointer,
                 Report& report) {
  std::set<std::int64_t> seen;
  for (std::size_t k = 0; k < seeds.size(); ++k) {
    if (seen.insert(seeds[k]).second) continue;
    const std::string place = fmt::format("{}/{}", pointer, k);
    if (const Node* node = report.find(place)) report.add_value(*node, place, "stands there twice");
  }
}

class Maker {
 public:
  Maker(const Study& study, Report& report) : study_(study), report_(report) {}

  std::vector<Variant> make() {
    check_seeds(study_.seeds, "/seeds", report_);
    if (const Node* seeds = report_.find("/seeds"); seeds != nullptr && study_.seeds.empty())
      report_.add_value(*seeds, "/seeds", "at least one seed is needed");
    for (const auto& [name, variant] : study_.variants) {
      Variant v;
      v.name = v.folder = name;
      v.title = variant.title.empty() ? name : variant.title;
      v.pointer = "/variants/" + name;
      v.seeds = variant.seeds.empty() ? study_.seeds : variant.seeds;
      v.start = variant.start;
      check_seeds(variant.seeds, v.pointer + "/seeds", report_);
      add_settings(study_.set, "/set", silent_or_report(name), v.set);
      collect(study_, name, {}, report_, v.set);
      variants_.push_back(v);
      folders_.insert(v.folder);
    }
    for (std::size_t k = 0; k < study_.sweeps.size(); ++k) add_sweep(k);
    check_starts();
    return std::move(variants_);
  }

 private:
  /// Report for the settings common to all variants, whose faults are reported once, with the first
  /// variant.
  Report& silent_or_report(const std::string& name) {
    return name == study_.variants.begin()->first ? report_ : silent_;
  }

  void add_sweep(std::size_t k) {
    const StudySweep& sweep = study_.sweeps[k];
    const std::string pointer = fmt::format("/sweeps/{}", k);
    if (const char* instead = instead_of(sweep.key)) {
      report_.add(place_of(report_, pointer, "key"), pointer + "/key",
                  fmt::format("cannot be swept. {}", instead));
      return;
    }
    std::vector<std::size_t> bases;
    for (std::size_t i = 0; i < sweep.of.size(); ++i) {
      const std::vector<std::size_t> found = find_variants(variants_, sweep.of[i]);
      const std::string place = fmt::format("{}/of/{}", pointer, i);
      if (found.empty())
        report_.add(place_of(report_, place, ""), place, unknown_variant(variants_, sweep.of[i]));
      bases.insert(bases.end(), found.begin(), found.end());
    }
    if (sweep.of.empty())
      report_.add(place_of(report_, pointer, "of"), pointer + "/of", "no variant is named");
    if (sweep.values.empty())
      report_.add(place_of(report_, pointer, "values"), pointer + "/values", "no value is given");
    if (variants_.size() + bases.size() * sweep.values.size() > kMostVariants) {
      report_.add(place_of(report_, pointer, "values"), pointer + "/values",
                  fmt::format("makes more than {} variants. Sweep fewer values, or make several "
                              "studies",
                              kMostVariants));
      return;
    }
    std::set<std::string> swept;
    for (std::size_t base : bases) swept.insert(variants_[base].name);
    for (std::size_t base : bases)
      for (std::size_t i = 0; i < sweep.values.size(); ++i) {
        Variant v = variants_[base];
        const std::string part = name_of_value(sweep, sweep.values[i]);
        v.name += "/" + part;
        v.folder.append("/").append(safe_component(part));
        v.title += ", " + part;
        v.pointer = fmt::format("{}/values/{}", pointer, i);
        v.set.push_back({{sweep.key, sweep.values[i].origin, sweep.values[i]}, v.pointer});
        // A start that is swept along has the value, too.
        if (swept.contains(v.start)) v.start += "/" + part;
        add(v, sweep.values[i]);
      }
  }

  void add(const Variant& v, const Node& value) {
    if (folders_.insert(v.folder).second) {
      variants_.push_back(v);
      return;
    }
    report_.add_value(value, v.pointer,
                      fmt::format("makes the variant \"{}\" (folder {}) a second time. Give one of "
                                  "the sweeps a label, or values that differ in letters and digits",
                                  v.name, v.folder));
  }

  void check_starts() {
    std::set<std::string> told;
    for (const Variant& v : variants_) {
      if (v.start.empty() || v.pointer.starts_with("/sweeps")) continue;
      const TextPlace origin = place_of(report_, v.pointer, "start");
      const std::vector<std::size_t> found = find_variants(variants_, v.start);
      if (found.size() != 1 || v.start.ends_with("*")) {
        report_.add(origin, v.pointer + "/start", unknown_variant(variants_, v.start));
        continue;
      }
      if (starts_in_circle(v))
        report_.add(origin, v.pointer + "/start", "variants start from each other in a circle");
      const Variant& source = variants_[found.front()];
      for (std::int64_t seed : v.seeds)
        if (std::ranges::find(source.seeds, seed) == source.seeds.end())
          report_.add(origin, v.pointer + "/start",
                      fmt::format("\"{}\" has no run with seed {}", v.start, seed));
    }
  }

  bool starts_in_circle(const Variant& v) const {
    std::set<std::string> seen;
    const Variant* at = &v;
    while (!at->start.empty()) {
      if (!seen.insert(at->name).second) return true;
      const std::vector<std::size_t> next = find_variants(variants_, at->start);
      if (next.size() != 1) return false;
      at = &variants_[next.front()];
    }
    return false;
  }

  const Study& study_;
  Report& report_;
  Document none_;
  Report silent_{none_};
  std::vector<Variant> variants_;
  std::set<std::string> folders_;  ///< of the variants
};

}  // namespace

std::string name_of_value(const StudySweep& sweep, const Node& value) {
  return fmt::format("{}={}", label_of(sweep), plain(value));
}

std::vector<Variant> make_variants(const Study& study, Report& report) {
  return Maker(study, report).make();
}

std::vector<std::size_t> find_variants(const std::vector<Variant>& variants,
                                       const std::string& name) {
  std::vector<std::size_t> found;
  const bool all = name.ends_with("*");
  for (std::size_t k = 0; k < variants.size(); ++k)
    if (all ? variants[k].name.starts_with(name.substr(0, name.size() - 1))
            : variants[k].name == name)
      found.push_back(k);
  return found;
}

std::string unknown_variant(const std::vector<Variant>& variants, const std::string& name) {
  std::vector<std::string> names;
  for (const Variant& v : variants) names.push_back(v.name);
  return no_variant(name, names);
}

}  // namespace acinus::runs
