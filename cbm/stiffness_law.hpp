#pragma once
/// How the modulus of a sphere grows with its relative overlap d, so that spheres carry what
/// deformable cells carry in dense tissue: E~ = E + a1 d^4   [VanLiedekerke2020, Eq. (22)]

#include <algorithm>
#include <cmath>
#include <vector>

namespace acinus::cbm {

/// E~(d) - E = sum a d^power, or a table, up to `range`, on along the tangent from there (level
/// where that falls), and constant from kLawCap ranges on: a law is known where it was fitted only,
/// and beyond it must neither jump nor run away.
struct StiffnessLaw {
  struct Term {
    double factor = 0;  ///< kPa
    double power = 4;   ///< > 1: a cell that is hardly touched is as soft as ever
  };
  struct Knot {
    double overlap = 0, added = 0;  ///< d, and E~ - E there, kPa
  };
  std::vector<Term> term;
  /// In place of terms: linear between knots of rising d, level before the first one.
  std::vector<Knot> table{};
  double range = 0.2;  ///< largest d of the fit, and of the table
  /// By how much less than its radius a crowded sphere reaches to a rigid wall, over its radius:
  /// deformable cells fill the room at a wall, spheres leave some of it free, see wall_face.
  double wall_recess = 0;
  /// d is the mean over the contacts of a cell, as [VanLiedekerke2020] words it, not their sum over
  /// twelve.
  bool mean_of_contacts = false;
  /// A single neighbour pressed in deeper than the law was fitted for counts, see modulus_toward.
  bool single_overlaps = true;

  bool corrects() const { return !term.empty() || !table.empty(); }
};

/// E~ = E + a1 d^4 in the paper's own words and with its a1 = 4e6 Pa. In loose tissue spheres
/// become far too stiff by it (docs/decisions/0036.md).   [VanLiedekerke2020, Eq. (22), Table 1]
inline StiffnessLaw paper_law() {
  StiffnessLaw law;
  law.term.push_back({4e3, 4});
  law.mean_of_contacts = true;
  law.single_overlaps = false;
  return law;
}

/// Largest recess of a law.
inline constexpr double kLargestRecess = 0.5;

/// Where a law ends to grow, over its range.
inline constexpr double kLawCap = 1.5;

/// A modulus and its derivative by d, kPa.
struct Modulus {
  double value = 0, slope = 0;
};

/// What a table adds at d, and its slope there; on the last knot that of the stretch before it.
inline Modulus look_up(const std::vector<StiffnessLaw::Knot>& table, double d) {
  if (d <= table.front().overlap) return {table.front().added, 0};
  auto after = std::lower_bound(
      table.begin(), table.end(), d,
      [](const StiffnessLaw::Knot& k, double overlap) { return k.overlap < overlap; });
  if (after == table.end()) --after;
  const auto before = after - 1;
  const double slope = (after->added - before->added) / (after->overlap - before->overlap);
  return {before->added + slope * (d - before->overlap), slope};
}

/// E~ of a cell of modulus `young` at the overlap d >= 0.
inline Modulus corrected_modulus(const StiffnessLaw& law, double young, double d) {
  Modulus m{young, 0};
  const double within = d < law.range ? d : law.range;
  for (const StiffnessLaw::Term& t : law.term) {
    m.value += t.factor * std::pow(within, t.power);
    m.slope += t.factor * t.power * std::pow(within, t.power - 1);
  }
  if (!law.table.empty()) {
    const Modulus added = look_up(law.table, within);
    m.value += added.value;
    m.slope += added.slope;
  }
  const double end = kLawCap * law.range;
  if (d > law.range) {
    if (m.slope < 0) m.slope = 0;
    m.value += m.slope * ((d < end ? d : end) - law.range);
  }
  if (d >= end) m.slope = 0;
  return m;
}

/// Relative overlap, over the range of the law, that a single neighbour may have before its own
/// overlap counts: in the clump a law was found in none had more when all had that on average.
inline constexpr double kOwnOverlap = 1;

/// Modulus of one side of a contact.
struct FaceModulus : Modulus {
  bool own = false;  ///< set by the overlap of this contact alone, not by the crowd
};

/// E~ of a cell toward one neighbour. d is a mean over twelve and says little where one neighbour
/// is pressed in much deeper than all others, as daughters in dense tissue are: there the cell is
/// as stiff as if all overlapped as much, less the range of the law.
/// @param crowd    E~(d) and its slope
/// @param overlap  of this pair, over the sum of the radii
/// @return with the slope by `overlap` if that counts, else `crowd`
inline FaceModulus modulus_toward(const StiffnessLaw& law, double young, const Modulus& crowd,
                                  double overlap) {
  const double beyond = overlap - kOwnOverlap * law.range;
  if (!law.corrects() || !law.single_overlaps || beyond <= 0) return {crowd};
  const Modulus own = corrected_modulus(law, young, beyond);
  if (own.value > crowd.value) return {own, true};
  return {crowd};
}

/// How a crowded sphere meets a rigid wall: with a face, so nearer and stiffer than a round cap.
struct WallFace {
  double recess = 0;   ///< over its radius: how much later than at its radius
  double modulus = 0;  ///< kPa
  double slope = 1;    ///< of this modulus by E~
};

/// Of a sphere of modulus E~ whose law starts at E: a cap while it is as soft as that. What the law
/// adds counts twice, with any recess. (docs/decisions/0022.md)
inline WallFace wall_face(const StiffnessLaw& law, double young, double modulus) {
  const double stiffened = std::max(0.0, modulus - young);
  return {law.wall_recess * (stiffened / modulus) * (stiffened / modulus), modulus + stiffened,
          stiffened > 0 ? 2.0 : 1.0};
}

}  // namespace acinus::cbm
