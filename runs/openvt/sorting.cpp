#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <unordered_map>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/experiments/read_scene.hpp"
#include "runs/openvt/openvt.hpp"
#include "runs/openvt/run_reference.hpp"
#include "runs/scene/shipped_scenes.hpp"

namespace acinus::runs {
namespace {

/// Time of the workshop in which an isolated cell's mean squared displacement in the plane is its
/// diameter squared.
constexpr double kUnitsPerSquaredDiameter = 100;

const std::vector<std::int64_t>& id_column(const io::Table& table, const std::string& name,
                                           const std::string& folder) {
  for (const io::IdColumn& column : table.ids)
    if (column.name == name) return column.value;
  throw Error(fmt::format("{}: its tables have no column {}", folder, name), Exit::kFileError);
}

/// Share of the pairs of cells in contact whose types differ; 0 without contacts.
double mixed_share(const io::Frame& frame, const std::string& folder) {
  std::unordered_map<std::int64_t, std::int64_t> type;
  const auto &id = id_column(frame.cells, "id", folder),
             &of = id_column(frame.cells, "type", folder);
  for (std::size_t k = 0; k < id.size(); ++k) type[id[k]] = of[k];
  const auto &a = id_column(frame.contacts, "a", folder),
             &b = id_column(frame.contacts, "b", folder),
             &partner = id_column(frame.contacts, "partner", folder);
  int pairs = 0, mixed = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (partner[k] > 1) continue;  // boundary
    ++pairs;
    mixed += type.at(a[k]) != type.at(b[k]) ? 1 : 0;
  }
  return pairs > 0 ? static_cast<double>(mixed) / pairs : 0;
}

}  // namespace

int run_sorting(const std::string& what, const OpenVtOptions& options, MixedShare& found) {
  const std::string name = "openvt_" + what;
  std::vector<std::string> set = options.set;
  set.emplace_back("output.contacts=true");
  if (const int code = run_reference(name, options, set, options.out)) return code;
  const Scene scene = read_scene(find_scene_file(name), options.set);
  const CellType& type = scene.cell_types.begin()->second;
  const double diameter = 2 * type.radius,
               unit = diameter * diameter / (4 * type.diffusion * kUnitsPerSquaredDiameter);
  const io::RunReader reader(options.out + "/run.vtkhdf");
  std::string text = "simID,time,cellID,cellType,x,y\n";
  for (int k = 0; k < reader.n_frame(); ++k) {
    const io::Frame frame = reader.frame(k);
    found.time.push_back(frame.time_s / unit);
    found.mixed.push_back(mixed_share(frame, options.out));
    const auto &id = id_column(frame.cells, "id", options.out),
               &kind = id_column(frame.cells, "type", options.out);
    const std::vector<double>& center = cell_column(frame.cells, "center", options.out);
    std::vector<std::size_t> by_id(id.size());
    std::iota(by_id.begin(), by_id.end(), std::size_t{0});
    std::ranges::sort(by_id, {}, [&id](std::size_t c) { return id[c]; });
    for (const std::size_t c : by_id)
      text += fmt::format("0,{},{},{},{},{}\n", found.time.back(), id[c], kind[c],
                          center[3 * c] / diameter, center[3 * c + 1] / diameter);
  }
  if (!options.csv.empty()) io::write_text_file(options.csv, text);
  return 0;
}

}  // namespace acinus::runs
