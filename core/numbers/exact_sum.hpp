#pragma once
/// Exact sums: the result does not depend on the order of the terms, nor on the threads and
/// processes that add them. [Neal2015, small superaccumulator]

#include <array>
#include <cstdint>
#include <span>

namespace acinus {

/// Exact sum of doubles as one long integer in overlapping words: each holds 32 bits of it and
/// spare bits for carries. 67 words, of which a term changes two, and three that count the terms
/// that are not finite.
class ExactSum {
 public:
  static constexpr int kDigitWords = 67, kWords = kDigitWords + 3;

  void add(double value);
  void add(const ExactSum& other);
  /// Sum rounded once to the nearest double, ties to even. Infinite beyond the largest double; NaN
  /// with a NaN or both infinities among the terms.
  double value() const;

  /// Words for an elementwise sum over ranks, carried first: up to 2^30 ranks cannot overflow.
  std::span<std::int64_t> words();

 private:
  enum { kNan = kDigitWords, kPlusInfinity, kMinusInfinity };
  void carry();
  std::array<std::int64_t, kWords>
      word_{};  ///< word k counts 2^(32 k - 1075); the last count the terms that are not finite
  int n_since_carry_ = 0;
};

}  // namespace acinus
