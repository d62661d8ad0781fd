#include "runs/scene/entries.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <ranges>
#include <utility>

#include "core/units/units.hpp"
#include "runs/scene/registry.hpp"

namespace acinus::runs {

namespace {

/// Turns the visit of a default scene into the list of entries.
class EntryCollector final : public Visitor {
 public:
  void real(const Key& key, double& value) override {
    add(key,
        key.any_unit  ? "number or quantity"
        : key.unit[0] ? "quantity"
                      : "number",
        in_quotes(key, value), bounds(key));
  }
  void optional_real(const Key& key, std::optional<double>&) override {
    add(key, key.unit[0] ? "quantity" : "number", "\"auto\"", bounds(key));
  }
  void integer(const Key& key, int& value) override {
    add(key, "whole number", std::to_string(value), bounds(key));
  }
  void seed(const Key& key, std::uint64_t& value) override {
    add(key, "whole number", std::to_string(value), "from 0 to 2^64 - 1");
  }
  void flag(const Key& key, bool& value) override {
    add(key, "true or false", value ? "true" : "false", "");
  }
  void text(const Key& key, std::string& value) override {
    const char* type = key.is_file || key.is_run     ? "path"
                       : key.is_name || key.is_label ? "name"
                                                     : "text";
    add(key, type, key.automatic[0] ? "\"auto\"" : "\"" + value + "\"", bounds(key));
  }
  void vector(const Key& key, Vec3& value) override {
    add(key, key.unit[0] ? "three quantities" : "three numbers",
        fmt::format("[{}, {}, {}]", in_quotes(key, value.x()), in_quotes(key, value.y()),
                    in_quotes(key, value.z())),
        bounds(key));
  }
  void box(const Key& key, std::optional<std::array<Vec3, 2>>&) override {
    add(key, "two corners or null", "null", "");
  }
  void counts(const Key& key, std::array<int, 3>& value) override {
    add(key, "three whole numbers", fmt::format("[{}]", fmt::join(value, ", ")), bounds(key));
  }
  void integers(const Key& key, std::vector<std::int64_t>& values) override {
    add(key, "whole numbers", fmt::format("[{}]", fmt::join(values, ", ")), bounds(key));
  }
  void texts(const Key& key, std::vector<std::string>&) override {
    add(key, "list of texts", "[]", bounds(key));
  }
  void value(const Key& key, std::optional<Node>&) override {
    add(key, "number or quantity", key.automatic[0] ? "\"auto\"" : "none", bounds(key));
  }
  void values(const Key& key, std::vector<Node>&) override {
    add(key, "list of values", "[]", bounds(key));
  }
  void settings(const Key& key, std::vector<JsonMember>&) override {
    add(key, "values by scene key", "{}", bounds(key));
  }
  void object(const Key& key, const Members& members) override {
    add_block(key, "block", "");
    inside(key, key.name, [&] { members(*this); });
  }
  void optional_object(const Key& key, bool, const std::function<void(bool)>&,
                       const Members& members) override {
    add_block(key, "block or null", "null");
    inside(key, key.name, [&] { members(*this); });
  }
  void list(const Key& key, const Elements& elements) override {
    add_block(key, "list of blocks", "[]");
    inside(key, std::string(key.name) + ".<number>", [&] { elements.visit_sample(*this); });
  }
  void map(const Key& key, const Elements& elements) override {
    add_block(key, "blocks by name", "");
    inside(key, std::string(key.name) + ".<name>", [&] { elements.visit_sample(*this); });
  }
  void when(bool, const char* condition, const Members& members) override {
    condition_ = condition;
    members(*this);
    condition_.clear();
  }

  std::vector<Entry> entries;

 private:
  static std::string in_quotes(const Key& key, double value) {
    const std::string text = format_quantity(value, key.dimension, key.unit);
    return key.unit[0] ? "\"" + text + "\"" : text;
  }

  static std::string bounds(const Key& key) {
    std::string text = key.choices[0] ? fmt::format("{}{}", key.is_file ? "a file, " : "",
                                                    fmt::join(choices_of(key), ", "))
                                      : range_text(key.range, key.dimension, key.unit);
    if (key.automatic[0]) {
      text += fmt::format("{}\"auto\" = {}", text.empty() ? "" : "; ", key.automatic);
    }
    return text;
  }

