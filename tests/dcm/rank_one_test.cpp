#include "dcm/terms/rank_one.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/reference/sample.hpp"

namespace acinus::dcm {
namespace {

constexpr int kNode = 162;

/// Random numbers that add up to zero, of very different sizes.
std::vector<double> make_gradient() {
  auto random = reference::stream(77);
  std::vector<double> g(kNode * kPointStride);
  for (std::size_t c = 0; c < kPointStride; ++c) {
    const double size = std::pow(10.0, random.uniform(-12, 6));
    double sum = 0;
    for (std::size_t k = c; k < g.size(); k += kPointStride)
      sum += g[k] = random.uniform(-size, size);
    for (std::size_t k = c; k < g.size(); k += kPointStride) g[k] -= sum / kNode;
  }
  return g;
}

// Not to rounding, but exactly: every sum of the floats is exact in double.
TEST(RoundedGradient, AddsUpToZero) {
  const std::vector<double> g = make_gradient();
  std::vector<float> rounded(g.size());
  round_gradient(kNode, g.data(), rounded.data());
  for (std::size_t c = 0; c < kPointStride; ++c) {
    double sum = 0, most = 0, worst = 0;
    for (std::size_t k = c; k < g.size(); k += kPointStride) {
      const auto kept = static_cast<double>(rounded[k]);
      sum += kept;
      most = std::max(most, std::abs(g[k]));
      worst = std::max(worst, std::abs(kept - g[k]));
    }
    EXPECT_EQ(sum, 0) << c;
    EXPECT_LE(worst, most * 0x1p-23) << c;
    EXPECT_GT(worst, 0) << "else nothing was rounded";
  }
}

TEST(RoundedGradient, OfNothingIsZero) {
  const std::vector<double> g(kNode * kPointStride);
  std::vector<float> rounded(g.size(), 1.0f);
  round_gradient(kNode, g.data(), rounded.data());
  for (const float x : rounded) ASSERT_EQ(x, 0);
}

}  // namespace
}  // namespace acinus::dcm
