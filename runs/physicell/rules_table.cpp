#include "runs/physicell/rules_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "geometry/readers/input_file.hpp"

namespace acinus::runs {
namespace {

/// One line, with messages that name it.
struct TableRow {
  std::string where;
  std::vector<std::string> column;

  [[noreturn]] void fail(const std::string& what) const { throw Error(where + ": " + what); }

  double number(std::size_t k, const char* name) const {
    const std::string& text = column[k];
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("column {} \"{}\": is no number. The {} stands here.", k + 1, text, name));
    return value;
  }
  double positive(std::size_t k, const char* name) const {
    const double value = number(k, name);
    if (!(value > 0))
      fail(fmt::format("column {} \"{}\": the {} must be > 0.", k + 1, column[k], name));
    return value;
  }
  double not_negative(std::size_t k, const char* name) const {
    const double value = number(k, name);
    if (value < 0)
      fail(fmt::format("column {} \"{}\": the {} must be >= 0.", k + 1, column[k], name));
    return value;
  }
  bool decreases(std::size_t k) const {
    if (column[k] != "increases" && column[k] != "decreases")
      fail(fmt::format("column {} \"{}\": must be increases or decreases.", k + 1, column[k]));
    return column[k] == "decreases";
  }
  bool flag(std::size_t k) const { return number(k, "flag \"applies to dead\" (0 or 1)") != 0; }
};

PhysiCellRule read_rule(const TableRow& row, int line) {
  constexpr std::size_t kWithoutBase = 8, kWithBase = 9, kOldest = 10;
  const std::size_t n = row.column.size();
  if (n != kWithoutBase && n != kWithBase && n != kOldest)
    row.fail(fmt::format(
        "{} columns. A rule has 8: cell type, signal, direction, behaviour, value at full "
        "response, half-max, Hill power, applies to dead (9 with the base value, version 1; 10 in "
        "version 0). Separate them by commas or tabs, and begin comments with //.",
        n));
  for (std::size_t k = 0; k < n; ++k)
    if (row.column[k].empty()) row.fail(fmt::format("column {} is empty.", k + 1));
  PhysiCellRule r;
  r.line = line;
  r.cell_type = row.column[0];
  if (n == kOldest) {
    r.behaviour = row.column[1];
    r.signal = row.column[5];
    r.decreases = row.decreases(6);
    r.base = row.not_negative(3, "base value");
    r.extreme =
        r.decreases ? row.not_negative(2, "least value") : row.not_negative(4, "largest value");
  } else {
    r.signal = row.column[1];
    r.decreases = row.decreases(2);
    r.behaviour = row.column[3];
    if (n == kWithBase) r.base = row.not_negative(4, "base value");
    r.extreme = row.not_negative(n - 4, "value at full response");
  }
  r.half_max = row.positive(n - 3, "half-max");
  r.power = row.positive(n - 2, "Hill power");
  r.dead = row.flag(n - 1);
  return r;
}

}  // namespace

std::vector<PhysiCellRule> parse_physicell_rules(const std::string& text,
                                                 const std::string& source) {
  std::vector<PhysiCellRule> rules;
  std::istringstream lines(text.starts_with("\xEF\xBB\xBF") ? text.substr(3) : text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string content = geometry::trimmed(line);
    if (content.empty() || content.starts_with("//")) continue;
    const char separator = line.find(',') != std::string::npos ? ',' : '\t';
    rules.push_back(read_rule(
        {fmt::format("{}:{}", source, number), geometry::split_fields(content, separator)},
        number));
  }
  check(!rules.empty(), source + ": no rule in it. Each line of a rules table is one rule.");
  return rules;
}

}  // namespace acinus::runs
