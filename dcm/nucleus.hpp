#pragma once
/// Nucleus of a deformable cell: a second closed surface inside the cortex.
///
/// Its nodes are further points of the cell: rows of the cell's block of unknowns after those of
/// the cortex, in the same lane. Loops over cells or over the nodes of the cortex exclude them;
/// code that moves points includes them (decision 33).

#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Mechanical constants of the nuclei of one cell type.
struct Nucleus {
  int nodes = 42;            ///< nodes of its mesh
  double size = 0.5;         ///< radius over that of the cell
  double young = 5;          ///< kPa, of its shell
  double thickness = 0.5;    ///< um, of its shell
  double poisson = 0.5;      ///< of its shell
  double area_modulus = 0;   ///< nN/um, of the whole surface
  double bulk_modulus = 5;   ///< kPa
  double friction = 1e-2;    ///< nN s/um^3, with the cytosol, per area of the nucleus
  double repulsion = 5;      ///< nN/um^3, between nucleus and cortex
  double gap = 0.5;          ///< um, gap at which the repulsion begins
  double link_young = 0;     ///< kPa, of the cytoskeleton between nucleus and cortex
  double link_friction = 0;  ///< kPa s, parallel to link_young

  /// True if any term resists a change of shape or place. A nucleus without resistance has no
  /// effect and is left out.
  bool resists() const {
    return young > 0 || area_modulus > 0 || bulk_modulus > 0 || link_young > 0 || link_friction > 0;
  }
};

/// Mesh of the nuclei of a group of cells.
struct NucleusMesh {
  const geometry::Topology* topology = nullptr;  ///< shared; null: no nuclei
  double size = 0;                               ///< radius over that of the cell

  bool exists() const { return topology != nullptr; }
  int n_node() const { return exists() ? topology->n_node : 0; }
  bool operator==(const NucleusMesh&) const = default;
};

/// Mesh of the nuclei of a cell type; empty without a nucleus.
inline NucleusMesh nucleus_mesh(const Nucleus* n) {
  if (n == nullptr) return {};
  return {&geometry::shared_icosphere(n->nodes), n->size};
}

}  // namespace acinus::dcm
