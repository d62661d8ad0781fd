#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_friction_of_contacts(Visitor& v, Scene& s) {
  FrictionBlock& b = s.friction;
  v.real({.name = "dcm_dcm",
          .meaning = "friction between two DCM cells, per contact area",
          .dimension = kFrictionPerArea,
          .unit = "N s/m^3",
          .range = kNotNegative,
          .symbol = "gamma_ext+"},
         s.contact.cell_friction);
  v.optional_real({.name = "cbm_cbm",
                   .meaning = "friction between two CBM cells, per contact area",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .symbol = "gamma_ext+",
                   .automatic = "1e10 N s/m^3; with a calibrated law its friction share times "
                                "dcm_dcm",
                   .compared = false},
                  b.cbm_cbm);
  v.optional_real({.name = "dcm_cbm",
                   .meaning = "friction between a DCM and a CBM cell",
                   .dimension = kFrictionPerArea,
                   .unit = "N s/m^3",
                   .range = kNotNegative,
                   .automatic = "harmonic mean of dcm_dcm and cbm_cbm",
                   .compared = false},
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
                   .automatic = "the type's cbm.ecm_friction",
                   .compared = false},
                  b.cbm_vessel);
}

}  // namespace

void describe_friction(Visitor& v, Scene& s) {
  describe_friction_of_contacts(v, s);
  choice(v,
         {.name = "form",
          .meaning = "where dcm_dcm acts. surface: between facing points of two surfaces; nodes: "
                     "between all pairs of nodes of two triangles that touch (the published form, "
                     "which adds a viscosity that depends on the mesh)"},
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

}  // namespace acinus::runs
