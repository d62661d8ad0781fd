#include "runs/openvt/permedcoe.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/openvt/run_reference.hpp"

namespace acinus::runs {
namespace {

/// Mean extent of the cells of a frame along x and y, um.
double extent(const io::Table& cells, const std::string& folder) {
  const std::vector<double>&center = cell_column(cells, "center", folder),
        &radius = cell_column(cells, "radius", folder);
  double sum = 0;
  for (std::size_t axis = 0; axis < 2 && !radius.empty(); ++axis) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t k = 0; k < radius.size(); ++k) {
      low = std::min(low, center[3 * k + axis] - radius[k]);
      high = std::max(high, center[3 * k + axis] + radius[k]);
    }
    sum += high - low;
  }
  return sum / 2;
}

}  // namespace

int run_pushing(const OpenVtOptions& options, Pushing& found) {
  if (const int code = run_reference("permedcoe_pushing", options, options.set, options.out))
    return code;
  const io::RunReader reader(options.out + "/run.vtkhdf");
  std::string text = "timestep,dx\n";
  for (int k = 0; k < reader.n_frame(); ++k) {
    const CellRecords cells = read_cells(reader, k, options.out);
    check(cells.size() == 2,
          fmt::format("{}: frame {} has {} cells, not two", options.out, k, cells.size()),
          Exit::kFileError);
    const Vec3 apart = cells.rbegin()->second.center - cells.begin()->second.center;
    found.time.push_back(reader.time_s(k) / 60);
    found.distance.push_back(apart.norm());
    text += fmt::format("{},{}\n", found.time.back(), found.distance.back());
  }
  if (!options.csv.empty()) io::write_text_file(options.csv, text);
  return 0;
}

int run_growth(const std::string& what, const OpenVtOptions& options, Growth& found) {
  if (const int code = run_reference("permedcoe_" + what, options, options.set, options.out))
    return code;
  const io::RunReader reader(options.out + "/run.vtkhdf");
  std::string text = "time_h,cells,diameter_um\n";
  for (int k = 0; k < reader.n_frame(); ++k) {
    const io::Table cells = reader.cells(k);
    found.time.push_back(reader.time_s(k) / 3600);
    found.cells.push_back(static_cast<double>(cell_column(cells, "radius", options.out).size()));
    found.diameter.push_back(extent(cells, options.out));
    text += fmt::format("{},{},{}\n", found.time.back(), found.cells.back(), found.diameter.back());
  }
  if (!options.csv.empty()) io::write_text_file(options.csv, text);
  return 0;
}

}  // namespace acinus::runs
