#include "core/io/observable_rows.hpp"

#include <algorithm>

#include "core/io/hdf5.hpp"

namespace acinus::io {
namespace {
constexpr char kGroup[] = "/observables";
}

std::optional<ObservableRows> read_observable_rows(const std::string& run_file) {
  const h5::File file = h5::File::open(run_file, h5::Access::kRead);
  if (!file.exists(kGroup)) return std::nullopt;
  ObservableRows rows;
  if (!file.has_attribute(kGroup, "n_row")) return rows;
  const std::vector<std::int64_t> counted = file.read_attribute(kGroup, "n_row");
  const std::int64_t n = counted.empty() ? 0 : counted.front();
  for (const std::string& name : file.members(kGroup)) {
    const std::string dataset = std::string(kGroup) + "/" + name;
    if (!file.holds<double>(dataset)) continue;
    if (name == "time") {
      rows.time_s = file.read_rows<double>(dataset, 0, n);
      continue;
    }
    ObservableRows::Column& column = rows.column[name];
    column.unit =
        file.has_attribute(dataset, "unit") ? file.read_text_attribute(dataset, "unit") : "1";
    column.value = file.read_rows<double>(dataset, 0, n);
  }
  return rows;
}

}  // namespace acinus::io
