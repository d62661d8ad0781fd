#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

constexpr Key kForceThen{
    .name = "force", .meaning = "force then", .dimension = kForce, .unit = "nN", .required = true};

constexpr Key kDisplacementThen{.name = "displacement",
                                .meaning = "how far it has moved then",
                                .dimension = kLength,
                                .unit = "um",
                                .required = true};

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
           describe_course_point<kForceThen>);
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
           b.displacement.entry, describe_course_point<kDisplacementThen>);
  });
}

}  // namespace acinus::runs
