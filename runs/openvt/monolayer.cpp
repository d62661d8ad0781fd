#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "io/disk.hpp"
#include "io/run_reader.hpp"
#include "runs/assemble/read_cells.hpp"
#include "runs/openvt/openvt.hpp"
#include "runs/openvt/run_reference.hpp"

namespace acinus::runs {
namespace {

/// Relaxation times of the row per cell cycle, as specified by OpenVT.
constexpr int kRelaxationsPerCycle = 5;
constexpr int kMonolayerAngles = 720, kMonolayerRings = 40;

bool is_covered(const std::vector<const Disc*>& neighbours, double x, double y) {
  return std::ranges::any_of(
      neighbours, [&](const Disc* d) { return std::hypot(x - d->x, y - d->y) < d->radius; });
}

FreeShares free_share(const Disc& disc, const std::vector<const Disc*>& neighbours) {
  int rim = 0, area = 0;
  for (int a = 0; a < kMonolayerAngles; ++a) {
    const double angle = 2 * std::numbers::pi * (a + 0.5) / kMonolayerAngles;
    const double x = std::cos(angle), y = std::sin(angle);
    rim += is_covered(neighbours, disc.x + disc.radius * x, disc.y + disc.radius * y) ? 0 : 1;
    for (int ring = 0; ring < kMonolayerRings; ++ring) {
      // Rings of equal area.
      const double r = disc.radius * std::sqrt((ring + 0.5) / kMonolayerRings);
      area += is_covered(neighbours, disc.x + r * x, disc.y + r * y) ? 0 : 1;
    }
  }
  return {static_cast<double>(rim) / kMonolayerAngles,
          static_cast<double>(area) / (kMonolayerAngles * kMonolayerRings)};
}

Layer read_layer(const std::string& folder, bool deformable) {
  Layer layer;
  const io::RunReader reader(folder + "/run.vtkhdf");
  const int last = reader.n_frame() - 1;
  check(last >= 0, fmt::format("{}: the run has no frame", folder), Exit::kFileError);
  const io::Table cells = reader.cells(last);
  const std::vector<double>&center = cell_column(cells, "center", folder),
        &radius = cell_column(cells, "radius", folder);
  for (std::size_t k = 0; k < radius.size(); ++k)
    layer.cell.push_back({center[3 * k], center[3 * k + 1], radius[k]});
  layer.free = free_shares(layer.cell);
  if (!deformable) return layer;
  // Their rims are no circles: what is free of the whole surface. They do not overlap.
  const std::vector<double>& area = cell_column(cells, "area", folder);
  const std::vector<double>& touched = cell_column(cells, "contact_area", folder);
  for (std::size_t k = 0; k < layer.free.size(); ++k)
    layer.free[k] = {std::clamp(1 - touched.at(k) / area.at(k), 0.0, 1.0), 1};
  return layer;
}

}  // namespace

std::vector<FreeShares> free_shares(const std::vector<Disc>& discs) {
  std::vector<FreeShares> shares;
  for (const Disc& disc : discs) {
    std::vector<const Disc*> neighbours;
    for (const Disc& other : discs)
      if (&other != &disc &&
          std::hypot(other.x - disc.x, other.y - disc.y) < other.radius + disc.radius)
        neighbours.push_back(&other);
    shares.push_back(free_share(disc, neighbours));
  }
  return shares;
}

int run_monolayer(const OpenVtOptions& options, Layer& found) {
  OpenVtOptions row_options = options;
  row_options.out = options.out + "/relax11";
  row_options.csv.clear();
  row_options.set.clear();
  RowLength row;
  if (const int code = run_relaxation(row_options, row)) return code;
  const double cycle = kRelaxationsPerCycle * time_to_90_percent(row);
  std::vector<std::string> set{fmt::format("cell_types.cell.cycle.time=\"{} s\"", cycle)};
  set.insert(set.end(), options.set.begin(), options.set.end());
  const std::string folder = options.out + "/monolayer";
  if (const int code = run_reference("openvt_monolayer", options, set, folder)) return code;
  found = read_layer(folder, options.model == CellModel::kDcm);
  found.cycle = cycle;
  if (options.csv.empty()) return 0;
  std::string text = "x_pos,y_pos,radius_i,f_i,a_i\n";
  for (std::size_t k = 0; k < found.cell.size(); ++k)
    text += fmt::format("{},{},{},{},{}\n", found.cell[k].x, found.cell[k].y, found.cell[k].radius,
                        found.free[k].rim, found.free[k].area);
  io::write_text_file(options.csv, text);
  return 0;
}

}  // namespace acinus::runs
