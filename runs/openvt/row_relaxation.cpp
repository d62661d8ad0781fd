#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/openvt/openvt.hpp"
#include "runs/openvt/run_reference.hpp"

namespace acinus::runs {
namespace {

/// Nine of the ten diameters between the outer centres of eleven cells.
constexpr double kRelaxedLength = 9;

RowLength read_row(const std::string& folder) {
  RowLength row;
  const io::RunReader reader(folder + "/run.vtkhdf");
  for (int k = 0; k < reader.n_frame(); ++k) {
    double low = 0, high = 0, radius = 0;
    bool first = true;
    for (const auto& [lineage, cell] : read_cells(reader, k, folder)) {
      low = first ? cell.center.x() : std::min(low, cell.center.x());
      high = first ? cell.center.x() : std::max(high, cell.center.x());
      radius = cell.radius;
      first = false;
    }
    if (first) continue;
    row.time.push_back(reader.time_s(k));
    row.width.push_back((high - low) / (2 * radius));
  }
  return row;
}

}  // namespace

double time_to_90_percent(const RowLength& row) {
  for (std::size_t k = 1; k < row.width.size(); ++k)
    if (row.width[k] >= kRelaxedLength) {
      const double part = (kRelaxedLength - row.width[k - 1]) / (row.width[k] - row.width[k - 1]);
      return row.time[k - 1] + part * (row.time[k] - row.time[k - 1]);
    }
  throw Error(
      fmt::format("the row of eleven cells has {:.3g} diameters at the end, not yet 9. Let "
                  "it run longer: --set time.end=\"24 h\"",
                  row.width.empty() ? 0.0 : row.width.back()));
}

int run_relaxation(const OpenVtOptions& options, RowLength& found) {
  if (const int code = run_reference("openvt_relax11", options, options.set, options.out))
    return code;
  found = read_row(options.out);
  const double unit = time_to_90_percent(found);
  if (options.csv.empty()) return 0;
  std::string text = "time,width\n";
  for (std::size_t k = 0; k < found.time.size(); ++k)
    text += fmt::format("{},{}\n", found.time[k] / unit, found.width[k]);
  io::write_text_file(options.csv, text);
  return 0;
}

}  // namespace acinus::runs
