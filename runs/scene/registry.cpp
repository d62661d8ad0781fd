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
          .required = true,
          .affects = Affects::kOutput},
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
              "linearly implicit steps extrapolate along the last step's velocity, which reduces "
              "the error of steady motion threefold; not with contact.law = maugis-dugdale, where "
              "extrapolated steps oscillate"},
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
  v.integer(
      {.name = "max_iterations",
       .meaning = "conjugate gradient iterations of one solve; doubled after each failed solve "
                  "in a step",
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
          .range = kPositive,
          .affects = Affects::kStep},
         b.growth_time);
  v.real({.name = "adhesion_ramp",
          .meaning = "time over which adhesion is raised after growth",
          .dimension = kTime,
          .unit = "min",
          .range = kNotNegative,
          .affects = Affects::kStep},
         b.adhesion_ramp);
  v.real({.name = "max_duration",
          .meaning = "longest settling after growth",
          .dimension = kTime,
          .unit = "h",
          .range = kNotNegative,
          .affects = Affects::kStep},
         b.max_settle);
  v.real({.name = "speed_tolerance",
          .meaning = "settled when no node is faster",
          .dimension = kSpeed,
          .unit = "um/min",
          .range = kPositive,
          .affects = Affects::kStep},
         b.speed_tolerance);
  v.real({.name = "pressure_tolerance",
          .meaning =
              "settled when pressures change no faster, the mean change over cells relative to the "
              "mean pressure",
          .dimension = kRate,
          .unit = "1/h",
          .range = kPositive,
          .affects = Affects::kStep},
         b.pressure_tolerance);
  v.text({.name = "from",
          .meaning = "folder of a run whose cells at t = 0 this run takes instead of placing and "
                     "settling its own; what shapes the start must be the same",
          .is_run = true,
          .affects = Affects::kNothing},
         b.from);
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
  v.flag(
      {.name = "contacts",
       .meaning = "also write the table /contacts: area and force of every pair of cells, and of "
                  "every cell with a part of the boundary"},
      b.contacts);
}

void describe_scene(Visitor& v, Scene& s) {
  v.text({.name = "name",
          .meaning = "name of the scene and of its run folder",
          .automatic = "the scene file's name",
          .is_name = true,
          .affects = Affects::kNothing,
          .compared = false},
         s.name);
  v.text({.name = "description",
          .meaning = "what the scene shows, in a sentence",
          .affects = Affects::kNothing,
          .compared = false},
         s.description);
  v.seed({.name = "seed", .meaning = "seed of all random numbers"}, s.seed);
  choice(v, {.name = "experiment", .meaning = "what is measured", .affects = Affects::kStep},
         s.experiment);
  choice(
      v,
      {.name = "model",
       .meaning = "model of all cells, in place of cells.model; cells of cells.list with a model "
                  "of their own keep it, zoom regions act only with zoom",
       .automatic = "cells.model stays",
       .affects = Affects::kStep,  // of the start cells.model says it
       .compared = false},
      s.model);
  choice(v,
         {.name = "accuracy",
          .meaning = "mesh, contact points, time step and solver that belong together, for tissue: "
                     "sets dcm.nodes of all types, contact.quadrature, contact.range, "
                     "contact.skin, time.step, time.tolerance, time.max_move and "
                     "solver.tolerance where the scene does not; by-key leaves their defaults",
          .affects = Affects::kNothing,  // of the keys it sets
          .compared = false},
         s.accuracy);
}

/// Keys of the boundary: vessels, walls, capsule and meshes.
void describe_boundary(Visitor& v, Scene& s) {
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
}

}  // namespace

void describe(Visitor& v, Scene& s) {
  describe_scene(v, s);
  block(v,
        {.name = "time",
         .meaning = "duration and steps",
         .affects = Affects::kStep,
         .compared = false},
        s, describe_time);
  block(
      v,
      {.name = "solver", .meaning = "linear solver", .affects = Affects::kStep, .compared = false},
      s.numerics.cg, describe_solver);
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
  block(v,
        {.name = "life", .meaning = "which cells rest or die, and when", .affects = Affects::kStep},
        s.life, describe_life);
  blocks(v,
         {.name = "substances",
          .meaning = "substances that diffuse around the cells",
          .item = "substance",
          .affects = Affects::kStep},
         s.substances, describe_substance);
  block(v,
        {.name = "substance_grid",
         .meaning = "grid, step and accuracy of the fields of substances",
         .affects = Affects::kStep},
        s.substance_grid, describe_substance_grid);
  blocks(v,
         {.name = "rules",
          .meaning = "responses of cells to substances; those of growth multiply",
          .item = "rule",
          .affects = Affects::kStep},
         s.rules, describe_signal_rule);
  blocks(v,
         {.name = "zoom",
          .meaning = "regions whose cells are DCM at t = 0 (their union)",
          .item = "zoom",
          .compared = false},
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
  block(v, {.name = "contact", .meaning = "contact of surfaces", .compared = false}, s.contact,
        describe_contact);
  block(v, {.name = "friction", .meaning = "friction per area", .affects = Affects::kStep}, s,
        describe_friction);
  block(v, {.name = "motility", .meaning = "active forces", .affects = Affects::kStep}, s.motility,
        describe_motility);
  describe_boundary(v, s);
  describe_apparatus(v, s);
  block(v,
        {.name = "output",
         .meaning = "what is written",
         .affects = Affects::kOutput,
         .compared = false},
        s.output, describe_output);
}

}  // namespace acinus::runs
