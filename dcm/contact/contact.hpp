#pragma once
/// Contacts of deformable cells with each other and with boundary: from closest features to
/// links.

#include <cstdint>
#include <span>
#include <vector>

#include "contact/boundary.hpp"
#include "contact/cohesive.hpp"
#include "contact/record.hpp"
#include "contact/surface.hpp"
#include "contact/vessel_side.hpp"
#include "dcm/contact/contact_lists.hpp"
#include "dcm/contact/triangle_contact.hpp"
#include "dcm/loads.hpp"
#include "dcm/params.hpp"
#include "dcm/state.hpp"
#include "solve/system.hpp"

namespace acinus::dcm {

/// Between which places the friction of two cells acts.
enum class FrictionForm {
  kSurface,  ///< a contact point and the closest place of the other surface
  kNodes     ///< the nodes of both triangles (node_friction.hpp)
};

/// How two deformable cells push and pull.
enum class ContactLaw {
  kCohesive,      ///< cohesive potential of the gap at contact points (contact/cohesive.hpp)
  kMaugisDugdale  ///< the paper's law between triangles (triangle_contact.hpp)
};

/// Constants of the surface contact, the same for all cells.
struct ContactParams {
  ContactLaw law = ContactLaw::kCohesive;
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double repulsion = 5;         ///< nN/um^3, k_rep
  double range_factor = 0.3;    ///< cohesive range in mean reference edges of the point's owner
  double friction_range = 0.3;  ///< um, independent of the mesh
  double max_depth = 1.5;       ///< um
  double skin = 0.3;            ///< um
  double cell_friction = 0;     ///< nN s/um^3, cell-cell
  FrictionForm friction_form = FrictionForm::kSurface;
  double adhesion_factor = 1;  ///< ramps up after start-up
  double friction_factor = 1;  ///< 0 while cells grow to size
  /// The medium is felt on the whole surface, not only where it touches nothing.
  bool whole_medium_area = false;
  // Of Maugis-Dugdale alone:
  double cohesive_range = 0.02;  ///< um, h0
  double modulus = 10;           ///< kPa, E^
  double max_radius = 1e3;       ///< um, R^ of surfaces that are flat or fit into each other
};

/// Folds of one surface are kept this far apart, um.
inline constexpr double kSelfGap = 0.15;

/// What the functions of this file read.
struct ContactInput {
  const State& state;
  std::span<const Params> params;  ///< [type]
  const ContactParams& options;
  const LaneData& lanes;
  const contact::Boundary& boundary;
  double time = 0;                            ///< s, for which moving walls stand
  std::size_t vessel_row = contact::kAtRest;  ///< of the nodes of vessels that move
};

/// Guards: nodes and face centres deep inside a vessel are pushed out, without adhesion or
/// friction. Three-point quadrature would not see a vessel's tip in the middle of a face, nor the
/// tip of a corner at a vessel, and the quadratures with nodes not a thin vessel between the points
/// (so there only face centres guard). Walls that are flat or hollow have no tips. The number of a
/// guard is that of its node, or the number of nodes and that of its face.
///
/// Points at which a vessel yields no more have a second contact with what is missing to the full
/// stiffness; of both its onset is above zero.

/// Share of its area that a guard pushes with, and how deep inside, um, it begins to: the
/// quadrature points carry all that ordinary contact needs, and a point that joins in and leaves
/// again at every step would only make noise. In a wall that yields they begin where it yields no
/// more, as far as it is what yields.
inline constexpr double kGuardShare = 0.25, kGuardGap = 0.05;

/// Whether a contact is one of two triangles, whose place on side a is its own, not that of a
/// point.
inline bool is_between_triangles(const ContactParams& c, const contact::Contact& k) {
  return c.law == ContactLaw::kMaugisDugdale && k.partner == contact::Partner::kSurface &&
         !k.is_fold();
}

/// The nodes and weights of a contact's point; or of its place between triangles.
contact::PointStencil stencil_of(const ContactParams& c, const contact::SurfaceBody& body,
                                 const contact::Contact& contact);

/// The same of a contact that is known to be one of a point.
contact::PointStencil probe_stencil(const ContactParams& c, const contact::SurfaceBody& body,
                                    const contact::Contact& contact);

/// Guarding points of a body, and the reference area each stands for, um^2.
inline std::size_t n_guards(const contact::SurfaceBody& b) {
  return b.node.size() + b.triangle->size();
}
double guard_area(const geometry::Topology& t, int point, double radius);

/// Scratch of the contact search. Bodies are the cells in lane order, empty lanes left out.
struct ContactWorkspace {
  std::vector<std::uint8_t>
      constrained;  ///< [n_lane] 1: does not move; empty: all move. Set by the caller
  /// [n_lane] 1: another process works out this cell; empty: none. Set by the caller. Of two such
  /// cells nothing is looked for, and of one only what own cells may touch is known.
  std::vector<std::uint8_t> foreign;
  std::vector<std::size_t> lane_of_body;  ///< written by: refresh_bodies
  /// Boxes of all; the rest of own bodies and of those that complete_bodies was asked for. Written
  /// by: refresh_bodies
  std::vector<contact::SurfaceBody> body;
  std::vector<std::uint8_t> is_complete;    ///< [body] written by: refresh_bodies
  std::vector<contact::SurfaceBody> fixed;  ///< static meshes, then the surface of vessels
  /// [body] contacts with that surface; by: find_contacts. Empty: vessels are cones.
  std::vector<std::vector<contact::Contact>> wall;
  ContactLists lists;                          ///< written by: refresh_lists
  std::vector<std::int64_t> lineage_of_body;   ///< written by: refresh_lists
  std::vector<std::uint8_t> body_constrained;  ///< empty: all move; written by: refresh_lists
  std::vector<std::uint8_t> body_foreign;      ///< empty: none; written by: refresh_lists
  std::vector<std::vector<contact::Contact>>
      found;  ///< [other threads than the first] by: find_contacts
  std::vector<std::vector<contact::Contact>> obstacle;  ///< [body] with boundary; by: find_contacts
  /// [body][point] sum of the touching shares of all contacts of a point; written by:
  /// find_contacts, then added to by the DCM-CBM interface.
  std::vector<std::vector<double>> share;
  TriangleContactWorkspace triangles;               ///< of Maugis-Dugdale alone
  std::int64_t searches = 0;                        ///< calls of find_contacts
  std::int64_t points_listed = 0, points_seen = 0;  ///< over all searches

