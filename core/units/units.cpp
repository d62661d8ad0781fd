#include "core/units/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "core/units/dimension.hpp"
#include "core/units/unit_parser.hpp"

namespace acinus {
namespace {

/// Text with both micro signs (U+00B5 and U+03BC) as "u" and the middle dot as "*".
std::string plain_letters(std::string_view text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string_view pair = text.substr(i, 2);
    if (pair == "\xC2\xB5" || pair == "\xCE\xBC") {
      plain += 'u';
      ++i;
    } else if (pair == "\xC2\xB7") {
      plain += '*';
      ++i;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

/// Leading number of a quantity, cut into digits and decimal exponent.
struct Number {
  std::string_view digits;  ///< sign, digits, point
  long exponent = 0;
  std::size_t length = 0;  ///< characters read; 0 = no number
};

Number scan_number(std::string_view text) {
  Number number;
  std::size_t at = 0;
  if (at < text.size() && (text[at] == '+' || text[at] == '-')) ++at;
  std::size_t n_digit = 0;
  for (bool point = false; at < text.size(); ++at) {
    if (is_digit(text[at])) {
      ++n_digit;
    } else if (text[at] == '.' && !point) {
      point = true;
    } else {
      break;
    }
  }
  if (n_digit == 0) return number;
  number.digits = text.substr(0, at);
  if (at < text.size() && (text[at] == 'e' || text[at] == 'E')) {
    std::size_t end = at + 1;
    if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
    const std::size_t first_digit = end;
    while (end < text.size() && is_digit(text[end])) ++end;
    if (end > first_digit) {
      // Six digits are already far outside a double; more would overflow the integer.
      const std::string_view digits =
          text.substr(first_digit, std::min<std::size_t>(end - first_digit, 6));
      std::from_chars(digits.data(), digits.data() + digits.size(), number.exponent);
      if (text[at + 1] == '-') number.exponent = -number.exponent;
      at = end;
    }
  }
  number.length = at;
  return number;
}

/// Double nearest to digits * 10^exponent.
double to_double(std::string_view digits, long exponent, std::string_view whole) {
  if (digits.front() == '+') digits.remove_prefix(1);
  const std::string text = fmt::format("{}e{}", digits, exponent);
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  check(code == std::errc() && end == text.data() + text.size() && std::isfinite(value),
        fmt::format("\"{}\": the value is outside the range of numbers", whole));
  return value;
}

double scaled(const Number& number, const Scale& scale, std::string_view whole) {
  const double decimal = to_double(number.digits, number.exponent + scale.ten, whole);
  const double value = decimal * scale.numerator / scale.denominator;
  check(std::isfinite(value) && (value != 0 || decimal == 0),
        fmt::format("\"{}\": the value is outside the range of numbers", whole));
  return value;
}

/// Decimal number in plain spelling: "2.50e+03" -> "2500", "1.0e-05" -> "1e-5".
std::string tidy(const std::string& scientific) {
  const std::size_t e = scientific.find('e');
  std::string digits = scientific.substr(0, e);
  const int exponent = std::stoi(scientific.substr(e + 1));
  const std::string sign = digits.front() == '-' ? "-" : "";
  digits.erase(0, sign.size());
  std::erase(digits, '.');
  while (digits.size() > 1 && digits.back() == '0') digits.pop_back();
  const int n_digit = static_cast<int>(digits.size());
  if (exponent < -3 || exponent > 5) {
    if (n_digit > 1) digits.insert(1, ".");
    return fmt::format("{}{}e{}", sign, digits, exponent);
  }
  if (exponent < 0) {
    digits.insert(0, "0." + std::string(-exponent - 1, '0'));
  } else if (exponent + 1 >= n_digit) {
    digits.append(exponent + 1 - n_digit, '0');
  } else {
    digits.insert(exponent + 1, ".");
  }
  return sign + digits;
}

std::string described(Dimension dimension) {
  const std::string name = dimension_name(dimension);
  return name.empty() ? dimension_formula(dimension)
                      : fmt::format("{} ({})", dimension_formula(dimension), name);
}

std::string with_article(Dimension dimension) {
  const std::string name = dimension_name(dimension);
  return name.empty() ? dimension_formula(dimension) : name;
}

}  // namespace

double parse_quantity(std::string_view text, Dimension needed) {
  const std::string whole = plain_letters(text);
  std::string_view rest = whole;
  const auto trim = [&rest] {
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
    while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t')) rest.remove_suffix(1);
  };
  trim();
  check(rest.size() <= 200, fmt::format("\"{}...\": too long for a quantity", rest.substr(0, 60)));
  const Number number = scan_number(rest);
  check(number.length > 0,
        fmt::format("\"{}\": does not start with a number; needed {}, e.g. \"{}\"", text,
                    with_article(needed), dimension_example(needed)));
  rest.remove_prefix(number.length);
  trim();
  if (rest.empty()) {
    check(needed == kDimensionless, fmt::format("\"{}\": has no unit; needed {}, e.g. \"{}\"", text,
                                                with_article(needed), dimension_example(needed)));
    return scaled(number, {}, text);
  }
  const Scale scale = parse_unit(rest, text);
  check(scale.dimension == needed,
        fmt::format("\"{}\": has dimension {}, needed {}, e.g. \"{}\"", text,
                    described(scale.dimension), with_article(needed), dimension_example(needed)));
  return scaled(number, scale, text);
}

std::string format_quantity(double value, Dimension dimension, std::string_view unit) {
  check(std::isfinite(value), fmt::format("cannot write {} as a quantity", value));
  const std::string gap = unit.empty() ? "" : " ";
  Scale scale;
  if (!unit.empty()) scale = parse_unit(unit, unit);
  check(scale.dimension == dimension,
        fmt::format("unit \"{}\" has dimension {}, needed {}", unit, described(scale.dimension),
                    described(dimension)));
  if (value == 0) return "0" + gap + std::string(unit);
  if (scale.numerator == scale.denominator) {
    // Powers of ten only shift the exponent of the shortest digits, so nothing has to be searched.
    std::array<char, 64> buffer{};
    const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                           std::chars_format::scientific);
    ACINUS_ASSERT(code == std::errc());
    const Number shortest = scan_number({buffer.data(), end});
    return tidy(fmt::format("{}e{}", shortest.digits, shortest.exponent - scale.ten)) + gap +
           std::string(unit);
  }
  const double wanted = value / (std::pow(10.0, scale.ten) * scale.numerator / scale.denominator);
  for (int n_digit = 1; n_digit <= 17 && std::isfinite(wanted); ++n_digit) {
    const std::string digits = tidy(fmt::format("{:.{}e}", wanted, n_digit - 1));
    // Not through parse_quantity: digits that overflow must be skipped here, not reported.
    const Number number = scan_number(digits);
    double decimal = 0;
    const std::string text = fmt::format("{}e{}", number.digits, number.exponent + scale.ten);
    const auto result = std::from_chars(text.data(), text.data() + text.size(), decimal);
    if (result.ec == std::errc() && decimal * scale.numerator / scale.denominator == value) {
      return digits + gap + std::string(unit);
    }
  }
  const std::string base = base_unit(dimension);
  return tidy(fmt::format("{:.16e}", value)) + (base.empty() ? "" : " ") + base;
}

UnitScale scale_of_unit(std::string_view unit) {
  if (unit.empty() || unit == "1") return {};
  if (unit.starts_with("1/")) unit.remove_prefix(1);  // a number is no unit
  const Scale scale = parse_unit(unit, unit);
  return {scale.dimension, scaled(scan_number("1"), scale, unit)};
}

}  // namespace acinus
