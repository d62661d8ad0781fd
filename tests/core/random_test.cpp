#include "core/numbers/random.hpp"

#include <Random123/philox.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <vector>

#include "core/error.hpp"

namespace acinus {
namespace {

using Words = std::array<std::uint64_t, 4>;

TEST(Random, KnownAnswersOfTheGenerator) {
  const auto narrow = r123::Philox4x32()({{0, 0, 0, 0}}, {{0, 0}});
  EXPECT_EQ(narrow[0], 0x6627e8d5u);
  EXPECT_EQ(narrow[1], 0xe169c58du);
  EXPECT_EQ(narrow[2], 0xbc57ac4cu);
  EXPECT_EQ(narrow[3], 0x9b00dbd8u);
  const auto wide = r123::Philox4x64()({{0, 0, 0, 0}}, {{0, 0}});
  EXPECT_EQ(wide[0], 0x16554d9eca36314cu);
  EXPECT_EQ(wide[1], 0xdb20fe9d672d0fdcu);
  EXPECT_EQ(wide[2], 0xd7e772cee186176bu);
  EXPECT_EQ(wide[3], 0x7e68b68aec7ba23bu);
}

// Computed by a separate program from the packing stated in the header.
TEST(Random, AddressIsPackedAsDocumented) {
  const RandomKey key = {0xdeadbeefcafef00du, Purpose::kNetwork, 0x1122334455667788u,
                         0x99aabbccddeeff00u, 0x01020304u};
  EXPECT_EQ(random_words(key, 5), (Words{0x67547fb0e54c7cbau, 0x7c0fd5e3d6b25531u,
                                         0x785596613506d176u, 0x57a8292e6dbe0578u}));
  UniformStream stream(42, Purpose::kPlacement, 77);
  for (const std::uint64_t word :
       {0x931f4973f73a8652u, 0xb3b9005fc089d19au, 0xb839e20b029ef2d0u, 0xd9866111c5fb13bfu,
        0x34d0573f37b9b43bu, 0x763df6cee5273164u, 0xe1acb5b95ce9ec1au, 0xec1f0569ff0fd80fu}) {
    EXPECT_EQ(stream.bits(), word);
  }
}

TEST(Random, SameAddressSameNumberInAnyOrder) {
  const RandomKey a = {1, Purpose::kMotility, 7, 100, 0}, b = {1, Purpose::kMotility, 8, 100, 0};
  const double first = uniform(a);
  const Vec3 vector = normal3(b);
  EXPECT_EQ(normal3(b), vector);
  EXPECT_EQ(uniform(a), first);
}

// Addresses that differ in one field by little, including the bits where fields could run into each
// other.
TEST(Random, NoTwoAddressesShareABlock) {
  std::set<Words> seen;
  int count = 0;
  const std::array<std::uint64_t, 6> values = {0, 1, 2, 0xffffffffu, 0x100000000u, ~0ull};
  for (const std::uint64_t seed : values) {
    for (const std::uint64_t id : values) {
      for (const std::uint64_t interval : values) {
        for (const std::uint32_t draw : {0u, 1u, 0xffffffffu}) {
          for (const std::uint32_t retry : {0u, 1u}) {
            for (const Purpose purpose : {Purpose::kTest, Purpose::kMotility, Purpose::kJitter}) {
              seen.insert(random_words({seed, purpose, id, interval, draw}, retry));
              ++count;
            }
          }
        }
      }
    }
  }
  for (std::uint64_t id = 0; id < 100; ++id) {
    UniformStream stream(0, Purpose::kTest, id);
    for (int block = 0; block < 4; ++block) {
      Words words;
      for (auto& word : words) word = stream.bits();
      seen.insert(words);
      ++count;
    }
  }
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(count));
}

// 5 standard errors: a right generator fails once in 1.7 million, and the seed is fixed.
TEST(Random, UniformMomentsAndLevels) {
  constexpr int kCount = 1'000'000;
  double sum = 0.0, squares = 0.0, low = 1.0, high = 0.0;
  std::vector<int> bins(100);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double x = uniform({3, Purpose::kTest, i % 1000, i / 1000, 0});
    sum += x;
    squares += (x - 0.5) * (x - 0.5);
    low = std::min(low, x);
    high = std::max(high, x);
    ++bins[100.0 * x];
  }
  double chi2 = 0.0;
  for (const int bin : bins) chi2 += (bin - 1e4) * (bin - 1e4) / 1e4;
  std::printf("uniform: mean %.5f, variance*12 %.5f, chi2(99) %.1f\n", sum / kCount,
              12 * squares / kCount, chi2);
  EXPECT_NEAR(sum / kCount, 0.5, 5 * std::sqrt(1.0 / 12 / kCount));
  EXPECT_NEAR(squares / kCount, 1.0 / 12, 5 * std::sqrt(1.0 / 180 / kCount));
  EXPECT_NEAR(chi2, 99.0, 5 * std::sqrt(2.0 * 99));
  EXPECT_GT(low, 0.0);
  EXPECT_LT(high, 1.0);
}

