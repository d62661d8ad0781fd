#pragma once
/// Sums that are the same whatever the order of their terms, and whoever adds which of them.
/// [Neal2015, small superaccumulator]

#include <array>
#include <cstdint>
#include <span>

namespace acinus {

/// The exact sum of any finite numbers as one long integer, in words that overlap: each holds 32
/// bits of it and room for carries. 67 words, two of which a term touches, and three that count the
/// terms that are not finite.
class ExactSum {
 public:
  static constexpr int kDigitWords = 67, kWords = kDigitWords + 3;

  void add(double value);
  void add(const ExactSum& other);
  /// The sum, rounded once to the nearest double, to even in the middle. Infinite beyond the
  /// largest; NaN with a NaN or both infinities among the terms.
  double value() const;

  /// What ranks add up word by word: made ready for a sum of up to 2^30 of them.
  std::span<std::int64_t> words();

 private:
  enum { kNan = kDigitWords, kPlusInfinity, kMinusInfinity };
  void carry();
  std::array<std::int64_t, kWords> word_{};  ///< of 2^(32 k - 1075); then what is not finite
  int n_since_carry_ = 0;
};

}  // namespace acinus
