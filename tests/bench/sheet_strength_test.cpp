#include "bench/tissue/sheet_strength.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace acinus::bench {
namespace {

// A strength of 3 W^1.2 is a line of logarithms: exact between the points and beyond them.
TEST(SheetStrength, InvertsAPowerOfTheAdhesion) {
  const auto law = [](double w) { return 3 * std::pow(w, 1.2); };
  StrengthCurve c;
  for (const double w : {0.003, 0.01, 0.05}) {
    c.adhesion.push_back(w);
    c.strength.push_back(law(w));
  }
  for (const double w : {0.001, 0.003, 0.0042, 0.01, 0.033, 0.05, 0.08})
    EXPECT_NEAR(adhesion_of(c, law(w)), w, 1e-13) << w;
}

}  // namespace
}  // namespace acinus::bench
