#include "core/numbers/exact_sum.hpp"

#include <gtest/gtest.h>
#include <mpfr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace acinus {
namespace {

double exact(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double t : terms) sum.add(t);
  return sum.value();
}

/// With more digits than any sum of doubles has, rounded once.
double reference(const std::vector<double>& terms) {
  constexpr int kBits = 2400;
  mpfr_t sum;
  mpfr_init2(sum, kBits);
  mpfr_set_zero(sum, 1);
  for (const double t : terms) mpfr_add_d(sum, sum, t, MPFR_RNDN);
  const double value = mpfr_get_d(sum, MPFR_RNDN);
  mpfr_clear(sum);
  return value;
}

/// Random terms of all sizes of a double, subnormal ones included.
std::vector<double> any_sizes(std::mt19937_64& random, int n, int lowest, int highest) {
  std::uniform_int_distribution<int> power(lowest, highest);
  std::uniform_real_distribution<double> digits(-1, 1);
  std::vector<double> terms;
  for (int k = 0; k < n; ++k) terms.push_back(std::ldexp(digits(random), power(random)));
  return terms;
}

TEST(ExactSum, IsTheSumRoundedOnce) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const int low = -1080 + static_cast<int>(random() % 2000),
              high = std::min(1010, low + 1 + static_cast<int>(random() % 300));
    std::vector<double> terms = any_sizes(random, 1 + static_cast<int>(random() % 40), low, high);
    // Terms that cancel leave what is small.
    if (trial % 3 == 0)
      for (std::size_t k = terms.size() / 2; k-- > 0;) terms.push_back(-terms[k]);
    EXPECT_EQ(exact(terms), reference(terms));
  }
}

TEST(ExactSum, HasTheSameBitsInAnyOrderAndAnyParts) {
  std::mt19937_64 random(2);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<double> terms = any_sizes(random, 3000, -200, 200);
    const auto bits = std::bit_cast<std::uint64_t>(exact(terms));
    std::ranges::shuffle(terms, random);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(exact(terms)), bits);
    std::vector<ExactSum> part(7);
    for (const double t : terms) part[random() % part.size()].add(t);
    ExactSum whole, by_words;
    for (ExactSum& p : part) {
      whole.add(p);
      const auto words = by_words.words();
      const auto more = p.words();
      for (std::size_t k = 0; k < words.size(); ++k) words[k] += more[k];
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(whole.value()), bits);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(by_words.value()), bits);
  }
}

TEST(ExactSum, LosesNothingOfWhatCancels) {
  EXPECT_EQ(exact({1e300, 1, -1e300}), 1);
  EXPECT_EQ(exact({1e300, 5e-324, -1e300}), 5e-324);
  EXPECT_EQ(exact({}), 0);
  EXPECT_EQ(exact({0.1, -0.1}), 0);
}

TEST(ExactSum, RoundsToEvenInTheMiddle) {
  const double half = std::ldexp(1.0, -53);
  EXPECT_EQ(exact({1, half}), 1);
  EXPECT_EQ(exact({1, half, 5e-324}), 1 + 2 * half);
  EXPECT_EQ(exact({1 + 2 * half, half}), 1 + 4 * half);
  EXPECT_EQ(exact({-1, -half}), -1);
}

TEST(ExactSum, HoldsManyTermsOfOneSign) {
  ExactSum sum;
  const double most = std::numeric_limits<double>::max();
  for (int k = 0; k < 100000; ++k) sum.add(1.0 - std::ldexp(1.0, -53));
  EXPECT_EQ(sum.value(), 100000 - 100000 * std::ldexp(1.0, -53));
  for (int k = 0; k < 5000; ++k) sum.add(most);
  EXPECT_TRUE(std::isinf(sum.value()));
  for (int k = 0; k < 4999; ++k) sum.add(-most);
  EXPECT_EQ(sum.value(), most);  // what was beyond came back
}

TEST(ExactSum, TellsWhatIsNotFinite) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(exact({1, infinite}), infinite);
  EXPECT_TRUE(std::isnan(exact({infinite, -infinite})));
  EXPECT_TRUE(std::isnan(exact({1, std::nan("")})));
}

}  // namespace
}  // namespace acinus
