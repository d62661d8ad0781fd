#pragma once
/// The nucleus of a deformable cell: a second closed surface inside the cortex.
///
/// Its nodes are further points of the cell: rows of the cell's block of unknowns after those of
/// the cortex, in the same lane. What loops over cells or over the nodes of the cortex does not
/// see them, and all that moves points does (docs/decisions/0033.md).

#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Mechanical constants of the nuclei of one cell type.
struct Nucleus {
  int nodes = 42;            ///< of its mesh
  double size = 0.5;         ///< radius over that of the cell
  double young = 5;          ///< kPa, of its shell
  double thickness = 0.5;    ///< um, of its shell
  double poisson = 0.5;      ///< of its shell
  double area_modulus = 0;   ///< nN/um, of the whole surface
  double bulk_modulus = 5;   ///< kPa
  double friction = 1e-2;    ///< nN s/um^3, with the cytosol, per area of the nucleus
  double repulsion = 5;      ///< nN/um^3, between nucleus and cortex
  double gap = 0.5;          ///< um, at which that begins
  double link_young = 0;     ///< kPa, of the cytoskeleton between nucleus and cortex
  double link_friction = 0;  ///< kPa s, beside that

  /// One that nothing holds in shape or in place is carried along without any effect: it is left
  /// out.
  bool resists() const {
    return young > 0 || area_modulus > 0 || bulk_modulus > 0 || link_young > 0 || link_friction > 0;
  }
};

/// The mesh of the nuclei of a group of cells.
struct NucleusMesh {
  const geometry::Topology* topology = nullptr;  ///< shared; null: no nuclei
  double size = 0;                               ///< radius over that of the cell

  bool exists() const { return topology != nullptr; }
  int n_node() const { return exists() ? topology->n_node : 0; }
  bool operator==(const NucleusMesh&) const = default;
};

/// The mesh that cells of a type have; none where there is no nucleus.
inline NucleusMesh nucleus_mesh(const Nucleus* n) {
  if (n == nullptr) return {};
  return {&geometry::shared_icosphere(n->nodes), n->size};
}

}  // namespace acinus::dcm
