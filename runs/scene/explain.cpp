#include "runs/scene/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/error.hpp"
#include "core/spelling.hpp"
#include "runs/scene/entries.hpp"

namespace acinus::runs {
namespace {

/// Path parts without the numbers and names of elements: "cells.list.0.position" and
/// "/cells/list/<number>/position" become {"cells", "list", "position"}.
std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  std::string part;
  const auto close = [&] {
    const bool element = part.empty() || part.front() == '<' ||
                         part.find_first_not_of("0123456789") == std::string::npos;
    if (!element) parts.push_back(part);
    part.clear();
  };
  for (const char c : path) {
    if (c == '.' || c == '/') {
      close();
    } else {
      part += c;
    }
  }
  close();
  return parts;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ".") + part;
  return text;
}

bool ends_with(const std::vector<std::string>& parts, const std::vector<std::string>& tail) {
  return tail.size() <= parts.size() && std::equal(tail.rbegin(), tail.rend(), parts.rbegin());
}

/// Matching entries of the strictest kind that has any: the full path, the end of a path, or a path
/// in which the query's parts occur in this order, as in cell_types.hepatocyte.radius.
std::vector<const Entry*> find_entries(const std::string& query,
                                       const std::vector<Entry>& entries) {
  const std::vector<std::string> wanted = parts_of(query);
  std::vector<const Entry*> exact, tail;
  for (const Entry& entry : entries) {
    const auto full = parts_of(entry.path), brief = parts_of(entry.short_path);
    if (full == wanted || brief == wanted || entry.short_path + "." == query) {
      exact.push_back(&entry);
    } else if (!wanted.empty() && (ends_with(full, wanted) || ends_with(brief, wanted))) {
      tail.push_back(&entry);
    }
  }
  if (!exact.empty() || !tail.empty()) return exact.empty() ? tail : exact;
  // A concrete cell type name in the middle: drop the second part.
  if (wanted.size() > 2 && wanted[0] == "cell_types") {
    std::vector<std::string> rest = wanted;
    rest.erase(rest.begin() + 1);
    return find_entries(joined(rest), entries);
  }
  // study.measure.kind: the end of study.expectations.<number>.measure.kind.
  if (wanted.size() > 1 && (wanted[0] == "study" || wanted[0] == "inference"))
    return find_entries(joined({wanted.begin() + 1, wanted.end()}), entries);
  return {};
}

std::string type_text(const Entry& entry) {
  if (entry.unit.empty()) return entry.type;
  const std::string name = dimension_name(entry.dimension);
  return fmt::format("{}, {}", entry.type,
                     name.empty() ? dimension_formula(entry.dimension) : name);
}

std::string default_text(const Entry& entry) {
  if (entry.is_block) return "(" + entry.type + ")";
  return entry.initial.empty() ? "(required)" : entry.initial;
}

/// Keys right inside a block with default and meaning, a line each.
std::string keys_of(const Entry& block, const std::vector<Entry>& entries) {
  constexpr std::size_t kWidestDefault = 26;
  std::vector<std::pair<std::string, const Entry*>> keys;
  std::size_t width = 0, default_width = 0;
  for (const Entry& entry : entries) {
    if (!entry.path.starts_with(block.path + ".")) continue;
    std::string name = entry.path.substr(block.path.size() + 1);
    if (name.front() == '<') name = name.substr(name.find('.') + 1);
    if (name.find('.') != std::string::npos) continue;
    width = std::max(width, name.size());
    default_width = std::max(default_width, std::min(default_text(entry).size(), kWidestDefault));
    keys.emplace_back(std::move(name), &entry);
  }
  std::string text = "  keys\n";
  for (const auto& [name, entry] : keys) {
    const std::string condition =
        entry->condition.empty() ? "" : fmt::format(" (only with {})", entry->condition);
    const std::string choices =
        entry->type == "text" && entry->range.find(", ") != std::string::npos
            ? fmt::format(" [{}]", entry->range)
            : "";
    text += fmt::format("    {:{}}  {:{}}  {}{}{}\n", name, width, default_text(*entry),
                        default_width, entry->meaning, choices, condition);
  }
  return text;
}

