#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_force_at(Visitor& v, Schedule::Point& b) {
  v.real({.name = "time", .meaning = "time after t = 0", .dimension = kTime, .unit = "s"}, b.time);
  v.real({.name = "force",
          .meaning = "force then; it runs straight from one entry to the next, and two entries of "
                     "one time are a jump",
          .dimension = kForce,
          .unit = "nN",
          .required = true},
         b.value);
}

void describe_displacement_at(Visitor& v, Schedule::Point& b) {
  v.real({.name = "time", .meaning = "time after t = 0", .dimension = kTime, .unit = "s"}, b.time);
  v.real({.name = "displacement",
          .meaning = "how far it has moved then; it runs straight from one entry to the next, and "
                     "two entries of one time are a jump",
          .dimension = kLength,
          .unit = "um",
          .required = true},
         b.value);
}

}  // namespace

void describe_pull(Visitor& v, PullEntry& b) {
  v.integer({.name = "cell",
             .meaning = "which cell of cells.list, from 0; the pull ends when it divides or dies",
             .range = kNotNegative},
            b.cell);
  v.vector({.name = "direction", .meaning = "direction of the force and of the displacement"},
           b.direction);
  choice(v,
         {.name = "by",
          .meaning = "force: a prescribed one, spread over the cell; spring: one that holds the "
                     "cell's centre along the direction and whose far end moves"},
         b.by);
  v.when(b.by == PullBy::kForce, "by = force", [&b](Visitor& w) {
    blocks(w, {.name = "force", .meaning = "force over time", .item = "force"}, b.force.entry,
           describe_force_at);
  });
  v.when(b.by == PullBy::kSpring, "by = spring", [&b](Visitor& w) {
    w.real({.name = "stiffness",
            .meaning = "stiffness of the spring",
            .dimension = kTension,
            .unit = "N/m",
            .range = kPositive,
            .required = true},
           b.stiffness);
    blocks(w,
           {.name = "displacement",
            .meaning = "displacement of the far end over time, from where the cell's position in "
                       "cells.list is; none = it stays there",
            .item = "displacement"},
           b.displacement.entry, describe_displacement_at);
  });
}

}  // namespace acinus::runs
