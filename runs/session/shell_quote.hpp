#pragma once
/// Commands that users can copy into their shell.

#include <string>

namespace acinus::runs {

/// The word as a shell takes it: in quotes where it has anything that shells read otherwise.
inline std::string quote_for_shell(const std::string& word) {
  constexpr const char* kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./=-+,:";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
  std::string inside;
  for (const char c : word) inside += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + inside + "'";
}

}  // namespace acinus::runs
