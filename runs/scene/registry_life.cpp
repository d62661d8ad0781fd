#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_rule(Visitor& v, LifeRuleBlock& b) {
  choice(v,
         {.name = "do",
          .meaning = "rest: the cells do not grow while the rule holds for them; die: they die as "
                     "soon as it holds",
          .choices = "rest|die",
          .required = true},
         b.die);
  optional_block(v, {.name = "region", .meaning = "where the cells must be; null = anywhere"},
                 b.region, describe_region);
  v.integers({.name = "cells",
              .meaning = "lineage numbers of the cells, from 0 in the order of the start; [] = all",
              .range = kNotNegative},
             b.cells);
  v.flag({.name = "descendants", .meaning = "the rule is also for the descendants of its cells"},
         b.descendants);
  v.real({.name = "from",
          .meaning = "time after t = 0 at which the rule begins",
          .dimension = kTime,
          .unit = "h",
          .range = kNotNegative},
         b.from);
  real_or_auto(v,
               {.name = "until",
                .meaning = "time after t = 0 at which the rule ends",
                .dimension = kTime,
                .unit = "h",
                .range = kPositive,
                .automatic = "never"},
               b.until, kNever);
  v.real({.name = "share",
          .meaning = "probability that the rule is for a cell, drawn once per cell and rule",
          .range = kFraction},
         b.share);
}

void describe_entry_rate(Visitor& v, coupling::EntryRate& b) {
  v.integer({.name = "first_layer",
             .meaning = "first layer of cells with this rate; 1 is next to the lesion",
             .range = {.low = 1, .high = 1e6}},
            b.first_layer);
  v.integer({.name = "last_layer",
             .meaning = "last layer of cells with this rate",
             .range = {.low = 1, .high = 1e6}},
            b.last_layer);
  v.real({.name = "rate",
          .meaning = "rate at which a resting cell enters the cycle; rates of several entries for "
                     "a layer add up",
          .dimension = kRate,
          .unit = "1/h",
          .range = kNotNegative,
          .required = true},
         b.rate);
  v.real({.name = "from",
          .meaning = "time after t = 0 at which the rate begins",
          .dimension = kTime,
          .unit = "h",
          .range = kNotNegative},
         b.from);
  real_or_auto(v,
               {.name = "until",
                .meaning = "time after t = 0 at which the rate ends",
                .dimension = kTime,
                .unit = "h",
                .range = kPositive,
                .automatic = "never"},
               b.until, kNever);
}

void describe_proliferation(Visitor& v, ProliferationBlock& b) {
  blocks(v,
         {.name = "rates",
          .meaning = "rates at which resting cells enter the cycle, by layer and time",
          .item = "life.proliferation.rates"},
         b.rate, describe_entry_rate);
  choice(
      v,
      {.name = "edge",
       .meaning = "edge of the lesion from which layers are counted: as it stands now (mean over "
                  "slices of height of the distance from the vein to the nearest centre), or "
                  "as it was at the start (lobule.lesion_radius)",
       .choices = "now|start"},
      b.edge_at_start);
  real_or_auto(v,
               {.name = "layer_thickness",
                .meaning = "thickness of a layer of cells",
                .dimension = kLength,
                .unit = "um",
                .range = kPositive,
                .automatic = "the cell diameter"},
               b.thickness);
  v.integer({.name = "cells",
             .meaning = "no cell enters the cycle once so many cells are there or on their way; "
                        "0 = no limit",
             .range = {.low = 0, .high = 1e9}},
            b.cells);
}

}  // namespace

void describe_cycle(Visitor& v, coupling::CycleParams& b) {
  real_or_auto(v,
               {.name = "time",
                .meaning = "mean time from birth to division, in which the volume doubles",
                .dimension = kTime,
                .unit = "h",
                .range = kPositive,
                .symbol = "tau",
                .automatic = "these cells do not grow"},
               b.time);
  v.real({.name = "spread",
          .meaning = "relative standard deviation of the cycle time from cell to cell, Gaussian, "
                     "cut at 3 sigma",
          .range = {.low = 0, .high = 0.3}},
         b.spread);
  v.real({.name = "mitosis",
          .meaning = "time after division over which the rest shape of a deformable daughter "
                     "changes from its shape at division to a sphere; part of the cycle",
          .dimension = kTime,
          .unit = "h",
          .range = kPositive},
         b.mitosis);
  v.real({.name = "force_ramp",
          .meaning = "share of the cycle over which the forces between two new spheres rise",
          .range = {.low = 0, .high = 1, .low_open = true}},
         b.force_ramp);
  choice(v,
         {.name = "axis",
          .meaning = "direction in which a cell divides: random in space, random in the horizontal "
                     "plane, given by cycle.direction, or along the nearest vessel"},
         b.axis);
  v.when(b.axis == coupling::DivisionAxis::kGiven, "axis = given", [&b](Visitor& w) {
    w.vector({.name = "direction",
              .meaning = "direction in which the cells divide, of any length",
              .required = true},
             b.direction);
  });
  choice(v,
         {.name = "start",
          .meaning = "where in their cycle the first cells stand: just born, or uniformly spread",
          .choices = "birth|random",
          .affects = Affects::kStart},
         b.random_start);
}

