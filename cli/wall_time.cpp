#include "cli/wall_time.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "cli/command.hpp"
#include "core/error.hpp"

namespace acinus::cli {

double parse_wall_time(const std::string& text) {
  const auto fail = [&text](const char* why) {
    throw Error(fmt::format("\"{}\": {}; a wall time is written like 10min, 23h30m or \"600 s\"",
                            text, why));
  };
  double sum = 0;
  std::size_t at = 0;
  const auto skip_space = [&] {
    while (at < text.size() && text[at] == ' ') ++at;
  };
  bool any = false;
  for (skip_space(); at < text.size(); skip_space()) {
    double value = 0;
    const char* first = text.data() + at;
    const auto [end, code] =
        std::from_chars(first, text.data() + text.size(), value, std::chars_format::fixed);
    if (code != std::errc() || !std::isfinite(value) || value < 0) fail("not a positive number");
    at += end - first;
    skip_space();
    std::string unit;
    while (at < text.size() && std::isalpha(static_cast<unsigned char>(text[at]))) {
      unit += text[at++];
    }
    if (unit == "s") {
      sum += value;
    } else if (unit == "m" || unit == "min") {
      sum += 60 * value;
    } else if (unit == "h") {
      sum += 3600 * value;
    } else if (unit == "d" || unit == "day" || unit == "days") {
      sum += 86400 * value;
    } else {
      fail(unit.empty() ? "has no unit" : "unknown unit");
    }
    any = true;
  }
  if (!any) fail("is empty");
  if (!std::isfinite(sum)) fail("too long");
  return sum;
}

void add_wall_time_limit(CLI::App& command, std::string& text, const char* help) {
  command.add_option("--max-walltime", text, help)->type_name("WALL");
}

double read_wall_time_limit(const std::string& text) {
  if (text.empty()) return std::numeric_limits<double>::infinity();
  return flag_value("--max-walltime", text, parse_wall_time);
}

}  // namespace acinus::cli