std::string described(const Entry& entry, const std::vector<Entry>& entries) {
  std::string text =
      fmt::format("{}\n  {}\n  type     {}\n", entry.path, entry.meaning, type_text(entry));
  if (!entry.unit.empty()) {
    text += fmt::format("  unit     {} (inside the program: {})\n", entry.unit,
                        base_unit(entry.dimension));
  }
  if (!entry.is_block || !entry.initial.empty()) {
    text += fmt::format("  default  {}\n",
                        entry.initial.empty() ? "none, must be given" : entry.initial);
  }
  if (!entry.range.empty()) text += fmt::format("  range    {}\n", entry.range);
  if (!entry.condition.empty()) text += fmt::format("  only     with {}\n", entry.condition);
  if (!entry.symbol.empty()) text += fmt::format("  paper    {}\n", entry.symbol);
  return entry.is_block ? text + keys_of(entry, entries) : text;
}

std::string cell_text(std::string text) {  // a | would end the table cell
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.insert(at, "\\");
  }
  return text;
}

std::string code(const std::string& text) { return text.empty() ? "" : "`" + text + "`"; }

}  // namespace

std::string explain_key(const std::string& query, const std::vector<Entry>& entries) {
  const std::vector<const Entry*> found = find_entries(query, entries);
  if (found.empty()) {
    const std::string wanted = joined(parts_of(query));
    std::vector<std::string> names, last_parts;
    for (const Entry& entry : entries) {
      names.push_back(joined(parts_of(entry.short_path)));
      last_parts.push_back(parts_of(entry.path).back());
    }
    std::string hint = nearest_name(wanted, names);
    const std::vector<std::string> parts = parts_of(query);
    if (hint.empty() && !parts.empty()) hint = nearest_name(parts.back(), last_parts);
    const std::string kind = query.starts_with("study.")       ? "study"
                             : query.starts_with("inference.") ? "inference"
                                                               : "scene";
    const std::string all =
        fmt::format("`acinus explain{}` lists all", kind == "scene" ? "" : " " + kind);
    throw Error(fmt::format("no {} key \"{}\". {}", kind, query, did_you_mean_and(hint, all)));
  }
  std::string text;
  for (const Entry* entry : found) text += (text.empty() ? "" : "\n") + described(*entry, entries);
  return text;
}

std::string explain_all(const std::vector<Entry>& entries) {
  std::size_t width = 0;
  for (const Entry& entry : entries) width = std::max(width, entry.short_path.size());
  std::string text;
  for (const Entry& entry : entries) {
    text += fmt::format("{:{}}  {:18}  {}\n", entry.short_path, width, default_text(entry),
                        entry.meaning);
  }
  return text;
}

std::string explain_markdown() {
  std::string text =
      "# Scene keys\n\n"
      "Printed by `acinus explain --markdown`; a test compares this page with the program.\n"
      "`cell` stands for `cell_types.<name>`, `wall` for one element of `walls`, and so on. "
      "Quantities are texts with a unit. Absolute limits of their size, in base units (um, s, nN): "
      "0, or from 1e-15 to 1e12, of lengths to 1e6. The column \"paper\" has the symbol of "
      "[VanLiedekerke2020](references.bib).\n\n"
      "| key | type | default | range | meaning | paper |\n"
      "|---|---|---|---|---|---|\n";
  for (const Entry& entry : all_entries()) {
    std::string meaning = entry.meaning;
    if (!entry.condition.empty()) meaning += " (only with " + entry.condition + ")";
    const std::string initial =
        entry.initial.empty() ? (entry.is_block ? "" : "required") : code(entry.initial);
    text +=
        fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(entry.short_path), type_text(entry),
                    initial, cell_text(entry.range), cell_text(meaning), code(entry.symbol));
  }
  return text;
}

}  // namespace acinus::runs
