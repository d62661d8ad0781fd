#include "runs/build/build_params.hpp"

#include "coupling/step/attempt.hpp"

namespace acinus::runs {
namespace {

struct QuadratureChoice {
  contact::Quadrature quadrature = contact::Quadrature::kThreePoint;
  double range_factor = 0.3;  ///< mean edges: the farther points are apart, the more they need
};

QuadratureChoice quadrature_of(const std::string& name) {
  if (name == "nodes") return {contact::Quadrature::kNodes, 0.5};
  if (name == "nodes-and-edges") return {contact::Quadrature::kNodesAndEdges, 0.35};
  return {};
}

coupling::Leaders leaders_of(const std::string& name) {
  if (name == "front") return coupling::Leaders::kFront;
  if (name == "border") return coupling::Leaders::kBorder;
  if (name == "sector") return coupling::Leaders::kSector;
  if (name == "nearest") return coupling::Leaders::kNearest;
  return coupling::Leaders::kForemost;
}

void set_contact(const Scene& scene, coupling::Params& p) {
  const auto [quadrature, range_factor] = quadrature_of(scene.contact.quadrature);
  p.dcm_contact.quadrature = quadrature;
  p.dcm_contact.repulsion = scene.contact.repulsion;
  p.dcm_contact.range_factor = scene.contact.range.value_or(range_factor);
  p.dcm_contact.friction_range = scene.friction.range;
  p.dcm_contact.whole_medium_area = scene.friction.medium_area == "whole";
  p.dcm_contact.max_depth = scene.contact.max_depth;
  p.dcm_contact.skin = p.cbm_contact.skin = scene.contact.skin;
  p.dcm_contact.cell_friction = scene.friction.dcm_dcm;
  if (scene.friction.form == "nodes") p.dcm_contact.friction_form = dcm::FrictionForm::kNodes;
  p.cbm_contact.cell_friction = scene.friction.cbm_cbm;
  const double a = scene.friction.dcm_dcm, b = scene.friction.cbm_cbm;
  p.interface.friction = scene.friction.dcm_cbm.value_or(a + b > 0 ? 2 * a * b / (a + b) : 0);
}

void set_motility(const Scene& scene, coupling::Motility& m) {
  m.seed = scene.seed;
  m.random = scene.motility.random;
  m.in_plane = scene.motility.directions == "plane";
  m.grid = scene.motility.grid;
  m.leader_force = scene.motility.leader_force;
  m.leader_grid = scene.motility.leader_grid;
  m.leaders = leaders_of(scene.motility.leaders);
  m.leader_count = scene.motility.leader_count;
  m.leader_slice =
      scene.motility.leader_slice.value_or(2 * scene.cell_types.begin()->second.radius);
  m.axis_point = scene.axis_point;
}

void set_numerics(const Scene& scene, coupling::Numerics& n) {
  n = {scene.time.step,     scene.time.min_step,
       scene.time.adaptive, scene.time.tolerance,
       scene.time.max_move, {scene.solver.tolerance, scene.solver.max_iterations}};
  n.extrapolate = scene.time.extrapolate;
  for (const auto method : {coupling::Integrator::kExplicitEuler, coupling::Integrator::kRos2,
                            coupling::Integrator::kNewton})
    if (scene.time.integrator == coupling::name_of(method)) n.integrator = method;
  // An explicit step's length is set by stability, not by what an error estimate asks for.
  if (n.integrator == coupling::Integrator::kExplicitEuler) n.adaptive = false;
}

}  // namespace

dcm::Params make_dcm_params(const Scene& scene, const CellType& type) {
  const DcmBlock& d = type.dcm;
  dcm::Params p;
  p.cortex_thickness = d.cortex_thickness;
  p.spring_stiffness = dcm::cortex_spring_stiffness(d.cortex_young, d.cortex_thickness);
  p.bending_stiffness =
      dcm::cortex_bending_stiffness(d.cortex_young, d.cortex_thickness, d.cortex_poisson);
  p.area_modulus = d.area_modulus;
  p.local_area_modulus = d.local_area_modulus;
  p.bulk_modulus = d.bulk_modulus;
  p.nodal_friction = d.nodal_friction;
  p.axial_friction = d.nodal_friction_kind == "axial";
  p.medium_friction = d.ecm_friction;
  p.viscosity = scene.friction.medium == "liquid" ? scene.friction.viscosity : 0;
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.dcm_vessel.value_or(d.ecm_friction);
  return p;
}

cbm::Params make_cbm_params(const Scene& scene, const CellType& type) {
  cbm::Params p;
  p.young = type.cbm.young.value_or(cbm::young_from_bulk(type.dcm.bulk_modulus, type.cbm.poisson));
  p.young_spread = type.cbm.young_spread;
  p.poisson = type.cbm.poisson;
  p.medium_friction = type.cbm.ecm_friction;
  p.viscosity = scene.friction.medium == "liquid" ? scene.friction.viscosity : 0;
  p.whole_medium_area = scene.friction.medium_area == "whole";
  p.diffusion = type.diffusion;
  p.adhesion = type.adhesion;
  p.vessel_friction = scene.friction.cbm_vessel.value_or(type.cbm.ecm_friction);
  return p;
}

void set_params(const Scene& scene, coupling::Params& p) {
  set_contact(scene, p);
  p.start_up = {scene.start_up.enabled,         scene.start_up.growth_time,
                scene.start_up.adhesion_ramp,   scene.start_up.max_duration,
                scene.start_up.speed_tolerance, scene.start_up.pressure_tolerance};
  set_motility(scene, p.motility);
  set_numerics(scene, p.numerics);
}

}  // namespace acinus::runs
