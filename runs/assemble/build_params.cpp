#include "runs/assemble/build_params.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "runs/scene/apparatus/apparatus.hpp"

namespace acinus::runs {
namespace {

/// Default contact range, in mean edge lengths. It grows with the spacing of the contact points.
double default_range(contact::Quadrature quadrature) {
  switch (quadrature) {
    case contact::Quadrature::kThreePoint:
      return 0.3;
    case contact::Quadrature::kNodes:
      return 0.5;
    case contact::Quadrature::kNodesAndEdges:
      return 0.35;
  }
  return 0;
}

void set_contact(const Scene& scene, coupling::Params& p) {
  p.dcm_contact = scene.contact;
  if (p.dcm_contact.range_factor == 0)
    p.dcm_contact.range_factor = default_range(scene.contact.quadrature);
  p.cbm_contact.skin = scene.contact.skin;
  p.interface.friction = scene.friction.dcm_cbm.value_or(coupling::mean_friction(
      scene.contact.cell_friction, scene.friction.cbm_cbm.value_or(cbm::Params{}.cell_friction)));
}

void set_motility(const Scene& scene, coupling::Motility& m) {
  m = scene.motility;
  m.seed = scene.seed;
  if (m.leader_slice == 0) m.leader_slice = 2 * scene.cell_types.begin()->second.radius;
  m.axis_point = scene.axis_point;
  if (scene.lobule) m.axis_radius = scene.lobule->central_vein_radius;
}

/// Sets the moving zoom. No effect with a uniform model ("--set model=dcm" or "cbm").
void set_zoom(const Scene& scene, coupling::ZoomParams& p) {
  const CellModel model = model_of(scene);
  if (!scene.moving_zoom || model != CellModel::kZoom) return;
  p = *scene.moving_zoom;
  p.region = scene.zoom;
  p.axis_point = scene.axis_point;
  p.seed = scene.seed;
  for (const auto& [name, type] : scene.cell_types)
    p.mesh.push_back(&geometry::shared_icosphere(type.dcm.nodes));
}

/// Sets the adhesions of all pairs of types, if the scene gives any. Types in lysis have those of
/// theirs, softened as geometric means are.
void set_pair_adhesions(const Scene& scene, coupling::Params& p) {
  if (std::ranges::all_of(scene.cell_types,
                          [](const auto& t) { return t.second.adhesion_with.empty(); }))
    return;
  struct PairedType {
    const CellType* type;
    double root = 1;  ///< of its softening
  };
  std::vector<PairedType> source;  // [type], those of the scene first
  for (const auto& [name, type] : scene.cell_types) source.push_back({&type});
  source.resize(p.dcm.size());
  for (std::size_t k = 0; k < scene.cell_types.size(); ++k)
    if (const int soft = p.life.type[k].death.type; soft >= 0)
      source[soft] = {source[k].type, std::sqrt(source[k].type->softening)};
  for (std::size_t a = 0; a < source.size(); ++a) {
    p.dcm[a].adhesion_with.clear();
    for (const PairedType& b : source)
      p.dcm[a].adhesion_with.push_back(source[a].root * b.root *
                                       pair_adhesion(scene, *source[a].type, *b.type));
    p.cbm[a].adhesion_with = p.dcm[a].adhesion_with;
  }
}

void set_numerics(const Scene& scene, coupling::Numerics& n) {
  n = scene.numerics;
  // An explicit step's length is set by stability, not by what an error estimate asks for.
  if (n.integrator == coupling::Integrator::kExplicitEuler) n.adaptive = false;
}

}  // namespace

dcm::Params make_dcm_params(const Scene& scene, const CellType& type) {
  const DcmBlock& d = type.dcm;
  dcm::Params p = d;
  p.spring_stiffness = dcm::cortex_spring_stiffness(d.cortex_young, d.cortex_thickness);
  p.bending_stiffness =
      dcm::cortex_bending_stiffness(d.cortex_young, d.cortex_thickness, d.cortex_poisson);
  p.fold_repulsion = scene.contact.repulsion;
  if (d.contraction) p.ring = *d.contraction;
  if (p.nucleus && !p.nucleus->resists()) p.nucleus.reset();
  p.viscosity = scene.friction.liquid ? scene.friction.viscosity : 0;
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.dcm_vessel.value_or(p.medium_friction);
  return p;
}

cbm::Params make_cbm_params(const Scene& scene, const CellType& type) {
  cbm::Params p = type.cbm;
  if (p.young == 0) p.young = cbm::young_from_bulk(type.dcm.bulk_modulus, p.poisson);
  p.cell_friction = scene.friction.cbm_cbm.value_or(p.cell_friction);
  p.viscosity = scene.friction.liquid ? scene.friction.viscosity : 0;
  p.whole_medium_area = scene.contact.whole_medium_area;
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.cbm_vessel.value_or(p.medium_friction);
  return p;
}

void set_params(const Scene& scene, coupling::Params& p) {
  set_contact(scene, p);
  set_pair_adhesions(scene, p);
  p.start_up = scene.start_up;
  set_motility(scene, p.motility);
  set_zoom(scene, p.zoom);
  set_numerics(scene, p.numerics);
  add_apparatus(scene, p);
}

}  // namespace acinus::runs
