#include "runs/assemble/read_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.hpp"

namespace acinus::runs {
namespace {

const std::vector<std::int64_t>& ids(const io::Table& t, const std::string& name) {
  return std::ranges::find(t.ids, name, &io::IdColumn::name)->value;
}

}  // namespace

const std::vector<double>& cell_column(const io::Table& cells, const std::string& name,
                                       const std::string& folder) {
  for (const io::Column& c : cells.columns)
    if (c.name == name) return c.value;
  throw Error(
      fmt::format("{}: its cells have no \"{}\": an older version of acinus wrote it. Run "
                  "the scene again, a calibration with --fresh.",
                  folder, name));
}

CellRecords read_cells(const io::RunReader& reader, int frame, const std::string& folder) {
  const io::Table t = reader.cells(frame);
  const auto &center = cell_column(t, "center", folder),
             &pressure = cell_column(t, "pressure", folder),
             &force = cell_column(t, "contact_force", folder),
             &radius = cell_column(t, "radius", folder);
  const auto &id = ids(t, "id"), &contacts = ids(t, "contacts"), &kind = ids(t, "kind");
  CellRecords cells;
  for (std::size_t k = 0; k < id.size(); ++k)
    cells[id[k]] = {{center[3 * k], center[3 * k + 1], center[3 * k + 2]},
                    1e3 * pressure[k],
                    force[k],
                    static_cast<double>(contacts[k]),
                    kind[k] == io::kShell,
                    radius[k]};
  return cells;
}

}  // namespace acinus::runs
