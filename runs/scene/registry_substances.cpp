/// Registry: substances, their exchange with cells, and the responses of cells.

#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

using substances::FaceKind;

void describe_face(Visitor& v, substances::FaceCondition& b) {
  choice(v,
         {.name = "kind",
          .meaning = "no_flux: nothing passes; fixed: the concentration at the face is value; "
                     "exchange: the flux into the box is coefficient x (value - concentration)"},
         b.kind);
  v.when(b.kind != FaceKind::kNoFlux, "kind = fixed, exchange", [&b](Visitor& w) {
    w.real({.name = "value",
            .meaning = "concentration at the face or beyond it",
            .range = kNotNegative,
            .required = true},
           b.value);
  });
  v.when(b.kind == FaceKind::kExchange, "kind = exchange", [&b](Visitor& w) {
    w.real({.name = "coefficient",
            .meaning = "coefficient of exchange, the permeability of the face",
            .dimension = kSpeed,
            .unit = "um/s",
            .range = kPositive,
            .required = true},
           b.coefficient);
  });
}

void describe_face_entry(Visitor& v, FaceEntry& b) {
  choice(v, {.name = "side", .meaning = "face of the box", .required = true}, b.side);
  describe_face(v, b);
}

void describe_secretion(Visitor& v, double& secretion, double& saturation) {
  v.real({.name = "secretion",
          .meaning = "concentration secreted per time into the volume of the source",
          .dimension = kRate,
          .unit = "1/s",
          .range = kNotNegative},
         secretion);
  real_or_auto(v,
               {.name = "saturation",
                .meaning = "concentration at which secretion ends: its rate is secretion x "
                           "(1 - c / saturation)",
                .range = kPositive,
                .automatic = "secretion does not depend on the concentration"},
               saturation);
}

void describe_source(Visitor& v, SourceEntry& b) {
  block(v, {.name = "region", .meaning = "voxels with their centre in it are sources"}, b.region,
        describe_region);
  describe_secretion(v, b.secretion, b.saturation);
}

void describe_vessel_feed(Visitor& v, VesselFeed& b) {
  v.real({.name = "concentration",
          .meaning = "concentration in the blood",
          .range = kNotNegative,
          .required = true},
         b.concentration);
  v.real({.name = "permeability",
          .meaning = "flux through the wall per area and difference of concentration",
          .dimension = kSpeed,
          .unit = "um/s",
          .range = kPositive,
          .required = true},
         b.permeability);
}

constexpr Key kSupplyThen{
    .name = "factor", .meaning = "factor at this time", .range = kNotNegative, .required = true};

}  // namespace

void describe_substance(Visitor& v, SubstanceBlock& b) {
  v.text({.name = "name", .meaning = "name of the substance", .required = true, .is_name = true},
         b.name);
  v.text({.name = "unit",
          .meaning = "unit of its concentrations, for files and plots: all concentrations of the "
                     "scene are numbers in it"},
         b.unit);
  v.real({.name = "diffusion",
          .meaning = "diffusion coefficient in the tissue",
          .dimension = kDiffusion,
          .unit = "um^2/s",
          .range = kNotNegative,
          .required = true},
         b.diffusion);
  v.real({.name = "decay",
          .meaning = "rate of decay everywhere",
          .dimension = kRate,
          .unit = "1/s",
          .range = kNotNegative},
         b.decay);
  v.real({.name = "initial", .meaning = "concentration at t = 0", .range = kNotNegative},
         b.initial);
  block(v, {.name = "boundary", .meaning = "condition at the faces of the box"}, b.boundary,
        describe_face);
  blocks(v,
         {.name = "faces",
          .meaning = "faces of the box with a condition of their own",
          .item = "substance.faces"},
         b.faces, describe_face_entry);
  blocks(v,
         {.name = "sources",
          .meaning = "sources that stay in place, besides cells and vessels",
          .item = "substance.sources"},
         b.sources, describe_source);
  blocks(v,
         {.name = "course",
          .meaning = "factor on the concentrations at faces and in vessels and on the secretion of "
                     "sources, over time; [] = 1",
          .item = "substance.course"},
         b.course.entry, describe_course_point<kSupplyThen>);
  optional_block(
      v, {.name = "vessels", .meaning = "exchange with vessels, along their walls; null = none"},
      b.vessels, describe_vessel_feed);
  choice(v,
         {.name = "cells",
          .meaning = "pass: it diffuses through cells; keep_out: around them only. Concentrations "
                     "are then those of the space between cells, which exchange it through their "
                     "surface. membrane: also inside cells, through membranes with a permeability; "
                     "cells exchange it inside"},
         b.cells);
  v.when(b.cells == CellPassage::kMembrane, "cells = membrane", [&b](Visitor& w) {
    w.real({.name = "permeability",
            .meaning = "of the membranes of cells: flux per area and difference of concentration",
            .dimension = kSpeed,
            .unit = "um/s",
            .range = kPositive,
            .required = true},
           b.permeability);
  });
  choice(v,
         {.name = "obstacles",
          .meaning = "pass: it diffuses through walls, vessels and static meshes; keep_out: around "
                     "them only. Vessels that supply it do so through their walls",
          .choices = "pass|keep_out"},
         b.outside_obstacles);
}

