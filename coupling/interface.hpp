#pragma once
/// The interface between the two models: contact of a deformable surface with a compliant sphere.
///
/// Tension as between two deformable cells. Under compression the sphere yields: pressure = -k_s
/// gap with 1/k_s = 1/k_rep + 1/k_w and the Winkler constant k_w = 4 E* / (3 pi R sqrt(d)) that
/// matches the sphere's half of a Hertz contact. d = dent / R, with the dent the deepest point of
/// this pair's contact at the start of the step (docs/decisions/0008.md). A rigid sphere would be
/// about 40 times too stiff. A calibrated sphere has the modulus of its overlap, or of this
/// dent where that is deeper (docs/decisions/0020.md).

#include <cstdint>
#include <span>
#include <vector>

#include "cbm/contact.hpp"
#include "core/solve/system.hpp"
#include "dcm/contact.hpp"

namespace acinus::coupling {

struct InterfaceParams {
  double friction = 0;         ///< nN s/um^3, DCM-CBM
  double friction_factor = 1;  ///< 0 while cells grow to size
};

/// A surface point of a deformable cell near a sphere.
struct InterfaceContact {
  int body = 0, point = 0;     ///< of dcm::ContactWorkspace
  int sphere = 0;              ///< cell of cbm::State
  double gap = 0;              ///< um, negative: the point is inside the sphere
  double dent = 0;             ///< um, deepest point of this pair of cells
  Vec3 normal = Vec3::Zero();  ///< d gap / d x_point: away from the sphere's centre
};

/// What one deformable cell and one sphere exert on each other, for users to read.
struct InterfaceForce {
  std::int64_t dcm_id = 0, cbm_id = 0;
  Vec3 force = Vec3::Zero();  ///< nN, on the deformable cell; the sphere gets the opposite
  double area = 0;            ///< um^2 in touch
  double gap = 0;             ///< um, smallest
};

struct InterfaceWorkspace {
  std::vector<InterfaceContact> contact;  ///< written by: find_interface
  /// (sphere, um^2) of every pair of cells in touch; written by: find_interface
  std::vector<std::pair<int, double>> area;
};

/// What a deformable cell presses on.
struct SphereSurface {
  double radius = 0;  ///< um
  double young = 0;   ///< kPa, without correction
  double poisson = 0;
  cbm::Modulus modulus;                    ///< kPa, at its overlap d
  const cbm::StiffnessLaw* law = nullptr;  ///< nothing: none corrects
};

/// Smallest dent, in radii, that enters the compliance of a sphere.
inline constexpr double kLeastDent = 0.01;

/// Largest dent, in radii, that does. Beyond it a sphere's neighbours share its whole surface, the
/// area of a contact grows no more, and softening on as that of two single spheres does would let
/// a deformable cell under pressure flow into the sphere: at uniform pressure the dent would be
/// (3 pi p / 4 E*)^2 R.
inline constexpr double kMostDent = 0.15;

/// Stiffness of a sphere's surface under a deformable one, nN/um^3, and how it grows with the dent,
/// nN/um^4: 0 where it falls.
struct Compliance {
  double stiffness = 0, slope = 0;
};

/// The series stiffness k_s. @param dent  um
Compliance find_compliance(double repulsion, const SphereSurface& sphere, double dent);

/// Finds all interface contacts. Adds their touching shares to the surface points and, if overlaps
/// are counted, theirs to the spheres, young ones too: a deformable cell is a neighbour of full
/// strength. @pre the deformable cells' find_contacts, the spheres' find_overlaps if any
void find_interface(const dcm::State& dcm_state, const dcm::ContactParams& dcm_contact,
                    const dcm::LaneData& lanes, const cbm::State& cbm_state,
                    std::span<const double> cbm_radius, dcm::ContactWorkspace& dcm_work,
                    cbm::ContactWorkspace& cbm_work, InterfaceWorkspace& work);

/// Adds the areas in touch to the spheres. @pre find_interface, then the spheres' find_contacts
void add_interface_areas(const InterfaceWorkspace& work, cbm::ContactWorkspace& cbm_work);

/// What add_interface_loads reads, named because there is much of it.
struct InterfaceView {
  const dcm::State& dcm_state;
  std::span<const dcm::Params> dcm_params;
  const dcm::ContactParams& dcm_contact;
  const dcm::LaneData& lanes;
  const dcm::ContactWorkspace& dcm_work;
  const cbm::State& cbm_state;
  std::span<const cbm::Params> cbm_params;
  std::span<const double> cbm_radius;         ///< [n_cell] um
  std::span<const cbm::Modulus> cbm_modulus;  ///< [n_cell] kPa
  const InterfaceParams& params;
  const InterfaceWorkspace& work;
};

/// Adds the links: one number, opposite signs, both models' unknowns in one system.
void add_interface_loads(const InterfaceView& view, std::size_t cbm_first_row, solve::Links& links);

/// The forces per pair of cells, ordered by (dcm, cbm) position in the arrays.
std::vector<InterfaceForce> compute_interface_forces(const InterfaceView& view);

}  // namespace acinus::coupling