  void add(const Key& key, const char* type, std::string initial, std::string range) {
    Entry entry;
    entry.path = at_.path + key.name;
    entry.short_path = at_.short_path + key.name;
    entry.type = type;
    entry.dimension = key.dimension;
    entry.unit = key.unit;
    entry.initial = key.required ? "" : std::move(initial);
    entry.range = std::move(range);
    entry.meaning = key.meaning;
    entry.symbol = key.symbol;
    entry.condition = condition_;
    entry.is_file = key.is_file;
    entry.choices = choices_of(key);
    entry.affects = key.affects.value_or(at_.affects);
    entry.compared = key.compared.value_or(at_.compared);
    entry.softens = key.softens;
    entry.in_law = key.in_law;
    entry.law_name = key.law_name;
    entries.push_back(std::move(entry));
  }

  void add_block(const Key& key, const char* type, const char* initial) {
    add(key, type, initial, "");
    entries.back().is_block = true;
  }

  /// Visits the members of a block or of an element of a list or map.
  /// @param name  of the block within the one around: "life", "walls.<number>"
  void inside(const Key& block, const std::string& name, const std::function<void()>& members) {
    const EnclosingBlock around = at_;
    const std::string item = block.item;
    at_.path += name + ".";
    at_.short_path = item.empty() ? at_.short_path + name + "." : item + ".";
    at_.affects = block.affects.value_or(around.affects);
    at_.compared = block.compared.value_or(around.compared);
    members();
    at_ = around;
  }

  /// Block whose members are visited.
  struct EnclosingBlock {
    std::string path, short_path;
    Affects affects = Affects::kStart;
    bool compared = true;
  };
  EnclosingBlock at_;
  std::string condition_;
};

using Names = std::vector<std::string>;

bool is_index(const std::string& name) {
  return !name.empty() && std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; });
}

/// True if a pattern, such as "walls", "<number>", fits the first names of a path.
bool leads_to(const Names& path, const Names& pattern) {
  return pattern.size() <= path.size() &&
         std::ranges::equal(pattern, path | std::views::take(pattern.size()),
                            [](const std::string& part, const std::string& name) {
                              return part == name || part == "<name>" ||
                                     (part == "<number>" && (is_index(name) || name == part));
                            });
}

}  // namespace

std::vector<Entry> collect_entries(const char* extends,
                                   const std::function<void(Visitor&)>& describe,
                                   const std::string& prefix) {
  EntryCollector collector;
  Entry& first = collector.entries.emplace_back();
  first.path = first.short_path = "extends";
  first.type = "path";
  first.initial = "none";
  first.affects = Affects::kNothing;
  first.compared = false;
  first.meaning = extends;
  describe(collector);
  for (Entry& entry : collector.entries) {
    entry.path = prefix + entry.path;
    entry.short_path = prefix + entry.short_path;
  }
  return std::move(collector.entries);
}

const std::vector<Entry>& all_entries() {
  static const std::vector<Entry> entries = [] {
    Scene scene;
    return collect_entries("scene file this one changes, relative to this file: blocks are merged",
                           [&](Visitor& visitor) { describe(visitor, scene); });
  }();
  return entries;
}

std::vector<std::string> names_in_path(std::string_view path) {
  Names names(1);
  for (const char c : path) {
    if (c != '.' && c != '/')
      names.back() += c;
    else if (!names.back().empty())
      names.emplace_back();
  }
  if (names.back().empty()) names.pop_back();
  return names;
}

const Entry* find_innermost_entry(std::string_view path) {
  // Patterns are split once: lists of thousands of cells ask for a key of each.
  static const std::vector<Names> patterns = [] {
    std::vector<Names> all;
    for (const Entry& entry : all_entries()) all.push_back(names_in_path(entry.path));
    return all;
  }();
  const Names names = names_in_path(path);
  std::size_t length = 0;
  const Entry* found = nullptr;
  for (std::size_t k = 0; k < patterns.size(); ++k)
    if (patterns[k].size() > length && leads_to(names, patterns[k])) {
      length = patterns[k].size();
      found = &all_entries()[k];
    }
  return found;
}

const Entry* find_entry(std::string_view path) {
  const Entry* entry = find_innermost_entry(path);
  return entry != nullptr && names_in_path(entry->path).size() == names_in_path(path).size()
             ? entry
             : nullptr;
}

}  // namespace acinus::runs
