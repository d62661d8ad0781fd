#pragma once
/// Random numbers without state: every number is a pure function of its address (cell, purpose,
/// time interval, draw), so a rejected step, a restart or another number of threads and ranks draws
/// the same numbers again.
///
/// Generator: Philox4x64-10 [Salmon2011], a bijection of a 256 bit counter for each 128 bit key.
/// The address is packed, never hashed: different addresses are different inputs, and under one key
/// their blocks differ for certain.
///     key     = { seed,  purpose }
///     counter = { id,  interval,  draw | retry << 32,  0 for addresses, 1 for streams }
/// One block is 4 words of 64 bit. `retry` belongs to the rejection loop of truncated_normal alone.
///
/// Normal numbers use Box-Muller [Box1958] with a logarithm, sine and cosine made here of + - * /
/// and sqrt: IEEE 754 fixes those to the last bit, while libm differs between versions and even
/// between processors. The build must not contract to fused multiply-add (cmake/flags.cmake forbids
/// it).

#include <array>
#include <cstdint>

#include "core/vec.hpp"

namespace acinus {

/// Purpose of a random number, part of its address. Stored values: append only, never renumber, or
/// saved runs change their course.
enum class Purpose : std::uint32_t {
  kTest = 0,
  kMotility = 1,
  kYoungModulus = 2,
  kPlacement = 3,
  kNetwork = 4,
  kJitter = 5,
  kDivisionAxis = 6,
  kCycleTime = 7,
  kDeath = 8,
  kSampling = 9,
  kLifeRule = 10,
  kProliferation = 11,
  kSharing = 12,
  kImage = 13,
  kSignalDeath = 14,
  kInference = 15,
};

/// Address of one block of random words.
struct RandomKey {
  std::uint64_t seed = 0;
  Purpose purpose = Purpose::kTest;
  std::uint64_t id = 0;        ///< lineage id of the cell, or index of the placed object
  std::uint64_t interval = 0;  ///< index on the fixed time grid, not of a step: steps are retried
  std::uint32_t draw = 0;      ///< number of the draw within this id and interval
};

/// Block of 4 random words at an address. All functions below read the same block: one address, one
/// use.
std::array<std::uint64_t, 4> random_words(const RandomKey& key, std::uint32_t retry = 0);

/// Uniform on the open interval (0, 1): (k + 1/2) 2^-52, k = 0 .. 2^52 - 1; 0 and 1 never occur.
double uniform(const RandomKey& key);

/// Standard normal; |value| <= 8.58 by the width of the uniform numbers.
double normal(const RandomKey& key);

/// Three independent standard normals from one block.
Vec3 normal3(const RandomKey& key);

/// Normal(mean, sd) conditioned on |x - mean| <= n_sigma sd, by rejection (at least 0.6 of tries
/// accepted).
/// @param n_sigma  may be infinite (no truncation)
/// Throws Error if sd < 0 or n_sigma <= 0.
double truncated_normal(const RandomKey& key, double mean, double sd, double n_sigma);

/// Direction with uniform density on the unit sphere.
Vec3 unit_vector(const RandomKey& key);

/// Sequential numbers for set-up work where order is natural (placement, networks). Disjoint from
/// every RandomKey and from streams of other (seed, purpose, id).
class UniformStream {
 public:
  UniformStream(std::uint64_t seed, Purpose purpose, std::uint64_t id);
  std::uint64_t bits();
  double uniform();                         ///< open interval (0, 1)
  double uniform(double low, double high);  ///< between low and high
  double normal();                          ///< standard normal, uses two words
  Vec3 unit_vector();
  /// Unbiased integer in [0, count). @pre count > 0
  std::uint64_t index(std::uint64_t count);

 private:
  std::uint64_t seed_, id_, next_block_ = 0;
  Purpose purpose_;
  std::array<std::uint64_t, 4> block_{};
  int used_ = 4;
};

/// Elementary functions behind the normal numbers, with the same bits on every IEEE 754 machine.
namespace portable {

/// Natural logarithm of a positive normal number, within 2 ulp for x <= 1.
double log(double x);

/// {sin, cos} of 2 pi turns for 0 <= turns <= 1, absolute error below 2e-16.
std::array<double, 2> sin_cos_turns(double turns);

}  // namespace portable
}  // namespace acinus
