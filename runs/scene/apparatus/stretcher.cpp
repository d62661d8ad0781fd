#include "coupling/apparatus/stretcher/stretcher.hpp"

#include <fmt/format.h>

#include "runs/scene/apparatus/device_block.hpp"
#include "runs/scene/quoted_quantity.hpp"
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

void describe_stretcher_block(Visitor& v, Scene& s) {
  optional_block(v,
                 {.name = "stretcher",
                  .meaning = "two laser beams that pull at deformable cells; null = none"},
                 s.stretcher, describe_stretcher);
}

void check_stretcher(const Scene& scene, Report& report) {
  if (scene.experiment == Experiment::kOpticalStretcher && !scene.stretcher)
    report.add_relation({"/experiment", "/stretcher"}, "\"optical_stretcher\"",
                        "needs a stretcher block (acinus explain stretcher)");
  if (!scene.stretcher) return;
  const coupling::Stretcher& s = *scene.stretcher;
  if (s.pulse.empty())
    report.add_relation({"/stretcher/pulses", "/stretcher"}, "",
                        "needs a pulse: {\"from\": \"0 s\", \"to\": \"2 s\"}");
  for (std::size_t k = 0; k < s.pulse.size(); ++k) {
    const std::string pointer = fmt::format("/stretcher/pulses/{}", k);
    if (!(s.pulse[k].from < s.pulse[k].to))
      report.add_relation(
          {pointer + "/to", pointer + "/from"}, quoted_time(s.pulse[k].to),
          fmt::format("must be after {}/from = {}", pointer, quoted_time(s.pulse[k].from)));
  }
  if (!(s.beams.cell > s.beams.medium))
    report.add_relation({"/stretcher/cell_index", "/stretcher/medium_index"},
                        fmt::format("{:g}", s.beams.cell),
                        fmt::format("must be above /stretcher/medium_index = {:g}: beams push such "
                                    "a cell out of the light",
                                    s.beams.medium));
  if (s.axis.norm() == 0) report.add_relation({"/stretcher/axis"}, "[0, 0, 0]", "has no direction");
  if (model_of(scene) == CellModel::kCbm)
    report.add_relation({"/stretcher", "/cells/model"}, "",
                        "is for deformable cells: set /cells/model to \"dcm\"");
  if (scene.life.sleep)
    report.add_relation({"/stretcher", "/life/sleep"}, "",
                        "is not for cells that may sleep. Set /life/sleep to false");
}

void add_stretcher(const Scene& scene, coupling::Params& params) {
  if (scene.stretcher) params.apparatus.add(*scene.stretcher);
}

}  // namespace

const DeviceBlock kStretcherBlock{"stretcher", describe_stretcher_block, check_stretcher,
                                  add_stretcher};

}  // namespace acinus::runs
