#include "cbm/vessel_contact.hpp"

#include "core/contact/vessel_yield.hpp"

namespace acinus::cbm {

VesselPair corrected_vessel_pair(const StiffnessLaw& law, double young, const Modulus& crowd,
                                 const contact::SphereBody& cell, const contact::Material& vessel,
                                 double vessel_radius, double overlap, double adhesion) {
  const double both = cell.radius + vessel_radius;
  const Modulus modulus = modulus_toward(law, young, crowd, overlap / both);
  contact::SphereBody stiffened = cell;
  stiffened.young = modulus.value;
  VesselPair out{
      contact::vessel_pair(stiffened, {vessel_radius, vessel.young, vessel.poisson}, adhesion)};
  out.own = modulus.value > crowd.value;

  const double plane_strain = 1 - cell.poisson * cell.poisson;
  const double softness = plane_strain / modulus.value;  // s_cell
  double& reduced = out.pair.modulus;
  const double limit = contact::yield_limit(vessel, vessel_radius);
  if (overlap * (1 - reduced * softness) > limit) {
    reduced = (1 - limit / overlap) / softness;
    out.modulus_by_overlap = limit / (overlap * overlap * softness);
  }
  if (out.own) {
    // dE^/dE of the sphere: E^ depends on it through s_cell alone, 1/E^ = s_cell + s_vessel below
    // the limit and E^ proportional to 1/s_cell beyond it.
    const double share =
        out.modulus_by_overlap > 0 ? reduced * softness : reduced * softness * reduced * softness;
    out.modulus_by_overlap += share / plane_strain * modulus.slope / both;
  }
  return out;
}

}  // namespace acinus::cbm
