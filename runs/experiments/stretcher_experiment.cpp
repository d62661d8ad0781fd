/// Experiment "optical_stretcher": a deformable cell between two laser beams.
///
/// Strains are the growth of the axes since the first frame, relative to what they were there; the
/// short axis is the mean over 36 directions across the beams. [VanLiedekerke2020, Fig. 5 and 13]

#include <vector>

#include "coupling/apparatus/stretcher/stretcher.hpp"
#include "coupling/apparatus/temperature/temperature.hpp"
#include "runs/experiments/experiment.hpp"
#include "runs/experiments/single_cell.hpp"

namespace acinus::runs {
namespace {

constexpr double kPa = 1e3;  // Pa in a kPa

void add_axis(const std::string& name, double value, Measures& m) {
  m[name + "_um"].push_back(value);
  m[name + "_strain"].push_back(value / m[name + "_um"].front() - 1);
}

void check_stretcher_block(const Scene& scene, Report& report) {
  if (!scene.stretcher)
    report.add_relation({"/experiment", "/stretcher"}, "\"optical_stretcher\"",
                        "needs a stretcher block (acinus explain stretcher)");
}

std::vector<Observable> stretcher_columns() {
  return {{"long_axis_um", "um", "extent of the cell along the beams"},
          {"short_axis_um", "um", "mean extent of the cell across the beams"},
          {"long_axis_strain", "1", "relative change of the long axis since the first frame"},
          {"short_axis_strain", "1", "relative change of the short axis since the first frame"},
          {"stress_Pa", "Pa", "optical stress where the axis of the beams meets the cell"},
          {"cortex_friction_factor", "1", "friction of the cortex over that of the cell type"}};
}

void sample_stretcher(const coupling::Stretcher& stretcher,
                      const coupling::Temperature& temperature, const ObservedFrame& frame,
                      Measures& m) {
  const double t = frame.snapshot.time;
  const coupling::StretchLoad load = stretcher.load_at(t);
  const std::vector<Vec3> node = first_cell(frame.world);
  const bool there = !node.empty();
  add_axis("long_axis", there ? extent(node, load.axis) : kNotMeasured, m);
  add_axis("short_axis", there ? extent_across(node, load.axis) : kNotMeasured, m);
  m["stress_Pa"].push_back(kPa * load.stress);
  m["cortex_friction_factor"].push_back(temperature.friction_factor(t));
}

Sampler make_stretcher_sampler(const coupling::World& world) {
  const coupling::Apparatus& apparatus = world.params.apparatus;
  const auto& stretcher = apparatus.get<coupling::Stretcher>();
  const auto& temperature = apparatus.get<coupling::Temperature>();
  return [&stretcher, &temperature](const ObservedFrame& frame, ObservedRun& observed) {
    sample_stretcher(stretcher, temperature, frame, observed.measures);
  };
}

}  // namespace

const ExperimentRow optical_stretcher_experiment{
    .meaning = "strain of a cell in an optical stretcher",
    .check = check_stretcher_block,
    .columns = stretcher_columns,
    .make_sampler = make_stretcher_sampler};

}  // namespace acinus::runs