void describe_substance_grid(Visitor& v, SubstanceGridBlock& b) {
  real_or_auto(
      v,
      {.name = "spacing",
       .meaning = "longest edge of a voxel; at most the diameter of the smallest cell type",
       .dimension = kLength,
       .unit = "um",
       .range = kPositive,
       .automatic = "the radius of the smallest cell type"},
      b.spacing);
  v.box(
      {.name = "box",
       .meaning = "lowest and highest corner of the box of the fields; null = around the cells at "
                  "t = 0, vessels and lobule, with the margin",
       .dimension = kLength,
       .unit = "um"},
      b.box);
  v.real({.name = "margin",
          .meaning = "space between the cells and the faces of a box that is not given or grows; "
                     "walls along the axes end it",
          .dimension = kLength,
          .unit = "um",
          .range = kNotNegative},
         b.margin);
  v.flag({.name = "grow",
          .meaning = "the box grows with the tissue, by voxels with the concentration outside, so "
                     "that the margin stays. Faces where a substance has no_flux stay in place"},
         b.grow);
  real_or_auto(v,
               {.name = "step",
                .meaning = "longest step of the fields: the error in time is proportional to it",
                .dimension = kTime,
                .unit = "s",
                .range = kPositive,
                .automatic = "the step of the tissue"},
               b.step);
  v.real({.name = "tolerance",
          .meaning = "residual of the fields' solver, relative to the right-hand side",
          .range = {.low = 0, .high = 1e-2, .low_open = true}},
         b.tolerance);
}

void describe_exchange(Visitor& v, ExchangeEntry& b) {
  v.text({.name = "substance", .meaning = "name of the substance", .required = true}, b.substance);
  describe_secretion(v, b.secretion, b.saturation);
  v.real({.name = "uptake",
          .meaning = "uptake per concentration, within the volume of the cell",
          .dimension = kRate,
          .unit = "1/s",
          .range = kNotNegative},
         b.uptake);
  v.real({.name = "uptake_max",
          .meaning = "largest rate of Michaelis-Menten uptake, concentration per time: the rate is "
                     "uptake_max x c / (half_max + c)",
          .dimension = kRate,
          .unit = "1/s",
          .range = kNotNegative},
         b.uptake_max);
  v.when(b.uptake_max > 0, "uptake_max > 0", [&b](Visitor& w) {
    w.real({.name = "half_max",
            .meaning = "concentration at which that uptake is half of its largest rate",
            .range = kPositive,
            .required = true},
           b.half_max);
  });
  v.real({.name = "secretion_per_area",
          .meaning = "concentration x length secreted per time by the surface of the cell",
          .dimension = kSpeed,
          .unit = "um/s",
          .range = kNotNegative},
         b.secretion_per_area);
  v.real({.name = "uptake_per_area",
          .meaning = "uptake per concentration by the surface of the cell",
          .dimension = kSpeed,
          .unit = "um/s",
          .range = kNotNegative},
         b.uptake_per_area);
}

