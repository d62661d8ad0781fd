#pragma once
/// Candidate lists of the narrow phase: the triangles of one surface that may be closest to each
/// probing point of another.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/candidate_list.hpp"
#include "contact/record.hpp"
#include "contact/surface.hpp"

namespace acinus::contact {

struct SearchOptions {
  Quadrature quadrature = Quadrature::kThreePoint;
  double range = 0;       ///< um, largest gap of a contact
  double max_depth = 0;   ///< um, largest overlap of a contact
  double skin = 0;        ///< um, Verlet skin: relative motion that a list allows for
  double self_range = 0;  ///< um, largest gap of a self-contact; 0: none
  /// True: two bodies are paired once, the lower number first, and their list has all triangles
  /// within the range, for laws between triangles. Self-contacts keep the points.
  bool triangles = false;
};

/// Candidate list of a pair of bodies: points of a near b, ascending, with the triangles of b that
/// may be closest to each, the closest first; between triangles, triangles of a near b with those
/// within the range of each. Gaps and bounds are those of when the list was made. Complete while
/// the bodies have moved relative to each other by no more than the skin.
struct Candidates {
  int body_a = 0, body_b = 0;
  CandidateList list;
};

/// Body by its number: `bodies`, which probe, come first, then `fixed`, which are only probed.
inline const SurfaceBody& body_at(std::span<const SurfaceBody> bodies,
                                  std::span<const SurfaceBody> fixed, int k) {
  const std::size_t i = k;
  return i < bodies.size() ? bodies[i] : fixed[i - bodies.size()];
}

/// Empty lists, ascending, for all pairs of bodies that may touch once their boxes have approached
/// by `reserve`, um: each pair of `bodies` in both orders, or in one if o.triangles, each body with
/// itself if o.self_range > 0, and each body with those of `fixed`. Fixed bodies are only probed
/// and are numbered after `bodies`.
std::vector<Candidates> list_pairs(std::span<const SurfaceBody> bodies,
                                   std::span<const SurfaceBody> fixed, const SearchOptions& o,
                                   double reserve);

/// Fill candidate lists at the present positions of their bodies, on all threads.
void fill_candidates(std::span<const SurfaceBody> bodies, std::span<const SurfaceBody> fixed,
                     const SearchOptions& o, std::span<Candidates* const> lists);

/// Closest features of one candidate list, appended in order of points. Contacts with normals that
/// do not oppose each other and with gaps outside [-max_depth, range] are rejected. The closest
/// triangle decides even if it is then rejected: the result must not depend on the age of the list,
/// so nothing that rotates during its life may select its triangles.
/// @param moved  um, bound of the relative motion of the two bodies since the list was made; points
///     and triangles that cannot touch yet are skipped
/// @return number of points examined
std::size_t find_contacts(const Candidates& pair, std::span<const SurfaceBody> bodies,
                          std::span<const SurfaceBody> fixed, const SearchOptions& options,
                          double moved, Contacts& out);

}  // namespace acinus::contact
