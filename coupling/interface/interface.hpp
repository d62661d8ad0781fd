#pragma once
/// Interface between the two models: contact of a deformable surface with a compliant sphere.
///
/// Tension as between two deformable cells. Under compression the sphere yields: pressure = -k_s
/// gap on the present area (decision 35) with 1/k_s = 1/k_rep + 1/k_w and the Winkler
/// constant k_w = 4 E* / (3 pi R sqrt(d)) that matches the sphere's half of a Hertz contact. d =
/// indentation / R, with the deepest point of this pair's contact at the start of the step
/// (decision 8). A rigid sphere would be about 40 times too stiff. A calibrated sphere
/// has the modulus of its overlap, or of a deeper indentation (decision 20).

#include <cstdint>
#include <span>
#include <vector>

#include "cbm/contact.hpp"
#include "core/parallel/ranks.hpp"
#include "dcm/contact/contact_workspace.hpp"
#include "solve/system.hpp"

namespace acinus::coupling {

/// Friction between bodies of both models: the harmonic mean of those within the models.
inline double mean_friction(double dcm, double cbm) {
  return dcm + cbm > 0 ? 2 * dcm * cbm / (dcm + cbm) : 0;
}

struct InterfaceParams {
  /// nN s/um^3, DCM-CBM; by default the harmonic mean of those within the models.
  double friction = mean_friction(dcm::ContactParams{}.cell_friction, cbm::Params{}.cell_friction);
  double friction_factor = 1;  ///< 0 while cells grow to size
};

/// Net contact of one deformable cell and one sphere, for reports.
struct InterfaceForce {
  std::int64_t dcm_id = 0, cbm_id = 0;
  Vec3 force = Vec3::Zero();  ///< nN, on the deformable cell; the sphere gets the opposite
  double area = 0;            ///< um^2, contact area
  double gap = 0;             ///< um, smallest
};

}  // namespace acinus::coupling

namespace acinus {
template <>
inline constexpr bool kIsPlain<coupling::InterfaceForce> = true;
}  // namespace acinus

namespace acinus::coupling {

/// Scratch of the interface.
struct InterfaceWorkspace {
  std::vector<Box> body, sphere;
  std::vector<int> number;                   ///< of the spheres with a box
  std::vector<std::pair<int, int>> near;     ///< candidate pairs: body, sphere
  std::vector<std::pair<int, double>> area;  ///< (sphere, um^2) of every touching pair
};

/// Elastic constants of a sphere as the partner of a deformable surface.
struct SphereSurface {
  double radius = 0;  ///< um
  double young = 0;   ///< kPa, without correction
  double poisson = 0;
  cbm::Modulus modulus;                    ///< kPa, at its overlap d
  const cbm::StiffnessLaw* law = nullptr;  ///< null: no correction
};

/// Least indentation, in radii, used in the compliance of a sphere.
inline constexpr double kLeastDepth = 0.01;

/// Largest indentation, in radii, used in the compliance of a sphere. Beyond it the neighbours of a
/// sphere share its whole surface and contact areas grow no more. Softening as for two single
/// spheres would then let a deformable cell under pressure flow into the sphere: at uniform
/// pressure the indentation would be (3 pi p / 4 E*)^2 R.
inline constexpr double kMostDepth = 0.15;

/// Stiffness of a sphere's surface under a deformable one, nN/um^3, and its derivative with respect
/// to indentation, nN/um^4; 0 where it decreases.
struct Compliance {
  double stiffness = 0, slope = 0;
};

/// Series stiffness k_s.   @param depth  um
Compliance compute_compliance(double repulsion, const SphereSurface& sphere, double depth);

/// Modulus of the surface of a sphere, kPa, E/(1 - nu^2): corrected at its overlap with others.
/// @pre overlaps are complete
double surface_modulus(const cbm::ContactInput& in, const cbm::ContactWorkspace& work,
                       std::size_t sphere);

/// Input of the interface functions.
struct InterfaceInput {
  dcm::ContactInput dcm;
  cbm::ContactInput cbm;
  const InterfaceParams& params;
};

/// Searches all interface contacts and appends them. Adds their touching shares to the surface
/// points. If overlaps are counted, adds theirs to the spheres, young ones included: a deformable
/// cell is a neighbour of full strength.
/// @pre dcm::find_contacts, and cbm::compute_overlaps if there is a correction. With contacts of
///     triangles only overlaps are counted: find_triangle_interface follows.
void find_interface(const InterfaceInput& in, dcm::ContactWorkspace& dcm_work,
                    cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work,
                    contact::ContactList& contacts);

/// Searches the interface contacts of triangles by the paper's law: the sphere of a triangle with
/// the sphere of a cell [VanLiedekerke2020, section 2.1]. The modulus of a sphere is that at its
/// overlap.
/// @pre find_interface, and overlaps are complete
void find_triangle_interface(const InterfaceInput& in, dcm::ContactWorkspace& dcm_work,
                             const cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work,
                             contact::ContactList& contacts);

/// Adds contact areas to the spheres.   @pre find_interface, then cbm::find_contacts
void add_interface_areas(const InterfaceWorkspace& work, cbm::ContactWorkspace& cbm_work);

/// Side b of an interface contact.
solve::Side sphere_side(const InterfaceInput& in, const contact::Contact& contact);

/// Computes force, stiffness and friction of the interface contacts and adds a link for each. Both
/// sides get the same force with opposite signs in one system.
/// @param modulus  [n_cell] kPa of the spheres
void add_interface_loads(const InterfaceInput& in, const dcm::ContactWorkspace& dcm_work,
                         std::span<const cbm::Modulus> modulus, contact::ContactList& contacts,
                         solve::Links& links);

/// Net forces per pair of cells, ordered by (dcm, cbm) position in the arrays.
/// @pre the contacts are complete
std::vector<InterfaceForce> compute_interface_forces(const InterfaceInput& in,
                                                     const dcm::ContactWorkspace& dcm_work,
                                                     const contact::ContactList& contacts);

}  // namespace acinus::coupling
