#include "core/units/unit_parser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/spelling.hpp"

namespace acinus {
namespace {

constexpr Dimension kAmount{0, 0, 0, 0, 1};

struct Unit {
  const char* symbol;
  Dimension dimension;
  int ten;             ///< base value = 10^ten * seconds
  double seconds = 1;  ///< 60, 3600, 86400: the factors that are no power of ten
};

constexpr std::array kUnits{
    Unit{"m", kLength, 6},        Unit{"dm", kLength, 5},        Unit{"cm", kLength, 4},
    Unit{"mm", kLength, 3},       Unit{"um", kLength, 0},        Unit{"nm", kLength, -3},
    Unit{"s", kTime, 0},          Unit{"ms", kTime, -3},         Unit{"us", kTime, -6},
    Unit{"min", kTime, 0, 60},    Unit{"h", kTime, 0, 3600},     Unit{"d", kTime, 0, 86400},
    Unit{"day", kTime, 0, 86400}, Unit{"days", kTime, 0, 86400}, Unit{"N", kForce, 9},
    Unit{"mN", kForce, 6},        Unit{"uN", kForce, 3},         Unit{"nN", kForce, 0},
    Unit{"pN", kForce, -3},       Unit{"Pa", kStress, -3},       Unit{"kPa", kStress, 0},
    Unit{"MPa", kStress, 3},      Unit{"GPa", kStress, 6},       Unit{"J", kEnergy, 15},
    Unit{"mJ", kEnergy, 12},      Unit{"uJ", kEnergy, 9},        Unit{"nJ", kEnergy, 6},
    Unit{"pJ", kEnergy, 3},       Unit{"fJ", kEnergy, 0},        Unit{"aJ", kEnergy, -3},
    Unit{"kJ", kEnergy, 18},      Unit{"W", kPower, 15},         Unit{"mW", kPower, 12},
    Unit{"uW", kPower, 9},        Unit{"K", kTemperature, 0},    Unit{"mol", kAmount, 0},
    Unit{"%", kDimensionless, -2}};

/// Unit words that people write for a symbol; used for hints only, so that every scene is spelled
/// alike.
constexpr std::array<std::pair<const char*, const char*>, 20> kWords{
    {{"sec", "s"},       {"second", "s"},  {"seconds", "s"},  {"minute", "min"},
     {"minutes", "min"}, {"hr", "h"},      {"hrs", "h"},      {"hour", "h"},
     {"hours", "h"},     {"micron", "um"}, {"microns", "um"}, {"meter", "m"},
     {"metre", "m"},     {"newton", "N"},  {"pascal", "Pa"},  {"joule", "J"},
     {"watt", "W"},      {"kelvin", "K"},  {"percent", "%"},  {"micrometer", "um"}}};

constexpr int kLargestPower = 9;  ///< of an exponent: products of factors stay far inside a double

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '%'; }

void multiply(Scale& scale, const Scale& factor, int power) {
  const auto add = [power](int& sum, int term) { sum = std::clamp(sum + power * term, -999, 999); };
  add(scale.dimension.length, factor.dimension.length);
  add(scale.dimension.time, factor.dimension.time);
  add(scale.dimension.force, factor.dimension.force);
  add(scale.dimension.temperature, factor.dimension.temperature);
  add(scale.dimension.amount, factor.dimension.amount);
  add(scale.ten, factor.ten);
  for (int i = 0; i < std::abs(power); ++i) {
    scale.numerator *= power > 0 ? factor.numerator : factor.denominator;
    scale.denominator *= power > 0 ? factor.denominator : factor.numerator;
  }
}

/// Symbols of all units of the table.
std::vector<std::string> unit_symbols() {
  std::vector<std::string> symbols;
  for (const Unit& unit : kUnits) symbols.emplace_back(unit.symbol);
  return symbols;
}

/// Recursive descent parser of the unit part of a quantity.
class UnitParser {
 public:
  UnitParser(std::string_view text, std::string_view whole) : text_(text), whole_(whole) {}

  Scale parse() {
    const Scale scale = expression(0);
    if (at_ < text_.size()) fail(fmt::format("unexpected '{}' in the unit", text_.substr(at_)));
    return scale;
  }

 private:
  Scale expression(int depth) {
    if (depth > 8) fail("too many parentheses in the unit");
    Scale scale;
    bool first = true;
    while (true) {
      skip_space();
      if (at_ == text_.size() || text_[at_] == ')') break;
      int sign = 1;
      if (text_[at_] == '/') {
        sign = -1;
        ++at_;
      } else if (text_[at_] == '*') {
        if (first) fail("the unit starts with '*'");
        ++at_;
      }
      skip_space();
      multiply(scale, factor(depth), sign);
      first = false;
    }
    if (first) fail("a unit is missing");
    return scale;
  }

  Scale factor(int depth) {
    Scale scale;
    if (at_ < text_.size() && text_[at_] == '(') {
      ++at_;
      scale = expression(depth + 1);
      if (at_ == text_.size()) fail("')' is missing in the unit");
      ++at_;
    } else if (at_ < text_.size() && text_[at_] == '1' &&
               (at_ + 1 == text_.size() || !(is_digit(text_[at_ + 1]) || text_[at_ + 1] == '.'))) {
      ++at_;  // the 1 of "1/h"
    } else {
      scale = symbol();
    }
    skip_space();
    if (at_ < text_.size() && text_[at_] == '^') {
      ++at_;
      Scale raised;
      multiply(raised, scale, power());
      return raised;
    }
    return scale;
  }

  Scale symbol() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_letter(text_[at_])) ++at_;
    const std::string_view name = text_.substr(start, at_ - start);
    if (name.empty()) {
      if (start == text_.size()) fail("a unit is missing after the last sign");
      fail(fmt::format("unexpected '{}' in the unit", text_.substr(start)));
    }
    for (const Unit& unit : kUnits) {
      if (name == unit.symbol) return {unit.dimension, unit.ten, unit.seconds, 1};
    }
    const std::string hint = nearest_unit(name);
    fail(fmt::format("unknown unit \"{}\"{}", name, hint.empty() ? "" : ". " + did_you_mean(hint)));
  }

  int power() {
    skip_space();
    int value = 0;
    const char* first = text_.data() + at_;
    const auto [end, code] = std::from_chars(first, text_.data() + text_.size(), value);
    if (code != std::errc() || value == 0 || std::abs(value) > kLargestPower) {
      fail(fmt::format("the power after ^ must be a whole number from -{0} to {0}, not 0",
                       kLargestPower));
    }
    at_ += end - first;
    return value;
  }

  static std::string nearest_unit(std::string_view name) {
    for (const auto& [word, symbol] : kWords) {
      if (edit_distance(name, word) == 0) return symbol;
    }
    return nearest_name(name, unit_symbols());
  }

  void skip_space() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(fmt::format("\"{}\": {}", whole_, message));
  }

  std::string_view text_, whole_;
  std::size_t at_ = 0;
};

}  // namespace

Scale parse_unit(std::string_view text, std::string_view whole) {
  return UnitParser(text, whole).parse();
}

}  // namespace acinus
