#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_cortex(Visitor& v, DcmBlock& b) {
  v.integer({.name = "nodes",
             .meaning = "nodes of the cell's surface mesh",
             .choices = "42|92|162|252|362|642|1442|2562",
             .symbol = "N",
             .in_law = InLaw::kDcm,
             .law_name = "nodes"},
            b.nodes);
  v.real({.name = "cortex_young",
          .meaning = "Young's modulus of the cortex",
          .dimension = kStress,
          .unit = "kPa",
          .range = kNotNegative,
          .symbol = "E_cor",
          .softens = true,
          .in_law = InLaw::kDcm,
          .law_name = "cortex_young_kPa"},
         b.cortex_young);
  v.real({.name = "cortex_thickness",
          .meaning = "thickness of the cortex",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "h_cor",
          .in_law = InLaw::kDcm,
          .law_name = "cortex_thickness_um"},
         b.cortex_thickness);
  v.real({.name = "cortex_poisson",
          .meaning = "Poisson ratio of the cortex",
          .range = {.low = 0, .high = 0.5},
          .symbol = "nu_cor",
          .in_law = InLaw::kDcm,
          .law_name = "cortex_poisson"},
         b.cortex_poisson);
}

void describe_dcm_friction(Visitor& v, DcmBlock& b) {
  v.real({.name = "nodal_friction",
          .meaning = "friction between neighbouring nodes of a cell",
          .dimension = kFriction,
          .unit = "N s/m",
          .range = kNotNegative,
          .symbol = "gamma_int",
          .affects = Affects::kStep},
         b.nodal_friction);
  v.real({.name = "nodal_friction_across",
          .meaning = "that friction across the edge of two nodes over that along it; 1 = the same "
                     "in all directions, 0 = only along, which lets a cell turn freely",
          .range = kNotNegative,
          .affects = Affects::kStep},
         b.friction_across);
  v.real(
      {.name = "series_friction",
       .meaning = "dashpot in series with the springs of the cortex, which then flow and have no "
                  "length at rest; 0 = none",
       .dimension = kFriction,
       .unit = "N s/m",
       .range = kNotNegative,
       .symbol = "gamma_ME"},
      b.series_friction);
  v.real({.name = "ecm_friction",
          .meaning = "friction of a DCM cell with the matrix, per area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive,
          .symbol = "gamma_ECM+",
          .affects = Affects::kStep},
         b.medium_friction);
}

void describe_dcm(Visitor& v, DcmBlock& b) {
  describe_cortex(v, b);
  v.real({.name = "area_modulus",
          .meaning = "resistance of the whole surface to area change",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative,
          .symbol = "K_A",
          .in_law = InLaw::kDcm,
          .law_name = "area_modulus_nN_per_um"},
         b.area_modulus);
  v.real({.name = "local_area_modulus",
          .meaning = "resistance of each triangle to area change; keeps the mesh regular",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative,
          .in_law = InLaw::kDcm,
          .law_name = "local_area_modulus_nN_per_um"},
         b.local_area_modulus);
  v.real({.name = "cortex_tension",
          .meaning = "active tension of the whole surface, which does not depend on its area; 0 = "
                     "none",
          .dimension = kTension,
          .unit = "N/m",
          .range = kNotNegative,
          .softens = true,
          .in_law = InLaw::kDcm,
          .law_name = "cortex_tension_nN_per_um"},
         b.cortex_tension);
  optional_block(v,
                 {.name = "contraction",
                  .meaning = "how that tension varies over time and over the surface; null = it "
                             "does not"},
                 b.contraction, describe_contraction);
  v.real({.name = "bulk_modulus",
          .meaning = "resistance of the cell to volume change",
          .dimension = kStress,
          .unit = "Pa",
          .range = kNotNegative,
          .symbol = "K_V",
          .softens = true,
          .in_law = InLaw::kDcm,
          .law_name = "bulk_modulus_kPa"},
         b.bulk_modulus);
  describe_dcm_friction(v, b);
  optional_block(v,
                 {.name = "nucleus",
                  .meaning = "a second surface inside the cell; null = none. Spheres have none"},
                 b.nucleus, describe_nucleus);
}