  bool is_foreign(std::size_t lane) const { return !foreign.empty() && foreign[lane] != 0; }
  bool is_foreign_body(std::size_t b) const { return is_foreign(lane_of_body[b]); }
};

/// Largest gap at which a contact of this cell does anything, um.
double contact_range(const ContactParams& c, const geometry::Topology& t, double radius);

/// Surface area that a probing point stands for, um^2: its share of the reference surface.
double point_area(const geometry::Topology& t, contact::Quadrature q, int point, double radius);

/// Present area of the triangles about a point over their area at rest, which a birth shape does
/// not change: times point_area, the present area that the point stands for.
double point_stretch(const contact::SurfaceBody& body, contact::Quadrature q, int point,
                     double radius);

/// Copies the nodes out of the lanes and recomputes normals and boxes; of foreign bodies only the
/// boxes.
void refresh_bodies(const State& state, ContactWorkspace& work);

/// The same of the foreign bodies among some, any number of times each. @pre refresh_bodies
void complete_bodies(const State& state, std::span<const int> bodies, ContactWorkspace& work);

/// Copies the nodes of the bodies that have none, for measures that look at all of them.
/// @pre refresh_bodies
void copy_all_nodes(const State& state, ContactWorkspace& work);

/// Makes the lists again that no longer hold (contact_lists.hpp). @pre refresh_bodies
void refresh_lists(const ContactInput& in, ContactWorkspace& work);

/// Starts the list of contacts with all those between surfaces and of surfaces with boundary,
/// and finds each point's touching share.
void find_contacts(const ContactInput& in, ContactWorkspace& work, contact::ContactList& contacts);

/// Scale that keeps the touching areas of one point from adding up to more than its area.
inline double share_scale(double total_share) { return total_share > 1 ? 1 / total_share : 1; }

/// What a contact of two cells rubs with, nN s/um^3 of its point's area; the other side sees the
/// contact as well, so that half the area counts. @pre all shares are known
double cell_friction_at(const ContactParams& c, const ContactWorkspace& work,
                        const contact::Contact& contact);

/// A place on a cell as the solver names it.
solve::Side side_at(const State& state, std::size_t lane, const contact::PointStencil& stencil);

/// Side a of a contact of a surface, and side b of one between surfaces.
solve::Side side_a(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);
solve::Side side_b(const ContactInput& in, const ContactWorkspace& work,
                   const contact::Contact& contact);

/// Completes the contacts of surfaces with each other and with boundary, and adds a link for
/// each. Cell-cell contacts are seen from both sides and carry half the weight each. Friction
/// between cells only in the form between surfaces.
void add_contact_loads(const ContactInput& in, const ContactWorkspace& work,
                       contact::ContactList& contacts, solve::Links& links);

/// Area of each node that feels the medium, [n_row][lane] um^2: what touches no neighbour, or all
/// of it (whole_medium_area). @pre all shares are known
void compute_medium_areas(const ContactInput& in, const ContactWorkspace& work,
                          std::vector<double>& medium_area);

}  // namespace acinus::dcm
