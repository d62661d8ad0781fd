#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_lobule_shape(Visitor& v, LobuleBlock& b) {
  choice(v, {.name = "shape", .meaning = "one of six slices of the hexagon, or all of it"},
         b.shape);
  v.real({.name = "radius",
          .meaning = "distance from the axis to a corner",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_lob"},
         b.radius);
  v.real({.name = "height",
          .meaning = "height along the vein axis",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.height);
  v.real({.name = "lesion_radius",
          .meaning = "radius of the dead zone round the central vein",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_nec"},
         b.lesion_radius);
}

void describe_network_transform(Visitor& v, VesselBlock& b) {
  v.real({.name = "unit",
          .meaning = "length of one unit of the file",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.unit);
  v.real({.name = "scale", .meaning = "factor on positions and radii", .range = kPositive},
         b.scale);
  v.real({.name = "radius_scale", .meaning = "further factor on radii", .range = kPositive},
         b.radius_scale);
  v.vector({.name = "shift",
            .meaning = "displacement after scaling",
            .dimension = kLength,
            .unit = "um"},
           b.shift);
  v.flag({.name = "center",
          .meaning = "first move the middle of the network's bounding box to the origin"},
         b.center);
  v.box({.name = "crop",
         .meaning = "keep only segments with a part inside this box, given by its lowest and its "
                    "highest corner; null = all",
         .dimension = kLength,
         .unit = "um"},
        b.crop);
}

void describe_vessel_material(Visitor& v, VesselBlock& b) {
  v.real({.name = "young",
          .meaning = "Young's modulus of the vessels",
          .dimension = kStress,
          .unit = "Pa",
          .range = kPositive,
          .symbol = "E_sin"},
         b.young);
  v.real({.name = "poisson",
          .meaning = "Poisson ratio of the vessels",
          .range = {.low = 0, .high = 0.5},
          .symbol = "nu_sin"},
         b.poisson);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy between cell and vessel, per area",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W"},
         b.adhesion);
}

void describe_flexible_vessels(Visitor& v, VesselBlock& b) {
  v.real({.name = "wall_thickness",
          .meaning = "thickness of the wall; a vessel whose radius is no larger is solid",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.wall);
  v.real({.name = "pressure",
          .meaning = "pressure inside over that outside",
          .dimension = kStress,
          .unit = "Pa",
          .range = kNotNegative},
         b.pressure);
  v.real({.name = "friction",
          .meaning = "friction of vessels with the matrix, per area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive},
         b.friction);
  choice(v,
         {.name = "anchors",
          .meaning = "what holds them: ends, where a vessel begins or ends it neither moves nor "
                     "turns; none, they float"},
         b.anchors);
  v.optional_real({.name = "spacing",
                   .meaning = "longest segment: longer ones are cut in equal parts",
                   .dimension = kLength,
                   .unit = "um",
                   .range = kPositive,
                   .automatic = "segments stay as they are"},
                  b.spacing);
}

}  // namespace

void describe_lobule(Visitor& v, LobuleBlock& b) {
  describe_lobule_shape(v, b);
  v.real({.name = "central_vein_radius",
          .meaning = "radius of the central vein",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_cv"},
         b.central_vein_radius);
  v.real({.name = "portal_vein_radius",
          .meaning = "radius of the portal veins",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_pv"},
         b.portal_vein_radius);
  v.real({.name = "sinusoid_radius",
          .meaning = "radius of the sinusoids",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_sin"},
         b.sinusoid_radius);
  v.real({.name = "vessel_fraction",
          .meaning = "part of the volume taken by sinusoids",
          .range = {.low = 0, .high = 0.5}},
         b.vessel_fraction);
  v.real({.name = "branch_density",
          .meaning = "branch points of the sinusoids per volume",
          .dimension = kNumberDensity,
          .unit = "1/um^3",
          .range = kPositive},
         b.branch_density);
  v.real({.name = "min_distance",
          .meaning = "smallest distance of two cell centres at the start",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.min_distance);
  v.integer({.name = "cells",
             .meaning = "cells wanted outside the dead zone",
             .range = {.low = 1, .high = 1e6}},
            b.cells);
}

void describe_vessels(Visitor& v, VesselBlock& b) {
  v.text(
      {.name = "file",
       .meaning = "network file, relative to the scene's folder; \"\" = none, or the lobule's own",
       .is_file = true},
      b.file);
  v.text({.name = "radius_array",
          .meaning = "name of the array of radii in a VTK file; \"\" = one of the usual names"},
         b.radius_array);
  describe_network_transform(v, b);
  describe_vessel_material(v, b);
  choice(v,
         {.name = "contact",
          .meaning = "what cells touch: a round cone a segment, or one closed surface about all of "
                     "them, without the creases where cones meet",
          // It shapes a start as well, but both ways may be compared from one.
          .affects = Affects::kStep},
         b.contact);
  v.flag({.name = "flexible",
          .meaning = "true: vessels are elastic tubes that cells bend; false: they stand still"},
         b.flexible);
  v.when(b.flexible, "flexible = true", [&b](Visitor& w) { describe_flexible_vessels(w, b); });
}

void describe_wall(Visitor& v, WallEntry& b) {
  v.text({.name = "name",
          .meaning = "name in messages and files",
          .automatic = "wall and a number",
          .is_label = true},
         b.name);
  v.vector({.name = "point", .meaning = "a point of the wall", .dimension = kLength, .unit = "um"},
           b.point);
  v.vector({.name = "normal", .meaning = "direction to the side where the cells are"}, b.normal);
  v.real({.name = "speed",
          .meaning = "speed along the normal from t = 0",
          .dimension = kSpeed,
          .unit = "um/h"},
         b.speed);
  v.real({.name = "travel",
          .meaning = "distance after which the wall stops",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.travel);
  v.optional_real({.name = "opens",
                   .meaning = "when the wall vanishes and lets the cells go",
                   .dimension = kTime,
                   .unit = "h",
                   .range = kNotNegative,
                   .automatic = "never"},
                  b.opens);
  v.flag(
      {.name = "mirror",
       .meaning = "true: a symmetry plane that stands for equal cells on the other side, without "
                  "adhesion and friction; false: a plate with adhesion and friction of its own",
       .required = true},
      b.mirror);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy between cell and wall, per area; needs mirror = false",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W"},
         b.adhesion);
  v.when(!b.mirror, "mirror = false", [&b](Visitor& w) {
    w.optional_real({.name = "young",
                     .meaning = "Young's modulus of the wall as spheres feel it",
                     .dimension = kStress,
                     .unit = "Pa",
                     .range = kPositive,
                     .automatic = "rigid"},
                    b.young);
    w.real({.name = "poisson",
            .meaning = "Poisson ratio of the wall",
            .range = {.low = 0, .high = 0.5}},
           b.poisson);
  });
}

void describe_capsule(Visitor& v, CapsuleEntry& b) {
  v.vector(
      {.name = "center", .meaning = "centre of the capsule", .dimension = kLength, .unit = "um"},
      b.center);
  v.real({.name = "radius",
          .meaning = "inner radius at t = 0",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .required = true},
         b.radius);
  v.real({.name = "speed",
          .meaning = "rate at which the radius shrinks from t = 0",
          .dimension = kSpeed,
          .unit = "um/h",
          .range = kNotNegative},
         b.speed);
  v.real({.name = "min_radius",
          .meaning = "radius at which shrinking stops",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.min_radius);
  v.optional_real({.name = "opens",
                   .meaning = "when the capsule vanishes and lets the cells go",
                   .dimension = kTime,
                   .unit = "h",
                   .range = kNotNegative,
                   .automatic = "never"},
                  b.opens);
}

void describe_static_mesh(Visitor& v, StaticMeshEntry& b) {
  v.text({.name = "name",
          .meaning = "name in messages and files",
          .automatic = "mesh and a number",
          .is_label = true},
         b.name);
  v.text({.name = "file",
          .meaning = "surface file, relative to the scene's folder",
          .required = true,
          .is_file = true},
         b.file);
  v.real({.name = "unit",
          .meaning = "length of one unit of the file",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.unit);
  v.real({.name = "scale", .meaning = "factor on positions", .range = kPositive}, b.scale);
  v.vector({.name = "shift",
            .meaning = "displacement after scaling",
            .dimension = kLength,
            .unit = "um"},
           b.shift);
  v.flag({.name = "inside", .meaning = "true: the cells live inside the surface"}, b.inside);
}

}  // namespace acinus::runs