void describe_cbm(Visitor& v, CbmBlock& b) {
  real_or_auto(v,
               {.name = "young",
                .meaning = "Young's modulus of the sphere",
                .dimension = kStress,
                .unit = "Pa",
                .range = kPositive,
                .symbol = "E",
                .automatic = "3 K_V (1 - 2 nu)",
                .in_law = InLaw::kCbm,
                .law_name = "young_kPa"},
               b.young);
  v.real({.name = "young_spread",
          .meaning = "relative standard deviation of the modulus from cell to cell, cut at 3 sigma",
          .range = {.low = 0, .high = 0.3}},
         b.young_spread);
  v.real({.name = "poisson",
          .meaning = "Poisson ratio of the sphere",
          .range = {.low = 0, .high = 0.5, .high_open = true},
          .symbol = "nu",
          .in_law = InLaw::kCbm,
          .law_name = "poisson"},
         b.poisson);
  v.real({.name = "ecm_friction",
          .meaning = "friction of a CBM cell with the matrix, per area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kPositive,
          .symbol = "gamma_ECM+",
          .affects = Affects::kStep},
         b.medium_friction);
  v.text({.name = "stiffness_correction",
          .meaning = "law by which the modulus grows with the overlap: a file `acinus calibrate` "
                     "wrote, relative to the scene's folder, or the name of a shipped law; auto: a "
                     "shipped law of this cell type, else calibrate, once; paper: E + 4e6 Pa d^4 "
                     "with the mean overlap d of the contacts, too stiff "
                     "where cells have few neighbours",
          .choices = "none|auto|paper",
          .symbol = "E~",
          .is_file = true,
          .shipped = "laws"},
         b.stiffness_correction);
  v.flag({.name = "single_overlaps",
          .meaning = "with a law file: a neighbour pressed in deeper than the law was found for "
                     "stiffens the sphere toward it; false: only all overlaps together count"},
         b.single_overlaps);
}

void describe_cell(Visitor& v, CellEntry& b) {
  v.vector({.name = "position",
            .meaning = "centre of the cell",
            .dimension = kLength,
            .unit = "um",
            .required = true},
           b.position);
  v.text({.name = "type", .meaning = "name of its cell type", .automatic = "the only type"},
         b.type);
  v.optional_real({.name = "radius",
                   .meaning = "radius at rest of this cell",
                   .dimension = kLength,
                   .unit = "um",
                   .range = kPositive,
                   .automatic = "the radius of its type"},
                  b.radius);
  choice(v,
         {.name = "model",
          .meaning = "model of this cell",
          .choices = "dcm|cbm",
          .automatic = "as cells.model and zoom say"},
         b.model);
  v.flag(
      {.name = "random_orientation",
       .meaning = "the mesh of a DCM cell is turned at random, as the seed says; false = as it is"},
      b.random_orientation);
  v.vector({.name = "pull",
            .meaning = "constant force spread over the cell; its daughters share it",
            .dimension = kForce,
            .unit = "nN"},
           b.pull);
}

void describe_type_share(Visitor& v, TypeShare& b) {
  v.text({.name = "type", .meaning = "name of a cell type", .required = true}, b.type);
  v.real({.name = "share",
          .meaning = "how often, against the other types for the same place",
          .range = kPositive},
         b.share);
  optional_block(v,
                 {.name = "region",
                  .meaning = "cells in it are of its types; null = cells that are in no region"},
                 b.region, describe_region);
}

void describe_packing(Visitor& v, CellsBlock& b) {
  v.integer({.name = "count",
             .meaning = "cells of a clump (nearest to its centre first) or of a filled box",
             .range = {.low = 1, .high = 1e6}},
            b.count);
  choice(v, {.name = "lattice", .meaning = "packing of a clump"}, b.lattice);
  v.real({.name = "spacing",
          .meaning = "centre distance in a clump or box, in diameters of its largest cell type",
          .range = {.low = 0, .high = 100, .low_open = true}},
         b.spacing);
  v.real({.name = "jitter",
          .meaning = "random displacement in a clump or box, in the same diameters",
          .range = kFraction},
         b.jitter);
  v.counts({.name = "grid",
            .meaning = "cells of a box along x, y and z",
            .range = {.low = 1, .high = 1000}},
           b.grid);
}

