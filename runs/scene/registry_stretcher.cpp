#include "runs/scene/registry_blocks.hpp"

namespace acinus::runs {
namespace {

void describe_pulse(Visitor& v, coupling::Pulse& b) {
  v.real({.name = "from",
          .meaning = "when the beams go on, after t = 0",
          .dimension = kTime,
          .unit = "s",
          .range = kNotNegative},
         b.from);
  v.real({.name = "to",
          .meaning = "when they go off",
          .dimension = kTime,
          .unit = "s",
          .range = kPositive},
         b.to);
}

constexpr Key kTemperatureThen{.name = "value",
                               .meaning = "temperature then",
                               .dimension = kTemperature,
                               .unit = "K",
                               .range = kPositive,
                               .required = true};

}  // namespace

void describe_stretcher(Visitor& v, coupling::Stretcher& b) {
  v.real({.name = "power",
          .meaning = "power of each of the two beams",
          .dimension = kPower,
          .unit = "W",
          .range = kPositive,
          .symbol = "P_0",
          .required = true},
         b.beams.power);
  v.real({.name = "beam_radius",
          .meaning = "radius of the beams where the cell is",
          .dimension = kLength,
          .unit = "um",
          .range = kPositive,
          .symbol = "R_b"},
         b.beams.radius);
  v.real({.name = "medium_index",
          .meaning = "refractive index of the liquid",
          .range = {.low = 1, .high = 4},
          .symbol = "n_m"},
         b.beams.medium);
  v.real({.name = "cell_index",
          .meaning = "refractive index of the cell",
          .range = {.low = 1, .high = 4},
          .symbol = "n_c"},
         b.beams.cell);
  v.vector({.name = "axis", .meaning = "direction of the beams"}, b.axis);
  v.real({.name = "exponent",
          .meaning = "the stress falls with this power of the cosine of the angle to the axis",
          .range = {.low = 0, .high = 20},
          .symbol = "n"},
         b.exponent);
  blocks(v, {.name = "pulses", .meaning = "when the beams shine", .item = "pulse"}, b.pulse,
         describe_pulse);
}

void describe_temperature(Visitor& v, coupling::Temperature& b) {
  v.real({.name = "activation",
          .meaning = "activation energy of the friction within the cortex (nodal_friction, "
                     "series_friction)",
          .dimension = kMolarEnergy,
          .unit = "kJ/mol",
          .range = kNotNegative,
          .symbol = "E_a"},
         b.activation);
  v.real({.name = "reference",
          .meaning = "temperature at which those frictions are as the cell type says",
          .dimension = kTemperature,
          .unit = "K",
          .range = kPositive,
          .symbol = "T_0"},
         b.reference);
  blocks(v, {.name = "course", .meaning = "temperature over time", .item = "temperature"},
         b.course.entry, describe_course_point<kTemperatureThen>);
}

}  // namespace acinus::runs
