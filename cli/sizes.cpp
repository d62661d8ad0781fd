#include "cli/sizes.hpp"

#include <fmt/format.h>

#include <charconv>

#include "core/error.hpp"

namespace acinus::cli {

double parse_size(const std::string& text) {
  double value = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string unit(end, text.data() + text.size());
  std::erase(unit, ' ');
  const double scale = unit == "TB" ? 1e12 : unit == "GB" ? 1e9 : unit == "MB" ? 1e6 : 0;
  check(code == std::errc() && scale > 0,
        fmt::format("\"{}\": a size is written like 16GB or \"500 MB\"", text));
  return scale * value;
}

}  // namespace acinus::cli
