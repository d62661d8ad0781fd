#pragma once
/// Growth of the modulus of a sphere with its relative overlap d, so that spheres carry the loads
/// of deformable cells in dense tissue: E~ = E + a1 d^4   [VanLiedekerke2020, Eq. (22)]

#include <algorithm>
#include <cmath>
#include <vector>

namespace acinus::cbm {

/// Stiffness law E~(d) - E = sum a d^power, or a table. It holds up to `range`, continues along the
/// tangent (constant where that falls), and is constant from kLawCap ranges on: a law is known in
/// the range of its fit only, and beyond it must neither jump nor grow without limit.
struct StiffnessLaw {
  struct Term {
    double factor = 0;  ///< kPa
    double power = 4;   ///< > 1: a cell with small overlaps keeps its modulus
  };
  struct Knot {
    double overlap = 0, added = 0;  ///< d, and E~ - E there, kPa
  };
  std::vector<Term> term;
  /// Alternative to terms: linear between knots of rising d, constant before the first one.
  std::vector<Knot> table{};
  double range = 0.2;  ///< largest d of the fit, and of the table
  /// Recess of a crowded sphere at a rigid wall, over its radius: its surface ends by this much
  /// short of the radius. Deformable cells fill the space at a wall, spheres leave some of it free,
  /// see wall_face.
  double wall_recess = 0;
  /// True if d is the mean over the contacts of a cell, as in the words of [VanLiedekerke2020], not
  /// their sum over twelve.
  bool mean_of_contacts = false;
  /// True if a single neighbour with an overlap beyond the range of the law counts, see
  /// modulus_toward.
  bool single_overlaps = true;

  bool corrects() const { return !term.empty() || !table.empty(); }
};

/// Law of the paper, E~ = E + a1 d^4 with its a1 = 4e6 Pa. In loose tissue it makes spheres far too
/// stiff (decision 36).   [VanLiedekerke2020, Eq. (22), Table 1]
inline StiffnessLaw paper_law() {
  StiffnessLaw law;
  law.term.push_back({4e3, 4});
  law.mean_of_contacts = true;
  law.single_overlaps = false;
  return law;
}

/// Largest recess of a law.
inline constexpr double kLargestRecess = 0.5;

/// End of the growth of a law, over its range.
inline constexpr double kLawCap = 1.5;

/// Modulus and its derivative by d, kPa.
struct Modulus {
  double value = 0, slope = 0;
};

/// Increment of a table at d, and its slope; on the last knot that of the interval before it.
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

/// Modulus E~ of a cell of modulus `young` at the overlap d >= 0.
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

/// Relative overlap, over the range of the law, up to which the own overlap with a single neighbour
/// does not count. Daughters have more.
inline constexpr double kOwnOverlap = 1;

/// The same for a vessel or a mirror wall: deformable cells flow round a vessel and flatten at a
/// wall, by as much as twice the range at a few pascals (decision 48).
inline constexpr double kOwnObstacleOverlap = 2;

/// Modulus of one side of a contact.
struct FaceModulus : Modulus {
  bool own = false;  ///< true if set by the overlap of this contact alone, not by the crowd
};

/// Modulus E~ of a cell toward one neighbour. d is a mean over twelve and unsuitable where one
/// neighbour overlaps much more than all others, as daughters in dense tissue do: there the cell is
/// as stiff as if all overlapped as much, less the onset.
/// @param crowd    E~(d) and its slope
/// @param overlap  of this pair, over the sum of the radii
/// @param onset    overlap that does not count, over the range
/// @return with the slope by `overlap` if that counts, else `crowd`
inline FaceModulus modulus_toward(const StiffnessLaw& law, double young, const Modulus& crowd,
                                  double overlap, double onset = kOwnOverlap) {
  const double beyond = overlap - onset * law.range;
  if (!law.corrects() || !law.single_overlaps || beyond <= 0) return {crowd};
  const Modulus own = corrected_modulus(law, young, beyond);
  if (own.value > crowd.value) return {own, true};
  return {crowd};
}

/// Contact of a crowded sphere with a rigid wall: a flat face, closer and stiffer than a round cap.
struct WallFace {
  double recess = 0;   ///< recess of the face from the radius, over the radius
  double modulus = 0;  ///< kPa
  double slope = 1;    ///< of this modulus by E~
};

/// Wall face of a sphere of modulus E~ whose law starts at E: a cap while the modulus is E. The
/// increment of the law counts twice, with any recess. (decision 22)
inline WallFace wall_face(const StiffnessLaw& law, double young, double modulus) {
  const double stiffened = std::max(0.0, modulus - young);
  return {law.wall_recess * (stiffened / modulus) * (stiffened / modulus), modulus + stiffened,
          stiffened > 0 ? 2.0 : 1.0};
}

}  // namespace acinus::cbm
