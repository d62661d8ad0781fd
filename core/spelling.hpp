#pragma once
/// Spelling hints: the known word nearest to a misspelt one.

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace acinus {

/// Edit distance of two words (insert, delete, replace, swap of neighbours), upper and lower case
/// taken as equal. Words above 64 characters are not compared: a hint for them is of no use and the
/// cost grows with the product of the lengths.
inline std::size_t edit_distance(std::string_view word_a, std::string_view word_b) {
  constexpr std::size_t kLongest = 64;
  const std::size_t n_a = word_a.size(), n_b = word_b.size();
  if (n_a > kLongest || n_b > kLongest) return std::max(n_a, n_b);
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  std::array<std::array<std::size_t, kLongest + 1>, kLongest + 1> cost{};
  for (std::size_t i = 0; i <= n_a; ++i) cost[i][0] = i;
  for (std::size_t j = 0; j <= n_b; ++j) cost[0][j] = j;
  for (std::size_t i = 1; i <= n_a; ++i) {
    for (std::size_t j = 1; j <= n_b; ++j) {
      const bool equal = same(word_a[i - 1], word_b[j - 1]);
      cost[i][j] =
          std::min({cost[i - 1][j] + 1, cost[i][j - 1] + 1, cost[i - 1][j - 1] + (equal ? 0 : 1)});
      if (i > 1 && j > 1 && same(word_a[i - 1], word_b[j - 2]) &&
          same(word_a[i - 2], word_b[j - 1])) {
        cost[i][j] = std::min(cost[i][j], cost[i - 2][j - 2] + 1);
      }
    }
  }
  return cost[n_a][n_b];
}

/// Candidate with the smallest edit distance to a word, or "" if more than a third of the word's
/// letters, at least 1, would have to change.
inline std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(1, (word.size() + 1) / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < best_distance && distance < candidate.size()) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

/// Spelling hint `Did you mean "radius"?`, or `otherwise` where there is none.
/// @param hint  of nearest_name
inline std::string did_you_mean(const std::string& hint, const std::string& otherwise = "") {
  return hint.empty() ? otherwise : "Did you mean \"" + hint + "\"?";
}

/// Spelling hint followed by a text that is given with and without it.
inline std::string did_you_mean_and(const std::string& hint, const std::string& more) {
  return hint.empty() ? more : did_you_mean(hint) + " " + more;
}

}  // namespace acinus