TEST(Random, NormalMomentsAndDistribution) {
  constexpr int kCount = 300'000;
  std::array<double, 4> moment{};
  Mat3 covariance = Mat3::Zero();
  std::vector<double> all;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const Vec3 x = normal3({4, Purpose::kMotility, 17, i, 0});
    covariance += x * x.transpose() / kCount;
    all.push_back(x[2]);
    double power = 1.0;
    for (auto& m : moment) m += (power *= x[0]) / kCount;
  }
  std::printf("normal: moments %.4f %.4f %.4f %.4f\n", moment[0], moment[1], moment[2], moment[3]);
  const double n = kCount;
  EXPECT_NEAR(moment[0], 0.0, 5 / std::sqrt(n));
  EXPECT_NEAR(moment[1], 1.0, 5 * std::sqrt(2 / n));
  EXPECT_NEAR(moment[2], 0.0, 5 * std::sqrt(15 / n));
  EXPECT_NEAR(moment[3], 3.0, 5 * std::sqrt(96 / n));
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < i; ++j) EXPECT_NEAR(covariance(i, j), 0.0, 5 / std::sqrt(n));
    EXPECT_NEAR(covariance(i, i), 1.0, 5 * std::sqrt(2 / n));
  }
  // Kolmogorov-Smirnov: sqrt(n) D above 2.2 has probability 1e-4.
  std::sort(all.begin(), all.end());
  double distance = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double expected = 0.5 * std::erfc(-all[i] / std::sqrt(2.0));
    distance = std::max({distance, std::abs(expected - static_cast<double>(i) / n),
                         std::abs(expected - static_cast<double>(i + 1) / n)});
  }
  std::printf("normal: Kolmogorov-Smirnov %.3f\n", std::sqrt(n) * distance);
  EXPECT_LT(std::sqrt(n) * distance, 2.2);
}

// Neighbouring addresses, each field in turn: correlation of the numbers within 5/sqrt(n).
TEST(Random, NeighbouringKeysAreUncorrelated) {
  constexpr std::uint32_t kCount = 50'000;
  const auto key = [](std::uint64_t i) { return RandomKey{5, Purpose::kMotility, 2 * i, 11, 0}; };
  std::array<double, 5> correlation{};
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const double base = normal(key(i));
    std::array<RandomKey, 5> near;
    near.fill(key(i));
    near[0].seed += 1;
    near[1].purpose = Purpose::kYoungModulus;
    near[2].id += 1;
    near[3].interval += 1;
    near[4].draw += 1;
    for (std::size_t field = 0; field < near.size(); ++field) {
      correlation[field] += base * normal(near[field]) / kCount;
    }
  }
  for (const double c : correlation)
    EXPECT_NEAR(c, 0.0, 5 / std::sqrt(static_cast<double>(kCount)));
}

TEST(Random, TruncatedNormalStaysInsideWithTheRightSpread) {
  constexpr std::uint32_t kCount = 200'000;
  for (const double n_sigma : {0.2, 0.99, 1.0, 2.0, 3.0}) {
    double sum = 0.0, squares = 0.0, largest = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
      const double x =
          truncated_normal({6, Purpose::kYoungModulus, i, 0, 0}, 450.0, 45.0, n_sigma) - 450.0;
      sum += x / 45.0;
      squares += x * x / (45.0 * 45.0);
      largest = std::max(largest, std::abs(x));
    }
    const double density = std::exp(-0.5 * n_sigma * n_sigma) / std::sqrt(2 * kPi);
    const double variance = 1.0 - 2.0 * n_sigma * density / std::erf(n_sigma / std::sqrt(2.0));
    EXPECT_LE(largest, 45.0 * n_sigma * (1 + 1e-12));
    EXPECT_NEAR(sum / kCount, 0.0, 5 * std::sqrt(variance / kCount));
    EXPECT_NEAR(squares / kCount, variance, 5 * n_sigma * std::sqrt(variance / kCount)) << n_sigma;
  }
  const RandomKey key = {9, Purpose::kYoungModulus, 1, 0, 0};
  EXPECT_EQ(truncated_normal(key, 1.0, 1.0, std::numeric_limits<double>::infinity()),
            1.0 + normal(key));
  EXPECT_EQ(truncated_normal(key, 7.0, 0.0, 2.0), 7.0);
  EXPECT_THROW(truncated_normal(key, 1.0, -1.0, 2.0), Error);
  EXPECT_THROW(truncated_normal(key, 1.0, 1.0, 0.0), Error);
}

