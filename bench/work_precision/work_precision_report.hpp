#pragma once
/// Tables and plots of the work-precision benchmarks.

#include <string>
#include <vector>

#include "bench/work_precision/work_precision_run.hpp"
#include "io/plot.hpp"

namespace acinus::bench {

/// Name of a setting: "linearly-implicit, 162 nodes, 3-point, dt 60 s, CG 0.001"; for spheres
/// without the mesh.
std::string describe(const PrecisionSetting& setting, bool deformable);

/// Head of a study's Markdown table: title, reference and column names.
std::string table_head(const WorkScene& scene, const PrecisionStudy& study);
/// Row of a study's Markdown table.
std::string table_line(const WorkScene& scene, const PrecisionOutcome& outcome);

/// Cheapest settings that reach 5, 2 and 1 %, for every mesh and quadrature among the outcomes.
std::string cheapest_text(const WorkScene& scene, const std::vector<PrecisionOutcome>& outcomes);

/// Plot of error over CPU time per simulated hour, one line per integrator, mesh and quadrature;
/// other CG tolerances are separate points. Failed outcomes are left out.
io::Plot make_plot(const WorkScene& scene, const std::string& title,
                   const std::vector<PrecisionOutcome>& outcomes, const std::string& y_label,
                   double (*error)(const PrecisionOutcome&));

/// Row of the benchmark's table for one outcome.
BenchRow bench_row(const WorkScene& scene, const std::string& study,
                   const PrecisionOutcome& outcome);

}  // namespace acinus::bench
