#include "dcm/contact/contact_params.hpp"

#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_law(Visitor& v, ContactBlock& b) {
  choice(
      v,
      {.name = "law",
       .meaning = "force between a DCM cell and what it touches: cohesive potential of the gap at "
                  "contact points, or the paper's law between the spheres of triangles, slower"},
      b.law);
  v.when(b.law == dcm::ContactLaw::kMaugisDugdale, "law = maugis-dugdale", [&b](Visitor& w) {
    w.real({.name = "h0",
            .meaning = "range of adhesion; the adhesive stress is adhesion / h0",
            .dimension = kLength,
            .unit = "nm",
            .range = {.low = 1e-3, .high = 1},
            .symbol = "h_0"},
           b.cohesive_range);
    w.real({.name = "modulus",
            .meaning = "reduced modulus of two surfaces, large against that of a cell so that they "
                       "do not pass through each other",
            .dimension = kStress,
            .unit = "kPa",
            .range = kPositive,
            .symbol = "E^"},
           b.modulus);
    w.real(
        {.name = "max_radius",
         .meaning = "limit of the reduced radius of two surfaces, which flat and fitting surfaces "
                    "have; the overlap of a flat contact under a pressure is proportional to it",
         .dimension = kLength,
         .unit = "um",
         .range = kPositive},
        b.max_radius);
  });
}

}  // namespace

void describe_contact(Visitor& v, ContactBlock& b) {
  describe_law(v, b);
  choice(v,
         {.name = "quadrature",
          .meaning = "contact points: three in each triangle, the nodes, or the nodes and the "
                     "middles of edges",
          .in_law = InLaw::kSetting},
         b.quadrature);
  v.real({.name = "repulsion",
          .meaning = "stiffness against overlap, pressure per depth",
          .dimension = kStiffnessPerArea,
          .unit = "kPa/um",
          .range = kPositive,
          .in_law = InLaw::kDcm,
          .law_name = "contact_repulsion_kPa_per_um"},
         b.repulsion);
  real_or_auto(v,
               {.name = "range",
                .meaning = "range of adhesion in mean reference edge lengths",
                .range = {.low = 0, .high = 2, .low_open = true},
                .symbol = "h_0",
                .automatic = "0.3 for 3-point, 0.5 for nodes, 0.35 for nodes-and-edges",
                .in_law = InLaw::kSetting},
               b.range_factor);
  v.real({.name = "max_depth",
          .meaning = "deepest overlap a contact point looks for",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .in_law = InLaw::kSetting},
         b.max_depth);
  v.real({.name = "skin",
          .meaning = "margin of the neighbour lists",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive},
         b.skin);
}

}  // namespace acinus::runs
