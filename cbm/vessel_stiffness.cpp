#include "cbm/vessel_stiffness.hpp"

#include "contact/vessel_yield.hpp"

namespace acinus::cbm {

VesselPair corrected_vessel_pair(const FaceModulus& face, const contact::SphereBody& cell,
                                 const contact::Material& vessel, double vessel_radius,
                                 double overlap, double adhesion) {
  VesselPair out{
      contact::vessel_pair(cell, {vessel_radius, vessel.young, vessel.poisson}, adhesion)};
  const double plane_strain = 1 - cell.poisson * cell.poisson;
  const double softness = plane_strain / cell.young;  // s_cell
  double& reduced = out.pair.modulus;
  // dE^/dE of the cell over E^ / E, which is E^ s_cell: E^ depends on E through s_cell alone.
  double by_young = reduced * softness;
  const double limit = contact::yield_limit(vessel, vessel_radius);
  if (overlap * (1 - reduced * softness) > limit) {
    reduced = (1 - limit / overlap) / softness;
    out.modulus_by_overlap = limit / (overlap * overlap * softness);
    by_young = 1;
  }
  if (face.own)
    out.modulus_by_overlap +=
        by_young * reduced * softness / plane_strain * face.slope / (cell.radius + vessel_radius);
  return out;
}

}  // namespace acinus::cbm
