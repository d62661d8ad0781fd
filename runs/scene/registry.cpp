#include "runs/scene/registry.hpp"

#include "runs/scene/apparatus/apparatus.hpp"
#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_time(Visitor& v, Scene& s) {
  TimeBlock& b = s.time;
  coupling::Numerics& n = s.numerics;
  v.real({.name = "end",
          .meaning = "simulated time after t = 0",
          .dimension = kTime,
          .unit = "h",
          .range = kPositive,
          .required = true},
         b.end);
  v.real({.name = "step",
          .meaning = "longest time step",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive,
          .symbol = "dt"},
         n.max_step);
  v.real({.name = "min_step",
          .meaning = "shortest step tried before the run gives up",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         n.min_step);
  v.flag({.name = "adaptive", .meaning = "step-size control; false keeps every step at time.step"},
         n.adaptive);
  v.real({.name = "tolerance",
          .meaning = "position error one step may make",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         n.tolerance);
  v.real({.name = "max_move",
          .meaning = "farthest a node may move in one step, in mean edge lengths; 0 = no cap",
          .range = {.low = 0, .high = 1}},
         n.max_move);
  choice(v,
         {.name = "integrator",
          .meaning = "how a step is taken; linearly-implicit is meant for tissue, the others for "
                     "comparison (explicit-euler) and equilibrium (newton)"},
         n.integrator);
  v.flag({.name = "extrapolate",
          .meaning =
              "linearly implicit steps look ahead along the last step's velocity: steady motion "
              "has a third of the error"},
         n.extrapolate);
  v.integer({.name = "until_cells",
             .meaning = "the run ends when there are so many cells; 0 = only at time.end",
             .range = {.low = 0, .high = 1e9}},
            b.until_cells);
}

void describe_solver(Visitor& v, solve::CgOptions& b) {
  v.real({.name = "tolerance",
          .meaning = "residual of the conjugate gradients, relative to the right-hand side",
          .range = {.low = 0, .high = 0.1, .low_open = true}},
         b.tolerance);
  v.integer({.name = "max_iterations",
             .meaning = "conjugate gradient iterations of one solve; twice as many each time that "
                        "one failed at the same step",
             .range = kAtLeastOne},
            b.max_iterations);
}

void describe_start_up(Visitor& v, StartUpBlock& b) {
  v.flag({.name = "enabled",
          .meaning = "grow the cells from small spheres and let them settle before t = 0"},
         b.enabled);
  v.real({.name = "initial_radius",
          .meaning = "radius the cells grow from",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.initial_radius);
  v.real({.name = "growth_time",
          .meaning = "time of the growth to full radius",
          .dimension = kTime,
          .unit = "h",
          .range = kPositive},
         b.growth_time);
  v.real({.name = "adhesion_ramp",
          .meaning = "time over which adhesion is raised after growth",
          .dimension = kTime,
          .unit = "min",
          .range = kNotNegative},
         b.adhesion_ramp);
  v.real({.name = "max_duration",
          .meaning = "longest settling after growth",
          .dimension = kTime,
          .unit = "h",
          .range = kNotNegative},
         b.max_settle);
  v.real({.name = "speed_tolerance",
          .meaning = "settled when no node is faster",
          .dimension = kSpeed,
          .unit = "um/min",
          .range = kPositive},
         b.speed_tolerance);
  v.real({.name = "pressure_tolerance",
          .meaning =
              "settled when pressures change no faster, the mean change over cells relative to the "
              "mean pressure",
          .dimension = kRate,
          .unit = "1/h",
          .range = kPositive},
         b.pressure_tolerance);
  v.text({.name = "from",
          .meaning = "folder of a run whose cells at t = 0 this run takes instead of placing and "
                     "settling its own; what shapes the start must be the same",
          .is_run = true},
         b.from);
}

void describe_friction_of_contacts(Visitor& v, Scene& s) {
  FrictionBlock& b = s.friction;
  v.real({.name = "dcm_dcm",
          .meaning = "friction between two DCM cells, per contact area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kNotNegative,
          .symbol = "gamma_ext+"},
         s.contact.cell_friction);
  v.real({.name = "cbm_cbm",
          .meaning = "friction between two CBM cells, per contact area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kNotNegative,
          .symbol = "gamma_ext+"},
         b.cbm_cbm);
  v.optional_real({.name = "dcm_cbm",
                   .meaning = "friction between a DCM and a CBM cell",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "harmonic mean of dcm_dcm and cbm_cbm"},
                  b.dcm_cbm);
  v.optional_real({.name = "dcm_vessel",
                   .meaning = "friction of a DCM cell with a vessel, or a wall that is no mirror",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "the type's dcm.ecm_friction"},
                  b.dcm_vessel);
  v.optional_real({.name = "cbm_vessel",
                   .meaning = "friction of a CBM cell with a vessel, or a wall that is no mirror",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "the type's cbm.ecm_friction"},
                  b.cbm_vessel);
}

void describe_friction(Visitor& v, Scene& s) {
  describe_friction_of_contacts(v, s);
  choice(v,
         {.name = "form",
          .meaning = "between what dcm_dcm acts: facing points of two surfaces, or each node of a "
                     "triangle with each node of the one it touches, which also holds back "
                     "surfaces that stretch together, the more the coarser the mesh"},
         s.contact.friction_form);
  v.real({.name = "range",
          .meaning = "gap over which friction between DCM surfaces fades out",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         s.contact.friction_range);
  choice(v,
         {.name = "medium",
          .meaning = "what surrounds the cells: matrix, or liquid (Stokes drag)",
          .choices = "ecm|liquid"},
         s.friction.liquid);
  v.real({.name = "viscosity",
          .meaning = "viscosity of the liquid",
          .dimension = kViscosity,
          .unit = "Pa s",
          .range = kPositive,
          .symbol = "eta"},
         s.friction.viscosity);
  choice(v,
         {.name = "medium_area",
          .meaning = "part of a cell's surface that feels the medium. free: what touches no other "
                     "cell or surface, so that areas add up to the surface; whole: all of it, as "
                     "in the paper, for a matrix that pervades the tissue",
          .choices = "free|whole"},
         s.contact.whole_medium_area);
}

void describe_motility(Visitor& v, MotilityBlock& b) {
  v.flag({.name = "random", .meaning = "random motion of the cells"}, b.random);
  choice(v,
         {.name = "directions",
          .meaning = "random motion in space, or in the horizontal plane as on a substrate",
          .choices = "space|plane"},
         b.in_plane);
  v.real({.name = "grid",
          .meaning = "time over which a random force stays constant",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         b.grid);
  v.real({.name = "leader_force",
          .meaning = "force of the leading cells toward the vein axis",
          .dimension = kForce,
          .unit = "nN",
          .range = kNotNegative,
          .symbol = "F_mor"},
         b.leader_force);
  v.real({.name = "leader_grid",
          .meaning = "time between two choices of the leading cells",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.leader_grid);
  choice(v,
         {.name = "leaders",
          .meaning = "which cells lead. foremost: those with no other cell nearer the vein within "
                     "one diameter in arc and height; front: all with a clear straight way to the "
                     "vein; border: all with a clear way into the lesion, two cell diameters long, "
                     "within 45 degrees of that to the vein; sector: the nearest of every sector "
                     "of the circle and slice of height; "
                     "nearest: the leader_count nearest"},
         b.leaders);
  v.when(b.leaders == coupling::Leaders::kSector || b.leaders == coupling::Leaders::kNearest,
         "leaders = sector, nearest", [&b](Visitor& w) {
           w.integer({.name = "leader_count",
                      .meaning = "nearest: number of leaders; sector: sectors of the whole circle",
                      .range = {.low = 1, .high = 1e6}},
                     b.leader_count);
         });
  v.when(b.leaders == coupling::Leaders::kSector, "leaders = sector", [&b](Visitor& w) {
    real_or_auto(w,
                 {.name = "leader_slice",
                  .meaning = "height of a slice",
                  .dimension = kLength,
                  .unit = "um",
                  .range = kPositive,
                  .automatic = "the cell diameter"},
                 b.leader_slice);
  });
}

void describe_output(Visitor& v, OutputBlock& b) {
  v.real({.name = "every",
          .meaning = "time between two frames",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.every);
  v.integer({.name = "after_opening",
             .meaning = "further frames when a wall or the capsule opens, so many for every factor "
                        "ten of the time since, from 1 s on; 0 = none",
             .range = {.low = 0, .high = 1000}},
            b.after_opening);
  choice(v,
         {.name = "compression", .meaning = "compression of the run file", .choices = "none|fast"},
         b.compress);
  v.flag({.name = "start_up", .meaning = "also write frames at t < 0"}, b.start_up);
}

void describe_scene(Visitor& v, Scene& s) {
  v.text({.name = "name",
          .meaning = "name of the scene and of its run folder",
          .automatic = "the scene file's name",
          .is_name = true},
         s.name);
  v.text({.name = "description", .meaning = "what the scene shows, in a sentence"}, s.description);
  v.seed({.name = "seed", .meaning = "seed of all random numbers"}, s.seed);
  choice(v, {.name = "experiment", .meaning = "what is measured"}, s.experiment);
  choice(v,
         {.name = "model",
          .meaning = "replaces cells.model, whatever the scene says there; cells of cells.list "
                     "with a model of their own keep it, zoom regions count only with zoom",
          .automatic = "cells.model stays"},
         s.model);
}

}  // namespace

void describe(Visitor& v, Scene& s) {
  describe_scene(v, s);
  block(v, {.name = "time", .meaning = "duration and steps"}, s, describe_time);
  block(v, {.name = "solver", .meaning = "linear solver"}, s.numerics.cg, describe_solver);
  block(v, {.name = "start_up", .meaning = "growth and settling before t = 0"}, s.start_up,
        describe_start_up);
  named_blocks(v,
               {.name = "cell_types",
                .meaning = "kinds of cells by name; at least one",
                .required = true,
                .item = "cell"},
               s.cell_types, describe_cell_type);
  block(v, {.name = "cells", .meaning = "which cells there are at the start"}, s.cells,
        describe_cells);
  block(v, {.name = "life", .meaning = "which cells rest or die, and when"}, s.life, describe_life);
  blocks(v,
         {.name = "zoom",
          .meaning = "regions whose cells are DCM at t = 0 (their union)",
          .item = "zoom"},
         s.zoom, describe_region);
  optional_block(v,
                 {.name = "moving_zoom",
                  .meaning = "cells change their model when they enter or leave the zoom regions; "
                             "null = cells keep the model they start with"},
                 s.moving_zoom, describe_moving_zoom);
  v.vector({.name = "axis_point",
            .meaning = "the vein axis is vertical (z) through this point",
            .dimension = kLength,
            .unit = "um"},
           s.axis_point);
  block(v, {.name = "contact", .meaning = "contact of surfaces"}, s.contact, describe_contact);
  block(v, {.name = "friction", .meaning = "friction per area"}, s, describe_friction);
  block(v, {.name = "motility", .meaning = "active forces"}, s.motility, describe_motility);
  optional_block(v, {.name = "lobule", .meaning = "generated liver lobule; null = none"}, s.lobule,
                 describe_lobule);
  block(v, {.name = "vessels", .meaning = "blood vessels: network file and mechanics"}, s.vessels,
        describe_vessels);
  blocks(v, {.name = "walls", .meaning = "plane walls", .item = "wall"}, s.walls, describe_wall);
  v.optional_object(
      {.name = "capsule", .meaning = "rigid sphere round the cells; null = none"},
      s.capsule.enabled,
      [&s](bool present) {
        s.capsule = CapsuleEntry{};
        s.capsule.enabled = present;
      },
      [&s](Visitor& w) { describe_capsule(w, s.capsule); });
  blocks(v,
         {.name = "static_meshes", .meaning = "rigid surfaces from files", .item = "static_mesh"},
         s.static_meshes, describe_static_mesh);
  describe_apparatus(v, s);
  block(v, {.name = "output", .meaning = "what is written"}, s.output, describe_output);
}

}  // namespace acinus::runs