void describe_inhibition(Visitor& v, coupling::Inhibition& b) {
  choice(v,
         {.name = "by",
          .meaning = "what slows growth down. pressure: rate times 1/(1 + (p/p0)^n), p the contact "
                     "pressure, 0 if negative; volume: rate times x^n/(1 + x^n), x = "
                     "(V/V0)/threshold, for DCM cells only, since spheres keep their volume; "
                     "density: rate times 1/(1 + (c/c0)^n), c the number of cells within 48 um "
                     "over the volume of that ball, images in mirror walls counted"},
         b.by);
  v.when(b.by == coupling::InhibitedBy::kPressure, "by = pressure", [&b](Visitor& w) {
    w.real(
        {.name = "pressure_threshold",
         .meaning = "contact pressure that halves the growth rate; contact pressures are 0.04 to "
                    "2.4 Pa in tissue that grows freely, 5 to 300 Pa in a capsule that shrinks",
         .dimension = kStress,
         .unit = "Pa",
         .range = kPositive,
         .required = true},
        b.threshold);
  });
  v.when(b.by == coupling::InhibitedBy::kDensity, "by = density", [&b](Visitor& w) {
    w.real({.name = "density_threshold",
            .meaning = "number of cells per volume that halves the growth rate",
            .dimension = kNumberDensity,
            .unit = "1/um^3",
            .range = kPositive,
            .required = true},
           b.threshold);
  });
  v.when(b.by == coupling::InhibitedBy::kVolume, "by = volume", [&b](Visitor& w) {
    w.real({.name = "volume_threshold",
            .meaning = "volume, relative to the volume at rest, that halves the growth rate",
            .range = {.low = 0, .high = 1, .low_open = true},
            .required = true},
           b.threshold);
  });
  v.real({.name = "power",
          .meaning = "how sharply growth stops at the threshold, Hill exponent",
          .range = {.low = 0, .high = 100, .low_open = true}},
         b.power);
}

void describe_death(Visitor& v, CellType& type) {
  coupling::DeathParams& b = type.cycle.death;
  choice(v,
         {.name = "mode",
          .meaning = "removal: the cell is gone at once; lysis: it shrinks before it is removed",
          .choices = "removal|lysis"},
         b.lysis);
  v.when(b.lysis, "mode = lysis", [&](Visitor& w) {
    w.real({.name = "duration",
            .meaning = "time of shrinking",
            .dimension = kTime,
            .unit = "h",
            .range = kPositive},
           b.duration);
    w.real({.name = "final_volume",
            .meaning = "share of its volume at which the cell is removed",
            .range = {.low = 0, .high = 1, .low_open = true, .high_open = true}},
           b.final_volume);
    w.real(
        {.name = "softening",
         .meaning =
             "factor on cortex_young, bulk_modulus and adhesion while it shrinks; of a sphere on "
             "adhesion only",
         .range = {.low = 0, .high = 1, .low_open = true}},
        type.softening);
  });
}

void describe_life(Visitor& v, LifeBlock& b) {
  blocks(v,
         {.name = "rules",
          .meaning = "which cells rest or die; all rules that hold for a cell count",
          .item = "life.rules"},
         b.rules, describe_rule);
  optional_block(v,
                 {.name = "proliferation",
                  .meaning = "cells rest until they enter the cycle, by their layer from the edge "
                             "of the lesion, and rest again after division; null = cells with a "
                             "cycle are always in it"},
                 b.proliferation, describe_proliferation);
  v.real({.name = "grid",
          .meaning = "time between two checks of rules, inhibition, sleep and meshes",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.grid);
  v.flag(
      {.name = "sleep",
       .meaning = "cells that do not grow and are in balance are left out of the step until they "
                  "are pushed"},
      b.sleep);
  v.real({.name = "sleep_traction",
          .meaning = "force out of balance per area below which a cell sleeps",
          .dimension = kStress,
          .unit = "Pa",
          .range = kPositive},
         b.sleep_traction);
  v.flag({.name = "remesh",
          .meaning = "the mesh of a cell whose triangles degenerate or fold is replaced by a sound "
                     "one on the same surface"},
         b.remesh);
}

}  // namespace acinus::runs
