#include "core/numbers/exact_sum.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace acinus {
namespace {

constexpr int kWordBits = 32;
constexpr int kMantissaBits = 52;                   ///< stored mantissa bits of a double
constexpr std::uint64_t kNotFiniteExponent = 2047;  ///< exponent field of infinity and NaN
constexpr int kLowestPower = -1075;                 ///< power of two of the lowest bit of word 0
/// Terms between two carries: each adds less than 2^52 to a word, which overflows at 2^63.
constexpr int kMostTerms = 2047;

__extension__ using Wide = unsigned __int128;

/// Double nearest to v * 2^power, ties to even. @param v  96 bits or less
double round_to_double(Wide v, int power) {
  int top = 127;
  while (top > 0 && ((v >> top) & 1) == 0) --top;
  if (const int shift = top - kMantissaBits; shift > 0) {
    const Wide half = static_cast<Wide>(1) << (shift - 1);
    const Wide rest = v & ((half << 1) - 1);
    v >>= shift;
    if (rest > half || (rest == half && (v & 1) != 0)) ++v;
    power += shift;
  }
  return std::ldexp(static_cast<double>(static_cast<std::uint64_t>(v)), power);
}

}  // namespace

void ExactSum::add(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  std::uint64_t exponent = (bits >> kMantissaBits) & kNotFiniteExponent;
  if (exponent == kNotFiniteExponent) {
    ++word_[std::isnan(value) ? kNan : value > 0 ? kPlusInfinity : kMinusInfinity];
    return;
  }
  std::uint64_t digits = bits & ((std::uint64_t{1} << kMantissaBits) - 1);
  if (exponent == 0)
    exponent = 1;
  else
    digits |= std::uint64_t{1} << kMantissaBits;
  const std::uint64_t word = exponent / kWordBits, shift = exponent % kWordBits;
  const auto low = static_cast<std::int64_t>((digits << shift) & 0xffffffffU);
  const auto high = static_cast<std::int64_t>(digits >> (kWordBits - shift));
  const bool negative = (bits >> 63) != 0;
  word_[word] += negative ? -low : low;
  word_[word + 1] += negative ? -high : high;
  if (++n_since_carry_ == kMostTerms) carry();
}

void ExactSum::add(const ExactSum& other) {
  carry();
  ExactSum ready = other;
  ready.carry();
  for (int k = 0; k < kWords; ++k) word_[k] += ready.word_[k];
  carry();
}

/// Propagates carries: each word but the last, which has the sign, keeps 32 bits.
void ExactSum::carry() {
  for (int k = 0; k + 1 < kDigitWords; ++k) {
    const std::int64_t over = word_[k] >> kWordBits;  // towards minus infinity
    word_[k] -= over << kWordBits;
    word_[k + 1] += over;
  }
  n_since_carry_ = 0;
}

std::span<std::int64_t> ExactSum::words() {
  carry();
  return word_;
}

double ExactSum::value() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool plus = word_[kPlusInfinity] > 0, minus = word_[kMinusInfinity] > 0;
  if (word_[kNan] > 0 || (plus && minus)) return std::numeric_limits<double>::quiet_NaN();
  if (plus || minus) return plus ? kInfinity : -kInfinity;
  ExactSum sum = *this;
  sum.carry();
  const bool negative = sum.word_[kDigitWords - 1] < 0;
  if (negative) {
    for (int k = 0; k < kDigitWords; ++k) sum.word_[k] = -sum.word_[k];
    sum.carry();
  }
  int top = kDigitWords - 1;
  while (top > 0 && sum.word_[top] == 0) --top;
  // Three words have all digits of a double; of what is below only whether there is anything
  // counts.
  Wide leading = 0;
  const int last = top >= 2 ? top - 2 : 0;
  for (int k = top; k >= last; --k)
    leading = (leading << kWordBits) | static_cast<std::uint64_t>(sum.word_[k]);
  for (int k = 0; k < last; ++k)
    if (sum.word_[k] != 0) leading |= 1;
  const double size = leading == 0 ? 0 : round_to_double(leading, kLowestPower + kWordBits * last);
  return negative ? -size : size;
}

}  // namespace acinus
