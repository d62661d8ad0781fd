#pragma once
/// Shape of a cell at birth, the rest shape of its cortex at first. The cortex forgets it in the
/// course of mitosis, so that division makes no force jump.

#include <span>

#include "core/numbers/ramp.hpp"
#include "core/numbers/shared_numbers.hpp"
#include "core/vec.hpp"
#include "geometry/topology.hpp"

namespace acinus::dcm {

/// Time in which a cortex forgets a shape that it did not get by division, s: as long as mitosis,
/// slow next to the relaxation of a cell, fast next to its cycle.
inline constexpr double kForgetShape = 3600;

/// Ratios of references to those of a sphere of the reference volume: r(t) = 1 + weight(t) (ratio -
/// 1). Where several processes share a run, numbers of edges, triangles and links are with the
/// owner of the cell.
struct BirthShape {
  Ramp weight = Ramp::constant(0);  ///< from 1 at birth to 0 after mitosis
  double area = 1;                  ///< ratio of the whole surface
  SharedNumbers edge;               ///< [n_edge] ratios of lengths; empty: none
  SharedNumbers triangle;           ///< [n_triangle] ratios of areas; empty: none
  SharedNumbers link;               ///< [n_node of the nucleus] lengths of its links; empty: all 1

  bool is_forgotten(double time) const { return !(weight.at(time) > 0); }
};

/// Frees the shapes that are forgotten at a time.
void drop_forgotten(double time, std::span<BirthShape> shapes);

/// Birth shape of these nodes at rest, but for a stretch of the surface (area over its reference)
/// that acts from the first moment on.
/// @param radius  um, reference radius
BirthShape make_birth_shape(const geometry::Topology& topology, std::span<const Vec3> node,
                            double radius, double stretch, const Ramp& weight);

/// Stretch of a surface: its area over the present area of the membrane at rest.
/// @param shape   birth shape, which is the rest shape until it is forgotten
/// @param radius  um, reference radius
double measure_stretch(const BirthShape& shape, const geometry::Topology& topology,
                       std::span<const Vec3> node, double radius, double time);

}  // namespace acinus::dcm