void describe_fill(Visitor& v, CellsBlock& b) {
  v.when(b.source == CellSource::kFill, "source = fill", [&b](Visitor& w) {
    w.vector({.name = "low",
              .meaning = "low corner of the box that random cells fill",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.low);
    w.vector({.name = "high",
              .meaning = "high corner of the box that random cells fill",
              .dimension = kLength,
              .unit = "um",
              .required = true},
             b.high);
    w.real({.name = "min_distance",
            .meaning = "smallest centre distance of random cells",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive},
           b.min_distance);
  });
}

void describe_cell_meshes(Visitor& v, CellsBlock& b) {
  v.when(b.source == CellSource::kMeshes, "source = meshes", [&b](Visitor& w) {
    w.text(
        {.name = "file",
         .meaning = "surface file, relative to the scene's folder: every closed surface in it is "
                    "the shape of one cell, its volume that of the cell",
         .required = true,
         .is_file = true},
        b.file);
    w.real({.name = "unit",
            .meaning = "length of one unit of the file",
            .dimension = kLength,
            .unit = "um",
            .range = kPositive},
           b.unit);
  });
}

void describe_pair_adhesion(Visitor& v, PairAdhesion& b) {
  v.text({.name = "type", .meaning = "name of the other cell type", .required = true}, b.type);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy per area between the two types",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W",
          .required = true},
         b.adhesion);
}

}  // namespace

void describe_cell_type(Visitor& v, CellType& b) {
  v.real({.name = "radius",
          .meaning = "radius at rest, (3 V0 / 4 pi)^(1/3)",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_c",
          .in_law = InLaw::kBoth,
          .law_name = "radius_um"},
         b.radius);
  v.real({.name = "adhesion",
          .meaning = "adhesion energy per area of cells of this type; a pair of types has the "
                     "geometric mean, unless adhesion_with says otherwise",
          .dimension = kTension,
          .unit = "J/m^2",
          .range = kNotNegative,
          .symbol = "W",
          .softens = true,
          .in_law = InLaw::kBoth,
          .law_name = "adhesion_nN_per_um"},
         b.adhesion);
  blocks(v,
         {.name = "adhesion_with",
          .meaning = "adhesion energies with other types, each given at one of the two",
          .item = "cell.adhesion_with"},
         b.adhesion_with, describe_pair_adhesion);
  v.real({.name = "diffusion",
          .meaning = "diffusion coefficient of the random motion",
          .dimension = kDiffusion,
          .unit = "m^2/s",
          .range = kNotNegative,
          .symbol = "D",
          .affects = Affects::kStep},
         b.diffusion);
  block(v,
        {.name = "cycle",
         .meaning = "growth to twice the volume and division",
         .affects = Affects::kAges},
        b.cycle, describe_cycle);
  block(v, {.name = "inhibition", .meaning = "what slows growth down", .affects = Affects::kStep},
        b.cycle.inhibition, describe_inhibition);
  block(v,
        {.name = "death",
         .meaning = "mode of death of cells that life.rules or rules kill",
         .affects = Affects::kStep},
        b, describe_death);
  blocks(v,
         {.name = "exchange",
          .meaning = "what cells of this type secrete and take up",
          .item = "cell.exchange",
          .affects = Affects::kStep},
         b.exchange, describe_exchange);
  block(v, {.name = "dcm", .meaning = "the cell as a deformable triangulated surface"}, b.dcm,
        describe_dcm);
  block(v, {.name = "cbm", .meaning = "the cell as an elastic sphere", .compared = false}, b.cbm,
        describe_cbm);
}

void describe_cells(Visitor& v, CellsBlock& b) {
  choice(v,
         {.name = "source",
          .meaning = "where the cells come from. list: one by one; clump: a ball cut from a "
                     "lattice round the origin; box: a cubic lattice round the origin; fill: "
                     "random places in a box; lobule: between the sinusoids of the lobule; "
                     "meshes: closed surfaces of a file"},
         b.source);
  choice(v,
         {.name = "model",
          .meaning = "model of the cells; zoom: DCM inside the zoom regions, spheres elsewhere",
          .automatic = "zoom with zoom regions, dcm without",
          .compared = false},
         b.model);
  blocks(v, {.name = "list", .meaning = "cells one by one (source = list)", .item = "cells.list"},
         b.list, describe_cell);
  blocks(v,
         {.name = "types",
          .meaning = "which cells are of which type, drawn by shares and by region, where they are "
                     "not listed one by one; [] = all of the only type",
          .item = "cells.types"},
         b.types, describe_type_share);
  describe_packing(v, b);
  describe_fill(v, b);
  describe_cell_meshes(v, b);
}

}  // namespace acinus::runs
