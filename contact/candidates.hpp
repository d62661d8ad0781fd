#pragma once
/// Which triangles each probing point of one surface may meet on another, and the closest of them.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/record.hpp"
#include "contact/surface.hpp"

namespace acinus::contact {

struct SearchOptions {
  Quadrature quadrature = Quadrature::kThreePoint;
  double range = 0;       ///< um, largest gap of interest
  double max_depth = 0;   ///< um, deepest (negative) gap looked for
  double skin = 0;        ///< um, relative movement that a list outlives
  double self_range = 0;  ///< um, gap below which a surface meets itself; 0 = never
};

/// Points of a near b and the triangles that may be closest to each; complete while the two bodies
/// moved relative to each other by no more than the skin.
struct Candidates {
  int body_a = 0, body_b = 0;
  std::vector<int> point;            ///< of a, ascending
  std::vector<float> gap;            ///< um, when the list was made
  std::vector<std::uint32_t> start;  ///< [n_point + 1]
  std::vector<int> triangle;         ///< of b, the closest first
  std::vector<float> bound;          ///< um, distance when the list was made

  void clear() {
    for (auto* v : {&point, &triangle}) v->clear();
    for (auto* v : {&gap, &bound}) v->clear();
    start.clear();
  }
};

/// A body by its number: those that probe come first, then those that are only probed.
inline const SurfaceBody& body_at(std::span<const SurfaceBody> bodies,
                                  std::span<const SurfaceBody> fixed, int k) {
  const std::size_t i = k;
  return i < bodies.size() ? bodies[i] : fixed[i - bodies.size()];
}

/// Empty lists, ascending, for all that may touch once boxes have come closer by `reserve`: pairs
/// of bodies both ways, bodies with themselves if o.self_range > 0, and bodies with `fixed`, which
/// are only probed, never probe, and are numbered after `bodies`.
std::vector<Candidates> list_pairs(std::span<const SurfaceBody> bodies,
                                   std::span<const SurfaceBody> fixed, const SearchOptions& o,
                                   double reserve);

/// Fills lists of such pairs for where their bodies are now, on all threads.
void fill_candidates(std::span<const SurfaceBody> bodies, std::span<const SurfaceBody> fixed,
                     const SearchOptions& o, std::span<Candidates* const> lists);

/// Closest features of one candidate list, appended in order of points.
/// Rejected: normals that do not oppose each other, gaps outside [-max_depth, range]. The closest
/// triangle decides, opposing or not: nothing that turns while a list lasts must choose what is on
/// it, for the result does not depend on when the list was made.
/// @param moved  um, bound of what the two bodies moved relative to each other since then: points
///               and triangles that cannot touch yet are skipped
/// @return number of points examined
std::size_t find_contacts(const Candidates& list, std::span<const SurfaceBody> bodies,
                          std::span<const SurfaceBody> fixed, const SearchOptions& options,
                          double moved, std::vector<Contact>& out);

}  // namespace acinus::contact