namespace {

using coupling::Signal, coupling::Behaviour;

constexpr Dimension kArea{2, 0, 0}, kVolume{3, 0, 0};

/// Key of the half-maximum, in the unit of the signal.
Key half_max_of(Signal signal) {
  Key key{.name = "half_max",
          .meaning =
              "signal of half the response: a concentration, or for pressure \"200 Pa\", "
              "volume \"9000 um^3\", contact_area \"600 um^2\", age \"5 h\", neighbours 6, "
              "layer 2",
          .any_unit = true,
          .range = kPositive,
          .required = true};
  const auto set = [&key](Dimension dimension, const char* unit) {
    key.dimension = dimension;
    key.unit = unit;
  };
  switch (signal) {
    case Signal::kPressure:
      set(kStress, "Pa");
      break;
    case Signal::kVolume:
      set(kVolume, "um^3");
      break;
    case Signal::kContactArea:
      set(kArea, "um^2");
      break;
    case Signal::kAge:
      set(kTime, "h");
      break;
    case Signal::kConcentration:
    case Signal::kNeighbours:
    case Signal::kLayer:
      break;
  }
  return key;
}

void describe_signal(Visitor& v, SignalRuleEntry& b) {
  v.text(
      {.name = "signal",
       .meaning =
           "what cells respond to: the name of a substance, or of a quantity of the cell itself. "
           "pressure: contact pressure, as in /cells; volume: present one of the mesh, of a sphere "
           "that of its radius; contact_area: area of its surface in contact with other living "
           "cells; neighbours: number of living cells that it touches; layer: layer of cells "
           "behind the edge of a lesion around axis_point, 1 at the edge, from distances of one "
           "diameter; age: time since its birth, of initial cells since t = 0. All but "
           "concentration and age are those of the last check (life.grid)",
       .required = true},
      b.name);
  const int own = choice_index(kChoices<Signal>, b.name);
  b.signal = own > 0 ? static_cast<Signal>(own) : Signal::kConcentration;
  v.when(b.signal == Signal::kNeighbours || b.signal == Signal::kContactArea,
         "signal = neighbours, contact_area", [&b](Visitor& w) {
           w.text({.name = "neighbour_type",
                   .meaning = "cell type of the other cells that count; \"\" = all"},
                  b.other);
         });
}

}  // namespace

void describe_signal_rule(Visitor& v, SignalRuleEntry& b) {
  describe_signal(v, b);
  choice(
      v,
      {.name = "behaviour",
       .meaning = "what responds. growth: factor on the rate of growth, 0 = rest; death: rate at "
                  "which cells die as cell.death says; motility: factor on cell.diffusion; "
                  "chemotaxis: force along the gradient; secretion, uptake: factor on these rates "
                  "of cell.exchange with a substance; adhesion: factor on the adhesion energy with "
                  "other cells, of a pair the geometric mean of both",
       .required = true},
      b.behaviour);
  choice(v,
         {.name = "direction",
          .meaning =
              "increases: the response to the signal s is s^power / (half_max^power + s^power); "
              "decreases: 1 minus it; a negative signal counts as 0",
          .choices = "increases|decreases"},
         b.decreases);
  v.text({.name = "cell_type", .meaning = "cell type that responds; \"\" = all"}, b.cell_type);
  v.real(half_max_of(b.signal), b.half_max);
  v.real({.name = "power",
          .meaning = "steepness of the response; a large one makes half_max a threshold",
          .range = {.low = 0, .high = 1000, .low_open = true}},
         b.power);
  const bool exchanges = b.behaviour == Behaviour::kSecretion || b.behaviour == Behaviour::kUptake;
  v.when(exchanges || b.behaviour == Behaviour::kChemotaxis,
         "behaviour = secretion, uptake or chemotaxis", [&b](Visitor& w) {
           w.text({.name = "of",
                   .meaning = "name of the substance that is secreted or taken up, or whose "
                              "gradient leads; \"\" = the signal, for chemotaxis only"},
                  b.exchanged);
         });
  v.when(b.behaviour == Behaviour::kDeath, "behaviour = death", [&b](Visitor& w) {
    w.real({.name = "rate",
            .meaning = "rate of death at full response",
            .dimension = kRate,
            .unit = "1/h",
            .range = kPositive,
            .required = true},
           b.rate);
  });
  v.when(b.behaviour == Behaviour::kChemotaxis, "behaviour = chemotaxis", [&b](Visitor& w) {
    w.real({.name = "force",
            .meaning = "force up the gradient at full response; negative: down",
            .dimension = kForce,
            .unit = "nN",
            .required = true},
           b.force);
    w.real({.name = "sensitivity",
            .meaning = "relative difference of concentration across the cell at which the "
                       "force is half of its largest",
            .range = kPositive},
           b.sensitivity);
  });
}

}  // namespace acinus::runs
