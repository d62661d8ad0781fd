/// Registry: regions, and the zoom that moves.

#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

bool reaches(RegionKind kind) {
  return kind == RegionKind::kAxisDistance || kind == RegionKind::kFront ||
         kind == RegionKind::kCells || kind == RegionKind::kVessel;
}

/// Keys of regions with a shape of their own.
void describe_shape(Visitor& v, Region& b) {
  v.when(b.kind == RegionKind::kSphere, "kind = sphere", [&b](Visitor& w) {
    w.vector(
        {.name = "center", .meaning = "centre of the sphere", .dimension = kLength, .unit = "um"},
        b.center);
    w.real({.name = "radius",
            .meaning = "radius of the sphere",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive,
            .required = true},
           b.radius);
  });
  v.when(b.kind == RegionKind::kBox, "kind = box", [&b](Visitor& w) {
    w.vector({.name = "low",
              .meaning = "corner with the smallest coordinates",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.low);
    w.vector({.name = "high",
              .meaning = "corner with the largest coordinates",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.high);
  });
  v.when(b.kind == RegionKind::kHalfSpace, "kind = half_space", [&b](Visitor& w) {
    w.vector({.name = "point",
              .meaning = "a point of the bounding plane",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.point);
    w.vector({.name = "normal", .meaning = "direction out of the region", .required = true},
             b.normal);
  });
}

/// Keys of regions by the distance from the vein axis, cells or vessels.
void describe_distances(Visitor& v, Region& b) {
  v.when(b.kind == RegionKind::kAxisDistance, "kind = axis_distance", [&b](Visitor& w) {
    w.real({.name = "min_distance",
            .meaning = "smallest distance from the vein axis",
            .dimension = kLength,
            .unit = "um",
            .range = kNotNegative},
           b.min_distance);
  });
  v.when(reaches(b.kind), "kind = axis_distance, front, cells or vessel", [&b](Visitor& w) {
    w.real({.name = "max_distance",
            .meaning = "largest distance of a cell's centre from the vein axis, behind the edge of "
                       "the lesion, from the nearest of the cells followed, or from the surface of "
                       "a vessel",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive,
            .required = true},
           b.max_distance);
  });
}

/// Keys of regions that move with the tissue.
void describe_following(Visitor& v, Region& b) {
  v.when(b.kind == RegionKind::kCells, "kind = cells", [&b](Visitor& w) {
    w.integers({.name = "cells",
                .meaning = "lineage numbers of the cells that are followed, from 0 in the order of "
                           "the start",
                .range = kNotNegative,
                .required = true},
               b.cells);
    w.flag({.name = "offspring", .meaning = "their descendants are followed, too"}, b.offspring);
  });
  v.when(b.kind == RegionKind::kPressure, "kind = pressure", [&b](Visitor& w) {
    w.real({.name = "above",
            .meaning = "contact pressure at which a cell becomes deformable",
            .dimension = kStress,
            .unit = "Pa",
            .range = kPositive,
            .required = true},
           b.above);
    w.real({.name = "below",
            .meaning = "contact pressure at which it becomes a sphere again",
            .dimension = kStress,
            .unit = "Pa",
            .required = true},
           b.below);
  });
}

}  // namespace

void describe_region(Visitor& v, Region& b) {
  choice(v,
         {.name = "kind",
          .meaning = "shape of the region; a cell is in it with its centre",
          .required = true},
         b.kind);
  describe_shape(v, b);
  describe_distances(v, b);
  describe_following(v, b);
}

void describe_moving_zoom(Visitor& v, MovingZoomBlock& b) {
  v.real({.name = "every",
          .meaning = "time between two looks at the regions",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.grid);
  v.real({.name = "margin",
          .meaning = "how far a deformable cell may be outside all regions before it becomes a "
                     "sphere; at least a cell diameter",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.margin);
  v.real({.name = "stay",
          .meaning = "time for which a cell keeps a model it took",
          .dimension = kTime,
          .unit = "min",
          .range = kNotNegative},
         b.stay);
  v.real({.name = "fade",
          .meaning = "time in which forces fade that a pair of cells exerted before one of them "
                     "changed its model, and does not exert now",
          .dimension = kTime,
          .unit = "min",
          .range = kPositive},
         b.fade);
  v.integer({.name = "at_once",
             .meaning = "cells that change at one look, at most",
             .range = {.low = 1, .high = 1e6}},
            b.at_once);
  v.integer({.name = "most_deformable",
             .meaning = "no cell becomes deformable beyond this number; 0 = no limit",
             .range = {.low = 0, .high = 1e9}},
            b.most_deformable);
}

}  // namespace acinus::runs
