#pragma once
/// Sums of contacts per pair: of two cells, or of a cell with one part of the boundary.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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

/// Areas of a contact of the sides that it names a and b, um^2.
using AreasOfContact = std::function<std::array<double, 2>(const ContactForce&)>;

/// Sums of contacts per pair, those with boundary first, then by a, b, kind and index. Folds of one
/// cell are left out, as are fading forces with boundary, whose part is unknown. Contacts are
/// visited twice, so that nothing is kept of a single one.
/// @param areas  empty: areas stay 0   @pre observe
std::vector<CellContact> sum_contacts(const World& world, const Workspace& work,
                                      const AreasOfContact& areas = {});

/// Two cells, a < b, by their numbers.
using CellPair = std::array<std::uint32_t, 2>;

/// Pairs of cells that exert a force on each other, ascending, over all processes.   @pre observe
std::vector<CellPair> find_touching(const World& world, const Workspace& work);

/// Number of cells in the contact cluster of each cell, itself included.
std::vector<int> cluster_sizes(std::size_t n_cell, const std::vector<CellPair>& touching);

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::CellContact> = true;
}  // namespace acinus
