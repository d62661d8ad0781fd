#pragma once
/// How the modulus of a sphere grows with its mean relative overlap d, so that spheres carry what
/// deformable cells carry in dense tissue: E~ = E + a1 d^4   [VanLiedekerke2020, Eq. (22)]

#include <cmath>
#include <vector>

namespace acinus::cbm {

/// E~(d) - E = sum a d^power up to `range`, on along the tangent from there (level where that
/// falls), and constant from kLawCap ranges on: a law is known where it was fitted only, and beyond
/// it must neither jump nor run away.
struct StiffnessLaw {
  struct Term {
    double factor = 0;  ///< kPa
    double power = 4;   ///< > 1: a cell that is hardly touched is as soft as ever
  };
  std::vector<Term> term;  ///< none: E~ = E
  double range = 0.2;      ///< largest d of the fit

  bool corrects() const { return !term.empty(); }
};

/// Where a law ends to grow, over its range.
inline constexpr double kLawCap = 1.5;

/// A modulus and its derivative by d, kPa.
struct Modulus {
  double value = 0, slope = 0;
};

/// E~ of a cell of modulus `young` at the mean overlap d >= 0.
inline Modulus corrected_modulus(const StiffnessLaw& law, double young, double d) {
  Modulus m{young, 0};
  const double within = d < law.range ? d : law.range;
  for (const StiffnessLaw::Term& t : law.term) {
    m.value += t.factor * std::pow(within, t.power);
    m.slope += t.factor * t.power * std::pow(within, t.power - 1);
  }
  const double end = kLawCap * law.range;
  if (d > law.range) {
    if (m.slope < 0) m.slope = 0;
    m.value += m.slope * ((d < end ? d : end) - law.range);
  }
  if (d >= end) m.slope = 0;
  return m;
}

}  // namespace acinus::cbm
