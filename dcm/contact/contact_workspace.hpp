#pragma once
/// Input and scratch of the contact search of deformable cells.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/boundary.hpp"
#include "contact/curved_triangle.hpp"
#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "contact/vessel_side.hpp"
#include "dcm/contact/contact_lists.hpp"
#include "dcm/contact/contact_params.hpp"
#include "dcm/lane_data.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"

namespace acinus::dcm {

/// Input of the search for contacts and of their loads.
struct ContactInput {
  const State& state;
  std::span<const Params> params;  ///< [type]
  const ContactParams& options;
  const LaneData& lanes;
  const contact::Boundary& boundary;
  double time = 0;                            ///< s, at which moving walls are evaluated
  std::size_t vessel_row = contact::kAtRest;  ///< first row of the nodes of moving vessels
  std::span<const double> adhesion = {};      ///< [n_lane] factor on adhesion to cells; empty: 1
};

/// Scratch of the search between triangles.
struct TriangleContactWorkspace {
  std::vector<std::vector<contact::CurvedTriangle>> curved;  ///< [body][triangle]
  std::vector<std::vector<contact::CurvedTriangle>> fixed;   ///< [static mesh][triangle]
};

/// Scratch of the contact search. Bodies are the cells in lane order, empty lanes and absent cells
/// left out.
struct ContactWorkspace {
  std::vector<std::uint8_t>
      constrained;  ///< [n_lane] 1: does not move; empty: all move. Set by the caller
  /// [n_lane] 1: ghost cell, computed by another process; empty: none. Set by the caller. Pairs of
  /// two ghost cells are not searched; of a ghost cell only the contacts with own cells are known.
  /// kAbsent: ghost cell without known points, which is no body.
  std::vector<std::uint8_t> ghost;
  /// Written by: refresh_bodies. The caller clears it when absent cells change.
  std::vector<std::size_t> lane_of_body;
  /// Boxes of all bodies; the other members of own bodies and of those given to complete_bodies.
  /// Written by: refresh_bodies
  std::vector<contact::SurfaceBody> body;
  std::vector<std::uint8_t> is_complete;    ///< [body] written by: refresh_bodies
  std::vector<contact::SurfaceBody> fixed;  ///< static meshes, then the surface of vessels
  /// [body] contacts with the surface of vessels; by: find_contacts. Empty: vessels are cones.
  std::vector<contact::Contacts> wall;
  ContactLists lists;                          ///< written by: refresh_lists
  std::vector<std::int64_t> lineage_of_body;   ///< written by: refresh_lists
  std::vector<std::uint8_t> body_constrained;  ///< empty: all move; written by: refresh_lists
  std::vector<std::uint8_t> body_ghost;        ///< empty: none; written by: refresh_lists
  /// [body][point] sum of the touching shares of all contacts of a point; written by:
  /// find_contacts, then added to by the DCM-CBM interface.
  std::vector<std::vector<double>> share;
  TriangleContactWorkspace triangles;               ///< of Maugis-Dugdale alone
  std::int64_t searches = 0;                        ///< calls of find_contacts
  std::int64_t points_listed = 0, points_seen = 0;  ///< over all searches

  static constexpr std::uint8_t kAbsent = 2;
  bool is_absent(std::size_t lane) const { return !ghost.empty() && ghost[lane] == kAbsent; }
  bool is_ghost(std::size_t lane) const { return !ghost.empty() && ghost[lane] != 0; }
  bool is_constrained_body(std::size_t b) const {
    return !constrained.empty() && constrained[lane_of_body[b]] != 0;
  }
  bool is_ghost_body(std::size_t b) const { return is_ghost(lane_of_body[b]); }
};

}  // namespace acinus::dcm
