#include "runs/session/shell_quote.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runs/scene/json_text.hpp"

namespace acinus::runs {
namespace {

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Quotes a word as $'...' of bash, zsh and ksh.
std::string quote_bytes(const std::string& word) {
  std::string inside;
  for (const char c : word) {
    const auto byte = static_cast<unsigned char>(c);
    if (is_control(c) || byte >= 0x80)
      inside += fmt::format("\\x{:02x}", byte);
    else if (c == '\'' || c == '\\')
      inside += std::string("\\") + c;
    else
      inside += c;
  }
  return "$'" + inside + "'";
}

}  // namespace

std::string quote_for_shell(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=-+,:";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  if (!is_utf8(word) || std::ranges::any_of(word, is_control)) return quote_bytes(word);
  std::string inside;
  for (const char c : word) inside += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + inside + "'";
}

}  // namespace acinus::runs
