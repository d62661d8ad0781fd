#include "coupling/life/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/sphere.hpp"
#include "coupling/step/loop.hpp"
#include "coupling/step/workspace_size.hpp"
#include "geometry/measures.hpp"

namespace acinus::coupling {
namespace {

/// Friction with the medium and within the cortex, nN s/um^3 and nN s/um: far below that of tissue,
/// for rest within seconds.
constexpr double kFriction = 1e-3;
/// First step and duration of growth, s.
constexpr double kFirstFillStep = 0.02, kGrowth = 2;
/// Largest node displacement at rest, in a step of at least this length.
constexpr double kRestMove = 0.01, kRestStep = 1;  // um, s
constexpr int kMostSteps = 150;
/// Share of the enclosed volume above which a start needs no growth.
constexpr double kNearlyFull = 0.9;

}  // namespace

Filling fill(const World& world, int type, const geometry::Topology& topology,
             const std::vector<Vec3>& node, const geometry::Surface& envelope) {
  World small;
  dcm::Params p = world.params.dcm[type];
  p.medium_friction = kFriction;
  p.nodal_friction = kFriction;
  p.series_friction = 0;
  p.nucleus.reset();
  p.adhesion_with.clear();
  p.viscosity = p.diffusion = p.adhesion = p.vessel_friction = 0;
  small.params.dcm = {p};
  small.params.dcm_contact = world.params.dcm_contact;
  small.params.dcm_contact.quadrature = contact::Quadrature::kThreePoint;
  small.params.dcm_contact.cell_friction = 0;
  small.params.motility.random = false;
  small.params.numerics.min_step = 1e-7;
  small.params.numerics.cg = world.params.numerics.cg;
  small.params.boundary.meshes.push_back(contact::make_static_mesh("mother", envelope, true));

  const double full = geometry::compute_volume(envelope.node, envelope.triangle);
  const double start = std::min(full, geometry::compute_volume(node, topology.triangle));
  const double radius = sphere_radius(full);
  State& s = small.state;
  s.dcm = dcm::make_state({{0, 0, &topology, Vec3::Zero(), radius}});
  for (int i = 0; i < topology.n_node; ++i)
    store_point(s.dcm.position.data(), dcm::node_address(s.dcm, 0, i), node[i]);
  if (start < kNearlyFull * full) s.dcm.volume[0] = {start, full, 0, kGrowth};
  dcm::BirthShape& shape = s.dcm.birth[0];
  shape.weight = Ramp::constant(1);
  shape.area = geometry::compute_area(envelope.node, envelope.triangle) /
               (topology.rest_area * radius * radius);
  shape.edge = std::vector<double>(topology.edge.size(), std::sqrt(shape.area));
  shape.triangle = std::vector<double>(topology.triangle.size(), shape.area);
  s.clock.step = kFirstFillStep;

  Filling filling;
  Workspace work;
  size_workspace(small, work);
  const LoopResult result =
      run_loop({.time_left = [] { return std::numeric_limits<double>::infinity(); },
                .advance = [&](double limit) { return take_step(small, work, limit); },
                .after =
                    [&](const StepResult& step) {
                      const bool rests = s.clock.time > kGrowth && step.step >= kRestStep &&
                                         step.max_move < kRestMove;
                      return !rests && s.clock.accepted < kMostSteps;
                    }});
  filling.steps = result.steps;
  if (!result.ok) {
    filling.ok = false;
    filling.cause = "the daughter cannot unfold: " + result.last.cause;
    return filling;
  }
  dcm::copy_nodes(s.dcm, 0, filling.node);
  return filling;
}

}  // namespace acinus::coupling
