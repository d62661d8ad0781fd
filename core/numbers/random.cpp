#include "core/numbers/random.hpp"

#include <Random123/philox.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace acinus {

namespace {

using Words = std::array<std::uint64_t, 4>;

Words philox(std::uint64_t seed, Purpose purpose, const r123::Philox4x64::ctr_type& counter) {
  const r123::Philox4x64::key_type key = {{seed, static_cast<std::uint32_t>(purpose)}};
  const auto out = r123::Philox4x64()(counter, key);
  return {out[0], out[1], out[2], out[3]};
}

// 52 bits: with 53 the half added to the largest integer would round up to exactly 1.
double to_open_interval(std::uint64_t word) {
  return (static_cast<double>(word >> 12) + 0.5) * 0x1p-52;
}

std::array<double, 2> box_muller(std::uint64_t word_a, std::uint64_t word_b) {
  const double length = std::sqrt(-2.0 * portable::log(to_open_interval(word_a)));
  const auto [sine, cosine] = portable::sin_cos_turns(to_open_interval(word_b));
  return {length * cosine, length * sine};
}

Vec3 to_unit_vector(std::uint64_t word_a, std::uint64_t word_b) {
  const double z = 2.0 * to_open_interval(word_a) - 1.0;
  const double across = std::sqrt((1.0 - z) * (1.0 + z));
  const auto [sine, cosine] = portable::sin_cos_turns(to_open_interval(word_b));
  return {across * cosine, across * sine, z};
}

}  // namespace

std::array<std::uint64_t, 4> random_words(const RandomKey& key, std::uint32_t retry) {
  const std::uint64_t which = key.draw | static_cast<std::uint64_t>(retry) << 32;
  return philox(key.seed, key.purpose, {{key.id, key.interval, which, 0}});
}

double uniform(const RandomKey& key) { return to_open_interval(random_words(key)[0]); }

double normal(const RandomKey& key) {
  const Words words = random_words(key);
  return box_muller(words[0], words[1])[0];
}

Vec3 normal3(const RandomKey& key) {
  const Words words = random_words(key);
  const auto [x, y] = box_muller(words[0], words[1]);
  return {x, y, box_muller(words[2], words[3])[0]};
}

double truncated_normal(const RandomKey& key, double mean, double sd, double n_sigma) {
  if (!(sd >= 0.0))
    check(false, "truncated normal: sd must not be negative, found " + std::to_string(sd));
  if (!(n_sigma > 0.0)) {
    check(false, "truncated normal: n_sigma must be positive, found " + std::to_string(n_sigma));
  }
  for (std::uint32_t retry = 0;; ++retry) {
    const Words words = random_words(key, retry);
    if (n_sigma >= 1.0) {
      const double z = box_muller(words[0], words[1])[0];
      if (std::abs(z) <= n_sigma) return mean + sd * z;
    } else {
      // A narrow window would reject nearly every normal: propose inside it, accept by exp(-z^2/2)
      // > u.
      const double z = n_sigma * (2.0 * to_open_interval(words[0]) - 1.0);
      if (z * z < -2.0 * portable::log(to_open_interval(words[1]))) return mean + sd * z;
    }
  }
}

Vec3 unit_vector(const RandomKey& key) {
  const Words words = random_words(key);
  return to_unit_vector(words[0], words[1]);
}

UniformStream::UniformStream(std::uint64_t seed, Purpose purpose, std::uint64_t id)
    : seed_(seed), id_(id), purpose_(purpose) {}

std::uint64_t UniformStream::bits() {
  if (used_ == 4) {
    block_ = philox(seed_, purpose_, {{id_, next_block_, 0, 1}});
    ++next_block_;
    used_ = 0;
  }
  return block_[used_++];
}

double UniformStream::uniform() { return to_open_interval(bits()); }

double UniformStream::uniform(double low, double high) { return low + (high - low) * uniform(); }

double UniformStream::normal() {
  const std::uint64_t word_a = bits();
  return box_muller(word_a, bits())[0];
}

Vec3 UniformStream::unit_vector() {
  const std::uint64_t word_a = bits();
  return to_unit_vector(word_a, bits());
}

std::uint64_t UniformStream::index(std::uint64_t count) {
  ACINUS_ASSERT(count > 0);
  // The first 2^64 mod count words would favour small indices: they are drawn again.
  const std::uint64_t surplus = (0 - count) % count;
  for (;;) {
    const std::uint64_t word = bits();
    if (word >= surplus) return word % count;
  }
}

namespace portable {

double log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);
  if (mantissa < std::numbers::sqrt2 / 2) {
    mantissa *= 2.0;
    --exponent;
  }
  // log m = 2 atanh s with s = (m - 1)/(m + 1), |s| < 0.172: the first dropped term is below 1e-18.
  const double s = (mantissa - 1.0) / (mantissa + 1.0);
  const double z = s * s;
  double series = 0.0;
  for (int odd = 23; odd >= 3; odd -= 2) series = (series + 1.0 / odd) * z;
  return exponent * std::numbers::ln2 + (2.0 * s + 2.0 * s * series);
}

std::array<double, 2> sin_cos_turns(double turns) {
  const int quarter = static_cast<int>(4.0 * turns + 0.5);
  const double angle =
      2.0 * kPi * (turns - 0.25 * quarter);  // within +-pi/4; the difference is exact
  const double z = angle * angle;
  double sine = 1.0, cosine = 1.0;
  for (int n = 18; n >= 2; n -= 2) {
    sine = 1.0 - sine * z / (n * (n + 1));
    cosine = 1.0 - cosine * z / (n * (n - 1));
  }
  sine *= angle;
  switch (quarter % 4) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace portable
}  // namespace acinus
