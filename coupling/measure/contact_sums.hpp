#pragma once
/// Sums of contacts per pair: of two cells, or of a cell with one part of the boundary.

#include <compare>
#include <cstddef>
#include <map>
#include <vector>

#include "coupling/measure/contact_forces.hpp"

namespace acinus::coupling {

/// Contact of a cell with another, a < b, or with a part of the boundary. Cells are numbered in the
/// order of measure_cells.
struct CellContact {
  std::size_t a = 0;
  std::size_t b = kNoCell;  ///< kNoCell: boundary
  /// Kind of b: kSurface, kSphere, or that of the boundary.
  contact::Partner partner = contact::Partner::kPlane;
  int index = 0;              ///< of the boundary, within its kind
  bool touching = false;      ///< true for two cells that exert a force on each other
  Vec3 force = Vec3::Zero();  ///< nN, on a; the opposite on its partner
  /// nN, positive in compression: along the line of centres, or along the normals of the contacts
  /// with boundary.
  double normal_force = 0;
  /// um^2 of the surface of either side in contact; b: 0 for boundary. Those of a cell add up to
  /// its contact_area, of a sphere at most to its whole surface.
  double area_a = 0, area_b = 0;
};

/// Sums of contacts per pair, those with boundary first, then by a, b, kind and index. Folds of one
/// cell are left out, as are fading forces with boundary, whose part is unknown.
class ContactSums {
 public:
  /// Adds the force of a contact.
  void add(const ContactForce& contact);
  /// Adds the areas of a contact of the sides that it names a and b.
  void add_areas(const ContactForce& contact, double area_a, double area_b);
  /// Pairs with normal forces.
  /// @param center        of all cells, um
  /// @param n_deformable  number of those, which come first
  std::vector<CellContact> list(const std::vector<Vec3>& center, std::size_t n_deformable) const;

 private:
  struct PartKey {
    bool pair;
    std::size_t a, b;
    contact::Partner partner;
    int index;
    auto operator<=>(const PartKey&) const = default;
  };
  CellContact& sum_of(const ContactForce& contact);
  std::map<PartKey, CellContact> sum_;
};

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::CellContact> = true;
}  // namespace acinus