TEST(Random, UnitVectorsFillTheSphere) {
  constexpr std::uint32_t kCount = 100'000;
  Vec3 mean = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const Vec3 u = unit_vector({7, Purpose::kDivisionAxis, i, 0, 0});
    ASSERT_NEAR(u.norm(), 1.0, 1e-15 * 4);
    mean += u / kCount;
    second += u * u.transpose() / kCount;
  }
  EXPECT_LT(mean.norm(), 5 / std::sqrt(1.0 * kCount));
  EXPECT_LT((second - Mat3::Identity() / 3).norm(), 5 / std::sqrt(1.0 * kCount));
}

TEST(UniformStream, IntegersAndIntervals) {
  UniformStream stream(8, Purpose::kPlacement, 0);
  std::array<int, 7> hits{};
  for (int i = 0; i < 70'000; ++i) ++hits[stream.index(7)];
  for (const int hit : hits) EXPECT_NEAR(hit, 10'000, 5 * std::sqrt(10'000.0));
  EXPECT_EQ(stream.index(1), 0u);
  for (int i = 0; i < 1000; ++i) {
    const double x = stream.uniform(-3.0, 5.0);
    EXPECT_TRUE(x >= -3.0 && x <= 5.0);
  }
  EXPECT_NEAR(stream.unit_vector().norm(), 1.0, 1e-14);
  UniformStream again(8, Purpose::kPlacement, 0), other(8, Purpose::kPlacement, 1);
  EXPECT_NE(again.uniform(), other.uniform());
}

// The library functions are right to about 1 ulp; ours add 2.
TEST(Portable, ElementaryFunctionsAreAccurate) {
  double worst_log = 0.0, worst_circle = 0.0;
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    const double u = uniform({10, Purpose::kTest, i, 0, 0});
    for (const double x : {u, u * u * u * u * u * u, 1.0 - 1e-9 * u}) {
      worst_log = std::max(worst_log, std::abs(portable::log(x) / std::log(x) - 1.0));
    }
    const auto [sine, cosine] = portable::sin_cos_turns(u);
    const auto angle = 2.0L * 3.141592653589793238462643L * static_cast<long double>(u);
    worst_circle = std::max(worst_circle, static_cast<double>(std::abs(sine - std::sin(angle))));
    worst_circle = std::max(worst_circle, static_cast<double>(std::abs(cosine - std::cos(angle))));
  }
  std::printf("portable: log %.1e relative, sin and cos %.1e\n", worst_log, worst_circle);
  EXPECT_LT(worst_log, 7e-16);
  EXPECT_LT(worst_circle, 2.5e-16);
  EXPECT_LT(std::abs(portable::log(0x1p-53) / std::log(0x1p-53) - 1.0), 4e-16);
}

// Same bits on every machine, compiler level and instruction set. The first two triples agree with
// a separate program that uses the library's log, sin and cos to the last one or two bits.
TEST(Random, NormalNumbersAreGolden) {
  const auto key = [](std::uint64_t id) { return RandomKey{20, Purpose::kMotility, id, 42, 0}; };
  EXPECT_EQ(normal3(key(0)),
            Vec3(-0x1.90cf79b096c28p+0, 0x1.36afacab28616p-1, -0x1.7cb2b056e6171p+0));
  EXPECT_EQ(normal3(key(1)),
            Vec3(0x1.85de015bc1599p-1, 0x1.ea674ddc9b656p-1, 0x1.0e6b8626ace57p+0));
  EXPECT_EQ(truncated_normal(key(123456789), 450.0, 45.0, 2.0), 0x1.c5aedb347621p+8);
  std::uint64_t hash = 0;
  for (std::uint32_t i = 0; i < 1'000'000; ++i) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(normal({1, Purpose::kTest, i, 0, 0}))) *
           0x100000001b3u;
  }
  EXPECT_EQ(hash, 0x3fb2609f3459a44fu);
}

}  // namespace
}  // namespace acinus
